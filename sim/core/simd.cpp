#include "sim/core/simd.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr std::array<std::string_view, 3> kNames = {"baseline", "avx2", "avx512"};  // by level

SimdLevel level_of_processor() {
#ifdef __x86_64__
  const auto all = [](auto... has) { return (... && (has != 0)); };
  if (!all(__builtin_cpu_supports("sse4.2"), __builtin_cpu_supports("popcnt"))) {
    throw BadInput("this processor is not of the level x86-64-v2 (SSE4.2), which gnbv needs");
  }
  if (!all(__builtin_cpu_supports("avx2"), __builtin_cpu_supports("fma"),
           __builtin_cpu_supports("bmi"), __builtin_cpu_supports("bmi2"))) {
    return SimdLevel::baseline;
  }
  return all(__builtin_cpu_supports("avx512f"), __builtin_cpu_supports("avx512bw"),
             __builtin_cpu_supports("avx512dq"), __builtin_cpu_supports("avx512vl"),
             __builtin_cpu_supports("avx512cd"))
             ? SimdLevel::avx512
             : SimdLevel::avx2;
#else
  return SimdLevel::baseline;
#endif
}

SimdLevel level_asked_for() {
  const char* const asked = std::getenv("GNBV_SIMD");
  if (asked == nullptr || *asked == '\0') return SimdLevel::avx512;
  if (asked == std::string_view("scalar")) return SimdLevel::baseline;  // its former name
  const auto* const name = std::ranges::find(kNames, std::string_view(asked));
  if (name != kNames.end()) return static_cast<SimdLevel>(name - kNames.begin());
  throw BadInput(
      fmt::format("GNBV_SIMD={}: has to be baseline, avx2 or avx512 (or not to be set)", asked));
}

SimdLevel& current_level() {
  static SimdLevel level = std::min(level_of_processor(), level_asked_for());
  return level;
}

}  // namespace

std::string_view name_of(SimdLevel level) { return kNames[static_cast<std::size_t>(level)]; }

SimdLevel simd_level() { return current_level(); }

void set_simd_level(SimdLevel most) {
  current_level() = std::min({level_of_processor(), level_asked_for(), most});
}

}  // namespace gnbv
