// Clouds that no score would be true of.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/score/voxel_set.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

/// Throws BadInput, beginning with `name`, for a point that is not finite or too far out for a
/// voxel of that size. Its index counts from 0.
void need_voxels(const std::string& name, std::span<const Vec3f> cloud_world_m,
                 double smallest_voxel_m = kCoverageSizes_m[0]);

/// The points of a cloud from anywhere that are scored: those that lie farther below
/// the floor than they cover (kCoverReach_m) are not, as no surface there is asked for. Throws
/// BadInput, beginning with `name`, when there are none, for points as need_voxels(), and when no
/// point is within kFarthest_m of the structure; if the extents say so, this is put down to
/// millimetres or centimetres beside metres.
std::vector<Vec3f> scorable_points(const std::string& name, std::span<const Vec3f> cloud_world_m,
                                   double floor_z_m, const RayScene& scene, const Box3& structure_m,
                                   double smallest_voxel_m = kCoverageSizes_m[0]);

}  // namespace gnbv
