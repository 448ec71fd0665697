// The hot loop of what a tour sees, compiled once for each SimdLevel (disc_loops.cpp), and the
// plain structs that it shares with its caller (sim/core/lanes.hpp says why plain).
#pragma once

#include <cstddef>

#include "sim/core/simd.hpp"

namespace gnbv {

/// A round piece of surface in the camera's frame, and the pixels that it may cover: columns u0 to
/// u1 and rows v0 to v1, all included; none where the last comes before the first.
struct Disc {
  float p_m[3], normal[3];
  float along_m;  // normal . p
  float radius2_m2;
  int u0, u1, v0, v1;
};

/// Depths, row by row, with where the rays of the columns and rows are at depth 1. Loops read that
/// many elements beyond a row of rays, and read and write as many beyond the last row of depths.
constexpr std::size_t kDiscPadding = 16;
struct DepthImage {
  const float* ray_x;  // through the middles of columns
  const float* ray_y;  // and of rows
  float* depth_m;
  int width_px;
};

struct DiscKernels {
  /// Draws the discs: a pixel keeps the least depth. The ray t (ray_x, ray_y, 1) meets a disc's
  /// plane, the points q with normal . q = normal . p, at the depth t = normal . p / normal .
  /// (ray_x, ray_y, 1). The pixel is covered where that point lies within the radius of p.
  void (*draw)(const Disc* discs, std::size_t count, const DepthImage& image);
};
GNBV_KERNELS(DiscKernels, disc_kernels)

}  // namespace gnbv
