// Plain closed solids that buildings and machines are put together from. World axes, z up, metres.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/random/mesh_builder.hpp"

namespace gnbv {

/// Along the axes.
struct BlockExtent {
  double x0_m, x1_m, y0_m, y1_m, z0_m, z1_m;
};
Part block(const BlockExtent& extent, std::uint16_t paint);

/// A block whose flat roof lies behind a parapet: `extent` reaches up to the coping.
struct ParapetPaint {
  std::uint16_t wall, coping, roof;
};
Part parapet_block(const BlockExtent& extent, double parapet_height_m, const ParapetPaint& paint);

/// Box of `size_m` in any attitude, whose bottom's middle is the frame's origin.
Part box(const Isometry& T_world_box, const Vec3& size_m, std::uint16_t material);

/// The outline moved along: painted by side of the outline, its ends as side 0. An outline that is
/// not convex has to suit the zipper of a Cap.
Part prism(const Ring& outline, const Vec3& along_m, const Painter& painter);

/// The y axis, about which revolve() draws, becomes the z axis (upright) or the x axis
/// (lying_along_x); then the origin becomes `origin_m`. Exact: no rounding by the turn.
Part upright(Part part, const Vec3& origin_m);
Part lying_along_x(Part part, const Vec3& origin_m);

/// A straight bar; `width_m` is measured horizontally (along x for a vertical bar).
Part beam(const Vec3& from_m, const Vec3& to_m, double width_m, double height_m,
          std::uint16_t paint);

/// A square post between two heights, cut level at both ends; it may lean.
Part post(const Vec3& foot_m, const Vec3& head_m, double width_m, std::uint16_t paint);

/// A bar of the same section along a line of at least two points, mitred at its corners.
Part bent_beam(const std::vector<Vec3>& line_m, double width_m, double height_m,
               std::uint16_t paint);
Part bent_pipe(const std::vector<Vec3>& line_m, double radius_m, std::size_t sides,
               std::uint16_t paint);

/// Posts at the corners of the line and between them, a rail on top. The line lies on the
/// deck, into which the posts reach.
std::vector<Part> railing(const std::vector<Vec3>& line_m, double height_m, std::uint16_t paint);

/// Moves the parts of `more` to the end of `parts`.
void add(std::vector<Part>& parts, std::vector<Part> more);

}  // namespace gnbv
