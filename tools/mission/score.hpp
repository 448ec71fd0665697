// How good a mission was, against the truth that the planner never saw.
#pragma once

#include <array>

#include "bench/surface_reference.hpp"
#include "tools/mission/mission_result.hpp"

namespace gnbv {

/// Coverage as fractions, by kCoverageSizes_m.
struct MissionScore {
  std::array<double, 3> profile{};  // outside-visible reference
  std::array<double, 3> final{};
  std::array<double, 3> profile_raw{};  // raw reference
  std::array<double, 3> final_raw{};
};

MissionScore score_mission(const SurfaceReference& reference, const MissionResult& result);

}  // namespace gnbv
