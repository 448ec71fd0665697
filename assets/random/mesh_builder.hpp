// Closed bodies from rings of points: loft, revolve, append. In metres, in double precision;
// append() rounds to the float of a TriangleMesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "sim/core/pose.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// A closed 2-manifold: every edge belongs to two faces, in opposite directions; faces are
/// counter-clockwise seen from outside.
struct Part {
  std::vector<Vec3> points_m;                       // (n, 3)
  std::vector<std::array<std::uint32_t, 3>> faces;  // (m, 3)
  std::vector<std::uint16_t> material;              // (m)
};

/// A closed polygon, last point joined to the first; either sense of rotation.
using Ring = std::vector<Vec3>;

/// Material of the quad between ring and ring + 1, from point `side` to side + 1. The start cap is
/// asked as ring 0, the end cap as the last ring; a cap's zipper is one side, 0.
using Painter = std::function<std::uint16_t(std::size_t ring, std::size_t side)>;
Painter uniform(std::uint16_t material);

/// How an end is closed: a fan to the apex, or without one a zipper across the ring from point 0,
/// which suits thin sections (aerofoils, panes).
struct Cap {
  std::optional<Vec3> apex_m;
};

/// Skin over at least one ring, all of one size. Faces outwards whichever way the rings turn.
Part loft(const std::vector<Ring>& rings, const Cap& start, const Cap& end, const Painter& painter);

struct RevolvedPoint {
  double y_m = 0.0, radius_m = 0.0;
};

/// Body of revolution about the y axis. First and last point lie on the axis (radius 0), no other
/// does. Painted by profile segment.
Part revolve(const std::vector<RevolvedPoint>& profile, std::size_t sides, const Painter& painter);

/// Revolves a closed profile that does not touch the axis: a ring-shaped shell.
Part revolve_loop(const std::vector<RevolvedPoint>& profile, std::size_t sides,
                  const Painter& painter);

double signed_volume_m3(const Part& part);

void append(TriangleMesh& mesh, const Part& part);

}  // namespace gnbv
