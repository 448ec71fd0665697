// Point clouds in files.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sim/core/image.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

/// What is known of points beside their places: a value a point, or none at all.
struct CloudColumns {
  std::span<const Rgb8> colours = {};
  std::span<const std::int32_t> views = {};
};

/// Binary little-endian PLY, by rename: float x y z in metres, and where there are colours or
/// views, uchar red green blue and int view.
void write_cloud_ply(std::span<const Vec3f> points_world_m, const std::filesystem::path& path,
                     const CloudColumns& columns = {});

/// The vertices of a .ply file, whatever else it holds, or the points of a .pcd, .las or text file
/// (.xyz, .pts, .txt, .asc, .csv; tools/run/cloud_formats.hpp), moved by the offset before they are
/// rounded to single precision. Coordinates may be NaN or infinite, but of .pcd. Appends to
/// `warnings` what is left out. Throws BadInput naming the file, and the line, that is no such
/// cloud.
std::vector<Vec3f> read_cloud(const std::filesystem::path& path,
                              const Vec3& offset_m = Vec3::Zero(),
                              std::vector<std::string>* warnings = nullptr);

}  // namespace gnbv
