// Point clouds in files.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// Binary little-endian PLY of float32 x y z in metres, by rename.
void write_cloud_ply(std::span<const Vec3f> points_world_m, const std::filesystem::path& path);

/// The vertices of a .ply file, whatever else it holds, or the first three numbers of each line of
/// an .xyz file, in which empty lines and those that begin with # are none. Coordinates may be NaN
/// or infinite. Throws BadInput naming the file, and the line, that is no such cloud.
std::vector<Vec3f> read_cloud(const std::filesystem::path& path);

}  // namespace gnbv
