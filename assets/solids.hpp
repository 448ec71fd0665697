// Plain closed solids that buildings and machines are put together from. World axes, z up, metres.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/mesh_builder.hpp"

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

/// The same with a pit of `depth_m` from the top, walls of `wall_m`, a floor of another material.
Part open_box(const Isometry& T_world_box, const Vec3& size_m, double wall_m, double depth_m,
              std::uint16_t material, std::uint16_t inside);

struct TubePoint {
  Vec3 centre_m;
  double radius_m = 0.0;
};

/// Circles across the mean direction of the path at each of its points, at least two; ends flat.
Part rod(const std::vector<TubePoint>& path, std::size_t sides, std::uint16_t material);

/// A rod whose last end is open: a bore of `depth_m` that leaves `wall_m`.
Part open_rod(const std::vector<TubePoint>& path, std::size_t sides, double wall_m, double depth_m,
              std::uint16_t material, std::uint16_t inside);

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

/// The line with each inner corner cut off `cut_m` before and after it: a bend of two mitres.
std::vector<Vec3> eased(const std::vector<Vec3>& line_m, double cut_m);

/// Posts at the corners of the line and between them, a rail on top. The line lies on the
/// deck, into which the posts reach.
std::vector<Part> railing(const std::vector<Vec3>& line_m, double height_m, std::uint16_t paint);

/// Open treads between two stringers from `foot_m` to `head_m`, the middles of its ends.
struct Stairs {
  Vec3 foot_m, head_m;
  double width_m = 0.5;
  int treads = 8;
};
std::vector<Part> stairs(const Stairs& stairs, std::uint16_t tread_paint,
                         std::uint16_t stringer_paint);

/// Moves the parts of `more` to the end of `parts`.
void add(std::vector<Part>& parts, std::vector<Part> more);

}  // namespace gnbv
