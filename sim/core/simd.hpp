// Which vector instructions the hot loops use: chosen once, at run time, from what the processor
// has. Every level gives the same results, bit by bit; only the time differs.
#pragma once

#include <string_view>

namespace gnbv {

enum class SimdLevel { scalar = 0, avx2 = 1, avx512 = 2 };
std::string_view name_of(SimdLevel level);

/// The best level this processor has (avx512: F, BW, DQ, VL and CD), or what set_simd_level() or
/// the environment variable GNBV_SIMD (scalar, avx2, avx512) limits it to.
SimdLevel simd_level();

/// For tests and benchmarks: no level above this one from now on. Not while another thread works.
void set_simd_level(SimdLevel most);

}  // namespace gnbv
