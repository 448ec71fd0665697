// Point clouds as binary little-endian PLY.
#pragma once

#include <filesystem>
#include <span>

#include "sim/core/pose.hpp"

namespace gnbv {

/// float32 x y z in metres, by rename.
void write_cloud_ply(std::span<const Vec3f> points_world_m, const std::filesystem::path& path);

}  // namespace gnbv
