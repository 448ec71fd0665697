// Sums of 32-bit lanes that may not overflow. For view_loops.cpp alone.
#pragma once

#include <cstddef>

#include "sim/core/lanes.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kLaneCount = static_cast<std::size_t>(kLanes);

struct WideLanes {
  std::int64_t lane[kLaneCount] = {};
};
inline void flush(Ints& sum, WideLanes& wide) {
  alignas(64) std::int32_t part[kLaneCount];
  store(part, sum);
  __asm__("" : "+m"(part));  // as in mark(): so that the loop is one of vectors
  for (std::size_t i = 0; i < kLaneCount; ++i) {
    wide.lane[i] += static_cast<std::int64_t>(static_cast<std::uint32_t>(part[i]));
  }
  sum = all(0);
}
inline std::int64_t sum_of(const WideLanes& wide) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < kLaneCount; ++i) sum += wide.lane[i];
  return sum;
}

}  // namespace
}  // namespace gnbv
