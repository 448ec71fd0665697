// Points with what is known of them, as PLY.
#pragma once

#include <filesystem>
#include <span>

#include "tools/record/frame_sight.hpp"

namespace gnbv {

/// Binary little-endian PLY, by rename: float x y z (metres), uchar red green blue where there are
/// colours, int view where there are views. Requires colours and views of all points or of none.
void write_point_ply(std::span<const Vec3f> points_world_m, std::span<const Rgb24> colours,
                     std::span<const std::int32_t> views, const std::filesystem::path& path);

}  // namespace gnbv
