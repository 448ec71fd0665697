// The vector instructions of the hot loops, chosen once at run time. Every level gives the same
// results, bit by bit.
#pragma once

#include <string_view>

namespace gnbv {

enum class SimdLevel { baseline = 0, avx2 = 1, avx512 = 2 };
std::string_view name_of(SimdLevel level);

/// The best level of this processor, limited by set_simd_level() and by the environment variable
/// GNBV_SIMD (baseline, avx2, avx512). The levels are x86-64-v2, v3 and v4 of the x86-64 psABI; Arm
/// has the baseline alone (NEON). Throws BadInput for another word in GNBV_SIMD, and for a
/// processor below the baseline.
SimdLevel simd_level();

/// For tests and benchmarks: sets the highest level. Call it while no other thread works.
void set_simd_level(SimdLevel most);

// GNBV_KERNELS(Kernels, kernels): a source compiled by gnbv_kernels() (CMakeLists.txt) defines
// kKernels once a level; kernels() returns that of simd_level().
#ifdef __x86_64__
#define GNBV_KERNELS(Kernels, kernels)                           \
  namespace at_baseline {                                        \
  extern const Kernels k##Kernels;                               \
  }                                                              \
  namespace at_avx2 {                                            \
  extern const Kernels k##Kernels;                               \
  }                                                              \
  namespace at_avx512 {                                          \
  extern const Kernels k##Kernels;                               \
  }                                                              \
  inline const Kernels& kernels() {                              \
    const SimdLevel level = simd_level();                        \
    return level == SimdLevel::avx512 ? at_avx512::k##Kernels    \
           : level == SimdLevel::avx2 ? at_avx2::k##Kernels      \
                                      : at_baseline::k##Kernels; \
  }
#else
#define GNBV_KERNELS(Kernels, kernels) \
  namespace at_baseline {              \
  extern const Kernels k##Kernels;     \
  }                                    \
  inline const Kernels& kernels() { return at_baseline::k##Kernels; }
#endif

}  // namespace gnbv
