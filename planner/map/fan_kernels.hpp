// The walk of a scan's rays, compiled once for each SimdLevel (fan_loops.cpp). Plain structs and
// pointers only, see sim/core/lanes.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/core/simd.hpp"

namespace gnbv {

/// Marks of the voxels of a grid with a frame one voxel wide around it.
constexpr std::uint8_t kFanUnlisted = 0;
constexpr std::uint8_t kFanListed = 1;
constexpr std::uint8_t kFanFrame = 2;

constexpr std::size_t kFanBundle = 16;  // rays that are walked by one call

/// A bundle of rays in columns, each where it begins, a voxel that is listed already: RaySteps, and
/// places as indices of the framed grid. A ray of length -RaySteps::kNever takes no step.
struct FanRays {
  double t_next[3][kFanBundle], t_voxel[3][kFanBundle];
  double length_m[kFanBundle];
  std::int64_t place[kFanBundle], move[3][kFanBundle];
  std::int64_t end[kFanBundle];  // where the walk stops; -1: not in the grid
};

struct FanKernels {
  /// Walks every ray to its end or to the frame. Marks the places that it crosses, writes those
  /// that were not marked to `listed` and returns how many. `listed` has room for a place a step,
  /// and one more. `resting` is a place that is marked as listed: rays that have ended wait there.
  std::size_t (*walk)(const FanRays& rays, std::int32_t resting, std::uint8_t* marks,
                      std::int32_t* listed);
};

GNBV_KERNELS(FanKernels, fan_kernels)

}  // namespace gnbv
