// Which points of a cloud the structure has to answer for.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sensors/ray_scene.hpp"

namespace gnbv {

/// 1 for each point but those that belong to what stands around the structure: nearer to an
/// obstacle or the terrain than to the structure, and within kFarthest_m of it. Points near neither
/// are kept: they are as wrong as without obstacles. Deterministic at any number of threads.
std::vector<std::uint8_t> points_of_structure(const RayScene& scene,
                                              std::span<const Vec3f> points_world_m, int threads);

}  // namespace gnbv
