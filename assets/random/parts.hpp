// What random structures are put together from: paints, plain closed solids and lattices of bars;
// and the kinds of structures that are. World axes, z up, metres.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <type_traits>
#include <vector>

#include "assets/random/mesh_builder.hpp"
#include "sim/core/rng.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv::random_parts {

/// Indices into materials().
enum Paint : std::uint16_t {
  kConcrete,
  kAsphalt,
  kBrick,
  kPlaster,
  kCladding,
  kRoofing,
  kTiles,
  kGlass,
  kDoor,
  kGalvanised,
  kPaintedSteel,
  kMastStripes,
  kWood,
  kAntifouling,
  kTopside,
  kWhite,
  kContainerRed,
  kContainerBlue,
  kMachineYellow,
  kBronze
};
std::vector<Material> materials();

using Parts = std::vector<Part>;
Parts& operator+=(Parts& parts, Part more);
Parts& operator+=(Parts& parts, Parts more);

/// Along the axes.
struct BlockExtent {
  double x0_m, x1_m, y0_m, y1_m, z0_m, z1_m;
};
Part block(const BlockExtent& extent, Paint paint);

/// From z0_m to z1_m, and as far to both sides of (x, y).
struct PadExtent {
  double x_m, half_x_m, y_m, half_y_m, z0_m, z1_m;
};
Part pad(const PadExtent& extent, Paint paint);

/// A block whose flat roof lies behind a parapet: `extent` reaches up to the coping.
struct ParapetPaint {
  Paint wall, coping, roof;
};
Part parapet_block(const BlockExtent& extent, double parapet_height_m, const ParapetPaint& paint);

/// Box of `size_m` in any attitude, whose bottom's middle is the frame's origin.
Part box(const Isometry& T_world_box, const Vec3& size_m, Paint paint);

/// The outline moved along: painted by side of the outline, its ends as side 0. An outline that is
/// not convex has to suit the zipper of a Cap.
Part prism(const Ring& outline, const Vec3& along_m, const Painter& painter);

/// The y axis, about which revolve() draws, becomes the z axis (upright) or the x axis
/// (lying_along_x); then the origin becomes `origin_m`. Exact: no rounding by the turn.
Part upright(Part part, const Vec3& origin_m = Vec3::Zero());
Part lying_along_x(Part part, const Vec3& origin_m);

/// A standing cylinder.
Part drum(const Vec3& foot_m, double radius_m, double height_m, std::size_t sides, Paint paint);

/// A level deck of that thickness around the z axis.
Part gallery(double z_m, double inner_m, double outer_m, double thickness_m, std::size_t sides);

/// A straight bar; `width_m` is measured horizontally (along x for a vertical bar).
Part beam(const Vec3& from_m, const Vec3& to_m, double width_m, double height_m, Paint paint);

/// A square post between two heights, cut level at both ends; it may lean.
Part post(const Vec3& foot_m, const Vec3& head_m, double width_m, Paint paint);

/// A bar of the same section along a line of at least two points, mitred at its corners.
Part bent_beam(const std::vector<Vec3>& line_m, double width_m, double height_m, Paint paint);
Part bent_pipe(const std::vector<Vec3>& line_m, double radius_m, std::size_t sides, Paint paint);

/// Posts at the corners of the line and between them, a rail on top. The line lies on the
/// deck, into which the posts reach.
Parts railing(const std::vector<Vec3>& line_m, double height_m, Paint paint);

/// How the panels between two chords are filled.
enum class Bracing { zigzag, crosses };

struct Bars {
  double chord_m = 0.12, brace_m = 0.07;  // widths
  Bracing bracing = Bracing::zigzag;
  Paint paint = kGalvanised;
};

/// A chord through the k-th points of all sections for each k; rungs around every section, and
/// diagonals on every side between neighbouring sections. Sections are rings of one size.
Parts lattice(const std::vector<Ring>& sections, const Bars& bars);

/// The same of two chords only, in a plane or on a curved surface.
Parts ladder(const std::vector<Vec3>& chord_a, const std::vector<Vec3>& chord_b, const Bars& bars);

/// Level rings about (x, y): a square of side `width_m`; of so many corners around the z axis.
Ring square(double x_m, double y_m, double z_m, double width_m);
Ring polygon(int corners, double radius_m, double z_m);

/// make(0), make(1), ..., make(steps).
template <typename Make>
auto stepped(int steps, const Make& make) {
  std::vector<decltype(make(0))> all;
  for (int i = 0; i <= steps; ++i) all.push_back(make(i));
  return all;
}

/// What one of the makers makes, each as likely as the others.
template <typename Size>
Parts one_of(Rng& draws, std::type_identity_t<Size> size,
             std::initializer_list<Parts (*)(Rng&, Size)> makers) {
  return makers.begin()[draws.whole(0, static_cast<int>(makers.size()) - 1)](draws, size);
}

/// The kinds: each draws its proportions for a largest extent of about `size_m`. About the z axis,
/// on the ground z = 0, long side along x.
Parts hall(Rng& draws, double size_m);    // closed, open at an end, sawtooth
Parts tower(Rng& draws, double size_m);   // of masonry, tanks, silos, a chimney
Parts mast(Rng& draws, double size_m);    // free, guyed, for power lines
Parts truss(Rng& draws, double size_m);   // space frame, bare portals, gantry
Parts bridge(Rng& draws, double size_m);  // girder, truss, tied arch, stays
Parts hull(Rng& draws, double size_m);    // a ship on keel blocks
Parts crane(Rng& draws, double size_m);   // tower crane, gantry crane
Parts mixed(Rng& draws, double size_m);   // several of them, and clutter

}  // namespace gnbv::random_parts
