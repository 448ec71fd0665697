// Whether a view covers the frontier cluster it was sampled for (paper section 2.4).
#pragma once

#include <optional>
#include <span>

#include "planner/frontiers.hpp"
#include "planner/view_validity.hpp"
#include "sensors/camera_model.hpp"

namespace gnbv {

/// Whether the point lies in the camera's frustum, between its ranges.
bool is_in_frustum(const CameraModel& camera, const Isometry& T_world_body, const Vec3& p_world_m);

/// Whether the camera sees the voxel's centre: in the frustum, no occupied voxel before it.
bool sees_voxel(const CameraModel& camera, const Isometry& T_world_body, const OccupancyGrid& grid,
                VoxelIndex v);

/// cluster_outside_fov when no camera has the centroid in its frustum; cluster_hidden when none
/// sees a voxel of the cluster, if `needs_visible_cluster`; else nothing.
std::optional<Rejection> cluster_rejection(std::span<const CameraModel> cameras,
                                           const OccupancyGrid& grid,
                                           const FrontierCluster& cluster, const ViewPose& view,
                                           bool needs_visible_cluster);

}  // namespace gnbv
