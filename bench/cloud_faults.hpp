// Clouds that no score would be true of.
#pragma once

#include <span>
#include <string>

#include "bench/cloud_metrics.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

/// Throws BadInput, beginning with `name`, for a cloud without points, with a point that is not
/// finite or too far out for a voxel (its index counts from 0), and for one in millimetres or
/// centimetres beside the structure's metres, or the other way round.
void need_scorable(const std::string& name, std::span<const Vec3f> cloud_world_m,
                   const Box3& structure_m);

/// Throws BadInput when every point counts as lost: the cloud lies elsewhere.
void need_near(const std::string& name, std::span<const Vec3f> cloud_world_m,
               const CloudDistances& distances, const Box3& structure_m);

}  // namespace gnbv
