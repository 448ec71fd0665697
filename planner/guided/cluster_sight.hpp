// What a view sees of a cluster of frontier voxels and of the surface around it (paper
// section 2.4).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/core/plan.hpp"
#include "planner/map/occupancy_grid.hpp"
#include "sensors/camera_model.hpp"

namespace gnbv {

/// What hides a point. `map`: an occupied voxel before its own. `front` (the authors' code):
/// nothing, where it lies at most 0.376 m behind the front of the box around all points in the
/// frustum.
enum class Culling { map, front };

/// cluster_outside_fov when no camera has the centroid in its frustum, at least `fov_margin_m` from
/// its sides; cluster_hidden when none sees a voxel of the cluster, if `needs_visible_cluster`;
/// else nothing.
std::optional<Rejection> cluster_rejection(std::span<const CameraModel> cameras,
                                           const OccupancyGrid& grid,
                                           const FrontierCluster& cluster, const ViewPose& view,
                                           bool needs_visible_cluster, double fov_margin_m = 0.0);

/// For each of the points (world) whether a camera sees it from the view.
std::vector<bool> points_in_sight(Culling culling, std::span<const CameraModel> cameras,
                                  const OccupancyGrid& grid, const ViewPose& view,
                                  std::span<const Vec3f> points_world_m);

}  // namespace gnbv
