#include "assets/random/mesh_builder.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// Two diagonals count as equal below this difference of squared lengths [m²]: regular grids then
/// get one regular pattern instead of one that follows the rounding.
constexpr double kDiagonalTie_m2 = 1e-9;

void add_face(Part& part, std::size_t a, std::size_t b, std::size_t c, std::uint16_t material) {
  part.faces.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                        static_cast<std::uint32_t>(c)});
  part.material.push_back(material);
}

/// Splits at the shorter diagonal; equal ones by the side of x = 0, so that mirror images agree.
void add_quad(Part& part, std::size_t a, std::size_t b, std::size_t c, std::size_t d,
              std::uint16_t material) {
  const auto& p = part.points_m;
  const double ac_m2 = (p[a] - p[c]).squaredNorm(), bd_m2 = (p[b] - p[d]).squaredNorm();
  const bool tie = std::abs(ac_m2 - bd_m2) < kDiagonalTie_m2;
  const bool right = p[a].x() + p[c].x() >= 0.0;
  if (tie ? right : ac_m2 < bd_m2) {
    add_face(part, a, b, c, material);
    add_face(part, a, c, d, material);
  } else {
    add_face(part, a, b, d, material);
    add_face(part, b, c, d, material);
  }
}

void add_band(Part& part, std::size_t first, std::size_t second, std::size_t sides,
              std::size_t ring, const Painter& painter) {
  for (std::size_t side = 0; side < sides; ++side) {
    const std::size_t next = (side + 1) % sides;
    add_quad(part, first + side, first + next, second + next, second + side, painter(ring, side));
  }
}

/// Fan or zipper over the ring at `first`, looking against the direction of the loft (the start);
/// `flip` for the end.
void add_cap(Part& part, const Cap& cap, std::size_t first, std::size_t sides, std::size_t ring,
             bool flip, const Painter& painter) {
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t side) {
    add_face(part, a, flip ? c : b, flip ? b : c, painter(ring, side));
  };
  if (cap.apex_m) {
    const std::size_t apex = part.points_m.size();
    part.points_m.push_back(*cap.apex_m);
    for (std::size_t side = 0; side < sides; ++side)
      add(apex, first + (side + 1) % sides, first + side, side);
    return;
  }
  // Two chains leave point 0 and meet; each step takes the shorter new edge.
  std::size_t up = 1, down = sides - 1;
  add(first, first + down, first + up, 0);
  const auto point = [&](std::size_t i) { return part.points_m[first + i]; };
  while (down - up > 2) {
    const double advance_up_m = (point(up + 1) - point(down)).norm();
    const double advance_down_m = (point(up) - point(down - 1)).norm();
    if (advance_up_m < advance_down_m) {
      add(first + up, first + down, first + up + 1, 0);
      ++up;
    } else {
      add(first + up, first + down, first + down - 1, 0);
      --down;
    }
  }
  if (down - up == 2) add(first + up, first + down, first + up + 1, 0);
}

Part start_part(const std::vector<Ring>& rings) {
  GNBV_CHECK(!rings.empty() && rings.front().size() >= 3, "a loft needs rings of three points");
  Part part;
  for (const Ring& ring : rings) {
    GNBV_CHECK(ring.size() == rings.front().size(), "rings of {} and {} points", ring.size(),
               rings.front().size());
    part.points_m.insert(part.points_m.end(), ring.begin(), ring.end());
  }
  return part;
}

Part facing_outwards(Part part) {
  const bool is_inside_out = signed_volume_m3(part) < 0.0;
  for (auto& face : part.faces) {
    if (is_inside_out) std::swap(face[1], face[2]);
  }
  return part;
}

/// Point 0 is the lowest, so that a body's lowest point is on the mesh.
Ring circle(const RevolvedPoint& at, std::size_t sides) {
  Ring ring;
  for (std::size_t side = 0; side < sides; ++side) {
    const double angle_rad =
        2.0 * std::numbers::pi * static_cast<double>(side) / static_cast<double>(sides);
    ring.emplace_back(at.radius_m * std::sin(angle_rad), at.y_m,
                      -at.radius_m * std::cos(angle_rad));
  }
  return ring;
}

}  // namespace

Painter uniform(std::uint16_t material) {
  return [material](std::size_t, std::size_t) { return material; };
}

Part loft(const std::vector<Ring>& rings, const Cap& start, const Cap& end,
          const Painter& painter) {
  Part part = start_part(rings);
  const std::size_t sides = rings.front().size(), last = rings.size() - 1;
  for (std::size_t ring = 0; ring < last; ++ring)
    add_band(part, ring * sides, (ring + 1) * sides, sides, ring, painter);
  add_cap(part, start, 0, sides, 0, false, painter);
  add_cap(part, end, last * sides, sides, last, true, painter);
  return facing_outwards(std::move(part));
}

Part revolve(const std::vector<RevolvedPoint>& profile, std::size_t sides, const Painter& painter) {
  GNBV_CHECK(
      profile.size() >= 3 && profile.front().radius_m == 0.0 && profile.back().radius_m == 0.0,
      "a profile of {} points has to start and end on the axis", profile.size());
  std::vector<Ring> rings;
  for (std::size_t i = 1; i + 1 < profile.size(); ++i) rings.push_back(circle(profile[i], sides));
  // The first profile segment is the start fan, so that band i is segment i + 1.
  const std::size_t last = rings.size() - 1;
  Part part =
      loft(rings, {Vec3(0.0, profile.front().y_m, 0.0)}, {Vec3(0.0, profile.back().y_m, 0.0)},
           [&](std::size_t ring, std::size_t side) { return painter(ring + 1, side); });
  const std::size_t fan_begin = 2 * sides * last;
  for (std::size_t side = 0; side < sides; ++side)
    part.material[fan_begin + side] = painter(0, side);
  return part;
}

Part revolve_loop(const std::vector<RevolvedPoint>& profile, std::size_t sides,
                  const Painter& painter) {
  std::vector<Ring> rings;
  for (const RevolvedPoint& at : profile) {
    GNBV_CHECK(at.radius_m > 0.0, "the profile touches the axis at y = {} m", at.y_m);
    rings.push_back(circle(at, sides));
  }
  GNBV_CHECK(rings.size() >= 3, "a loop needs three rings");
  Part part = start_part(rings);
  for (std::size_t ring = 0; ring < rings.size(); ++ring)
    add_band(part, ring * sides, (ring + 1) % rings.size() * sides, sides, ring, painter);
  return facing_outwards(std::move(part));
}

double signed_volume_m3(const Part& part) {
  // Relative to a point of the part: far from the origin the terms would cancel badly.
  const Vec3& o = part.points_m.front();
  double volume_m3 = 0.0;
  for (const auto& f : part.faces) {
    const Vec3 a = part.points_m[f[0]] - o, b = part.points_m[f[1]] - o,
               c = part.points_m[f[2]] - o;
    volume_m3 += a.dot(b.cross(c)) / 6.0;
  }
  return volume_m3;
}

void append(TriangleMesh& mesh, const Part& part) {
  const auto offset = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (const Vec3& p : part.points_m) mesh.vertices_m.push_back(p.cast<float>());
  for (const auto& f : part.faces)
    mesh.faces.push_back({f[0] + offset, f[1] + offset, f[2] + offset});
  mesh.face_material.insert(mesh.face_material.end(), part.material.begin(), part.material.end());
}

}  // namespace gnbv
