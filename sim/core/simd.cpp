#include "sim/core/simd.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr std::array kLevels = {SimdLevel::baseline, SimdLevel::avx2, SimdLevel::avx512};

SimdLevel level_of_processor() {
#ifdef __x86_64__
  if (!__builtin_cpu_supports("sse4.2") || !__builtin_cpu_supports("popcnt")) {
    throw BadInput("this processor is not of the level x86-64-v2 (SSE4.2), which gnbv needs");
  }
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") ||
      !__builtin_cpu_supports("bmi") || !__builtin_cpu_supports("bmi2")) {
    return SimdLevel::baseline;
  }
  const bool has_v4 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
                      __builtin_cpu_supports("avx512cd");
  return has_v4 ? SimdLevel::avx512 : SimdLevel::avx2;
#else
  return SimdLevel::baseline;
#endif
}

SimdLevel level_asked_for() {
  const char* const asked = std::getenv("GNBV_SIMD");
  if (asked == nullptr || *asked == '\0') return SimdLevel::avx512;
  for (const SimdLevel level : kLevels) {
    if (name_of(level) == asked) return level;
  }
  // what baseline was called before
  if (asked == std::string_view("scalar")) return SimdLevel::baseline;
  throw BadInput(
      fmt::format("GNBV_SIMD={}: has to be baseline, avx2 or avx512 (or not to be set)", asked));
}

SimdLevel& current_level() {
  static SimdLevel level = std::min(level_of_processor(), level_asked_for());
  return level;
}

}  // namespace

std::string_view name_of(SimdLevel level) {
  switch (level) {
    case SimdLevel::baseline:
      return "baseline";
    case SimdLevel::avx2:
      return "avx2";
    case SimdLevel::avx512:
      return "avx512";
  }
  return "unknown";
}

SimdLevel simd_level() { return current_level(); }

void set_simd_level(SimdLevel most) {
  current_level() = std::min({level_of_processor(), level_asked_for(), most});
}

}  // namespace gnbv
