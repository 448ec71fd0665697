// The hot loops of visibility.cpp, compiled once for each SimdLevel (view_loops.cpp), and the plain
// structs that they share with it (sim/core/lanes.hpp says why plain).
#pragma once

#include "planner/map/map_kernels.hpp"

namespace gnbv {

/// Times along a ray are integers, from 0 at the camera to kRayEnd at the ray's end. Their sums are
/// exact: every level walks the same voxels, and a walk knows beforehand when it leaves the grid.
constexpr std::int32_t kRayEnd = 1 << 29;
constexpr std::int32_t kNeverReached = (1 << 30) - 1;

/// A camera of the candidate view, as the walk needs it. Axes x, y, z.
struct RayFanFrame {
  double R[3][3];     // world from body, a turn about z
  double t_m[3];      // of the body
  float origin_m[3];  // of the camera, inside the grid
  std::int32_t origin_key[3];
  double to_upper_border_m[3], to_lower_border_m[3];  // see RayOrigin
  std::int32_t steps_up[3], steps_down[3];            // voxels of the grid beyond the origin's
  std::int32_t stride[3];                             // change of VoxelIndex with a step up
  std::int32_t origin_voxel;
  double resolution_m, inverse_resolution;
};

/// Ends of the rays of one camera in columns, body frame. Each column can be read up to the next
/// multiple of kPadding.
struct RayEnds {
  const double* at_body_m[3];
  std::size_t count;
};

/// What the kernels read and write. `marks` has kMarkPadding bytes beyond the voxels and is zero
/// between views. Lists have room for kMarkPadding entries more than they can get.
constexpr std::size_t kMarkPadding = 128;
constexpr std::uint8_t kMarked = 1;
struct ViewMaps {
  const VoxelWord* words;
  const float* log_odds;
  std::uint8_t* marks;
  std::int32_t resting_voxel;  // in the padding: rays that have ended mark it
  std::int32_t* predicted;     // first predicted voxel of each ray that has one
  std::size_t predicted_count;
  VoxelWord settled_word;  // OccupancyGrid::settled_word(), and its voxels' log-odds
  float settled_log_odds;
  const std::uint8_t* shadow_steps;  // of each voxel, ShadowBand's; null: no shadow is counted
};

/// Sums over the rays, in integers: they do not depend on the order of the rays.
struct RaySums {
  std::int64_t visits;  // voxels, once per ray
  std::int64_t known;   // sum over visits of ln 2 - entropy, 2^-24 nat
  // ---- of the full walk
  std::int64_t rays, rays_occupied, rear_side_rays, shadow_rays, front_rays;  // as in ViewStats
  std::int64_t visits_occupied, known_occupied;  // of the rays that end occupied
  // sums of P_v H, 2^-24 nat; of one ray they stay below 1 - ln(1 - P) < 40 nat and fit 32 bits
  std::int64_t occlusion_aware, unobserved, rear_side;
  std::int64_t unknown_share;  // sum over rays of the unknown share of the pyramid, 2^-30
};

/// Sums over the marked voxels, each once.
struct VoxelSums {
  std::int64_t visited, free;
  std::int64_t known;  // as in RaySums
  std::int64_t shadow, shadow_steps;
  std::int32_t* occupied;
  std::size_t occupied_count;
};

/// So many voxels along x, y and z from the first one on, and how far a step along an axis is.
struct VoxelBox {
  std::size_t first, count[3], stride[3];
};

struct ViewKernels {
  /// Walks the rays of a camera and marks the voxels that they see. `odds_power` is log2(e),
  /// negative for the legacy visibility; only the full walk reads it.
  using WalkRays = void (*)(const RayFanFrame& frame, const RayEnds& ends, float odds_power,
                            ViewMaps& maps, RaySums& sums);
  WalkRays walk_voxels, walk_full;
  /// Counts the marked voxels of the box and clears their marks. May also count and clear up to 63
  /// voxels after a row.
  void (*tally)(const ViewMaps& maps, const VoxelBox& box, VoxelSums& sums);
};
GNBV_KERNELS(ViewKernels, view_kernels)

}  // namespace gnbv
