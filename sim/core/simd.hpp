// Which vector instructions the hot loops use: chosen once, at run time, from what the processor
// has. Every level gives the same results, bit by bit; only the time differs.
#pragma once

#include <string_view>

namespace gnbv {

enum class SimdLevel { baseline = 0, avx2 = 1, avx512 = 2 };
std::string_view name_of(SimdLevel level);

/// The best level this processor has, or what set_simd_level() or the environment variable
/// GNBV_SIMD (baseline, avx2, avx512) limits it to. The levels are x86-64-v2, v3 and v4 of the
/// x86-64 psABI; elsewhere all there is is the baseline: NEON on Arm. Throws BadInput when
/// GNBV_SIMD holds another word, or the processor has not even the baseline.
SimdLevel simd_level();

/// For tests and benchmarks: no level above this one from now on. Not while another thread works.
void set_simd_level(SimdLevel most);

// GNBV_KERNELS(Kernels, kernels): a source compiled by gnbv_kernels() (CMakeLists.txt) defines a
// constant kKernels of each level, and kernels() gives the one for simd_level().
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
