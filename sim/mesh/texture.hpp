// The colour of a material at a place: procedural textures, solid in space.
#pragma once

#include <array>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// Linear colour, each channel in [0, 1]. `normal_world` (unit) tells which axes a pattern of
/// sheets or bricks runs along. Depends on its arguments alone: the same place always has the same
/// colour, seen from anywhere.
std::array<float, 3> albedo(const Material& material, const Vec3f& p_world_m,
                            const Vec3f& normal_world);

}  // namespace gnbv
