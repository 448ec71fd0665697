// Directions across a cloud, good enough to light it.
#pragma once

#include <span>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// Unit normal at each point, either side: the least principal axis of the points in the 3 x 3 x 3
/// cells around its own, `cell_m` wide, the same for all points of a cell. Zero where fewer than
/// three points or no plane tell it.
std::vector<Vec3f> point_normals(std::span<const Vec3f> points_world_m, double cell_m);

}  // namespace gnbv
