// What is wrong with a scenario whose values are each allowed, but do not go together.
#pragma once

#include <string>
#include <vector>

#include "scenarios/scenario.hpp"

namespace gnbv {

/// Memory the dense map may take, and what it takes a voxel: occupancy grid 10 bytes (float32
/// log-odds, measured, state, float32 entropy), surface cloud 16 (uint32 count, uint64 sum, uint32
/// bucket); and with each thread 3 more (visit marks 2, insertion marks 1).
constexpr double kMapBudget_bytes = 4.0 * 1024 * 1024 * 1024;
constexpr double kMapBytesPerVoxel = 26.0;
constexpr double kMapBytesPerVoxelAndThread = 3.0;

struct Problem {
  std::vector<std::string> keys;  // whose values do not go together, the likeliest culprit first
  std::string what;
};

/// All of them; none for a scenario that can be run.
std::vector<Problem> problems(const Scenario& scenario);

}  // namespace gnbv
