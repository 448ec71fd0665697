// Which vector instructions the hot loops use: chosen once, at run time, from what the processor
// has. Every level gives the same results, bit by bit; only the time differs.
#pragma once

#include <string_view>

namespace gnbv {

enum class SimdLevel { baseline = 0, avx2 = 1, avx512 = 2 };
std::string_view name_of(SimdLevel level);

/// The best level this processor has (avx512: F, BW, DQ, VL and CD), or what set_simd_level() or
/// the environment variable GNBV_SIMD (baseline, avx2, avx512) limits it to. Throws BadInput when
/// that holds another word.
SimdLevel simd_level();

/// Of one thing made for each level, the one for simd_level().
template <typename T>
const T& at_simd_level(const T& baseline, const T& avx2, const T& avx512) {
  const SimdLevel level = simd_level();
  return level == SimdLevel::avx512 ? avx512 : level == SimdLevel::avx2 ? avx2 : baseline;
}

/// For tests and benchmarks: no level above this one from now on. Not while another thread works.
void set_simd_level(SimdLevel most);

}  // namespace gnbv
