#include "assets/random/parts.hpp"

#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "sim/core/error.hpp"

namespace gnbv::random_parts {
namespace {

Ring rectangle(const BlockExtent& e, double inset_m, double z_m) {
  return {{e.x0_m + inset_m, e.y0_m + inset_m, z_m},
          {e.x1_m - inset_m, e.y0_m + inset_m, z_m},
          {e.x1_m - inset_m, e.y1_m - inset_m, z_m},
          {e.x0_m + inset_m, e.y1_m - inset_m, z_m}};
}

/// Horizontal and upward unit vectors across a line, the upward one seen along it.
struct Across {
  Vec3 side, up;
};
Across across(const Vec3& from_m, const Vec3& to_m) {
  const Vec3 along = (to_m - from_m).normalized();
  const Vec3 level = along.cross(Vec3::UnitZ());
  const Vec3 side = level.norm() > 1e-9 ? level.normalized() : Vec3(Vec3::UnitX());
  return {side, side.cross(along)};
}

/// Carries the ring from the first point of the line to its last; at a corner it lies in the plane
/// that halves the angle, so that the section stays the same.
Part swept(Ring ring, const std::vector<Vec3>& line_m, Paint paint) {
  GNBV_CHECK(line_m.size() >= 2, "a line of {} points", line_m.size());
  std::vector<Ring> rings = {ring};
  for (std::size_t i = 1; i < line_m.size(); ++i) {
    const Vec3 along = (line_m[i] - line_m[i - 1]).normalized();
    const bool is_last = i + 1 == line_m.size();
    const Vec3 normal = is_last ? along : Vec3(along + (line_m[i + 1] - line_m[i]).normalized());
    for (Vec3& p : ring) p += along * ((line_m[i] - p).dot(normal) / along.dot(normal));
    rings.push_back(ring);
  }
  return loft(rings, {}, {}, uniform(paint));
}

void fill_panel(Parts& parts, const std::array<Vec3, 4>& corners_m, std::size_t bay,
                const Bars& bars) {
  const auto& [a0, b0, a1, b1] = corners_m;
  const bool is_crossed = bars.bracing == Bracing::crosses;
  // the two of a cross pass each other, as angles bolted back to back do
  if (is_crossed || bay % 2 == 0) parts += beam(a0, b1, bars.brace_m, bars.brace_m, bars.paint);
  if (is_crossed || bay % 2 == 1)
    parts += beam(b0, a1, 0.96 * bars.brace_m, 0.93 * bars.brace_m, bars.paint);
}

}  // namespace

std::vector<Material> materials() {
  using enum Pattern;
  return {{"concrete", {0.36F, 0.35F, 0.32F}, noise, {0.24F, 0.23F, 0.21F}, 0.6F},
          {"asphalt", {0.07F, 0.07F, 0.075F}, noise, {0.12F, 0.12F, 0.12F}, 0.3F},
          {"brick", {0.28F, 0.09F, 0.05F}, bricks, {0.36F, 0.33F, 0.29F}, 0.28F},
          {"plaster", {0.66F, 0.58F, 0.42F}, noise, {0.50F, 0.43F, 0.31F}, 0.7F},
          {"cladding", {0.22F, 0.33F, 0.41F}, panels, {0.10F, 0.15F, 0.19F}, 0.9F},
          {"roofing", {0.14F, 0.145F, 0.15F}, panels, {0.08F, 0.08F, 0.085F}, 0.8F},
          {"tiles", {0.38F, 0.12F, 0.06F}, stripes, {0.24F, 0.07F, 0.035F}, 0.22F},
          {"glass", {0.03F, 0.05F, 0.065F}, panels, {0.40F, 0.41F, 0.40F}, 0.6F},
          {"door", {0.05F, 0.15F, 0.30F}, stripes, {0.035F, 0.10F, 0.21F}, 0.25F},
          {"galvanised", {0.45F, 0.46F, 0.47F}, noise, {0.31F, 0.32F, 0.33F}, 0.25F},
          {"painted_steel", {0.08F, 0.20F, 0.14F}, noise, {0.13F, 0.29F, 0.21F}, 0.35F},
          {"mast_stripes", {0.52F, 0.045F, 0.03F}, stripes, {0.72F, 0.71F, 0.68F}, 2.9F},
          {"wood", {0.33F, 0.20F, 0.09F}, noise, {0.21F, 0.12F, 0.05F}, 0.2F},
          {"antifouling", {0.32F, 0.045F, 0.03F}, noise, {0.22F, 0.035F, 0.025F}, 0.6F},
          {"topside", {0.03F, 0.055F, 0.12F}, panels, {0.06F, 0.10F, 0.19F}, 1.3F},
          {"white", {0.72F, 0.71F, 0.68F}, panels, {0.48F, 0.47F, 0.44F}, 1.1F},
          {"container_red", {0.42F, 0.08F, 0.04F}, panels, {0.26F, 0.05F, 0.025F}, 0.3F},
          {"container_blue", {0.05F, 0.14F, 0.36F}, panels, {0.03F, 0.08F, 0.22F}, 0.3F},
          {"machine_yellow", {0.64F, 0.38F, 0.02F}, noise, {0.48F, 0.27F, 0.016F}, 0.3F},
          {"bronze", {0.40F, 0.24F, 0.08F}, noise, {0.28F, 0.16F, 0.05F}, 0.15F}};
}

Parts& operator+=(Parts& parts, Part more) {
  parts.push_back(std::move(more));
  return parts;
}

Parts& operator+=(Parts& parts, Parts more) {
  std::move(more.begin(), more.end(), std::back_inserter(parts));
  return parts;
}

Part block(const BlockExtent& e, Paint paint) {
  return loft({rectangle(e, 0.0, e.z0_m), rectangle(e, 0.0, e.z1_m)}, {}, {}, uniform(paint));
}

Part parapet_block(const BlockExtent& e, double parapet_height_m, const ParapetPaint& paint) {
  constexpr double kThickness_m = 0.11;
  const std::array<Paint, 4> by_ring = {paint.wall, paint.coping, paint.wall, paint.roof};
  return loft(
      {rectangle(e, 0.0, e.z0_m), rectangle(e, 0.0, e.z1_m), rectangle(e, kThickness_m, e.z1_m),
       rectangle(e, kThickness_m, e.z1_m - parapet_height_m)},
      {}, {}, [&](std::size_t ring, std::size_t) { return by_ring[ring]; });
}

Part pad(const PadExtent& e, Paint paint) {
  return block({e.x_m - e.half_x_m, e.x_m + e.half_x_m, e.y_m - e.half_y_m, e.y_m + e.half_y_m,
                e.z0_m, e.z1_m},
               paint);
}

Part box(const Isometry& T_world_box, const Vec3& size_m, Paint paint) {
  const Vec3 half_m = 0.5 * size_m;
  const BlockExtent e = {-half_m.x(), half_m.x(), -half_m.y(), half_m.y(), 0.0, size_m.z()};
  std::vector<Ring> ends = {rectangle(e, 0.0, e.z0_m), rectangle(e, 0.0, e.z1_m)};
  for (Ring& end : ends)
    for (Vec3& p : end) p = T_world_box * p;
  return loft(ends, {}, {}, uniform(paint));
}

Part prism(const Ring& outline, const Vec3& along_m, const Painter& painter) {
  Ring moved = outline;
  for (Vec3& p : moved) p += along_m;
  return loft({outline, moved}, {}, {}, painter);
}

Part upright(Part part, const Vec3& origin_m) {
  for (Vec3& p : part.points_m) p = Vec3(p.x(), 0.0 - p.z(), p.y()) + origin_m;
  return part;
}

Part lying_along_x(Part part, const Vec3& origin_m) {
  for (Vec3& p : part.points_m) p = Vec3(p.y(), 0.0 - p.x(), p.z()) + origin_m;
  return part;
}

Part drum(const Vec3& foot_m, double radius_m, double height_m, std::size_t sides, Paint paint) {
  return upright(revolve({{0.0, 0.0}, {0.0, radius_m}, {height_m, radius_m}, {height_m, 0.0}},
                         sides, uniform(paint)),
                 foot_m);
}

Part gallery(double z_m, double inner_m, double outer_m, double thickness_m, std::size_t sides) {
  const double top_m = z_m + thickness_m;
  return upright(revolve_loop({{z_m, inner_m}, {z_m, outer_m}, {top_m, outer_m}, {top_m, inner_m}},
                              sides, uniform(kGalvanised)));
}

Part beam(const Vec3& from_m, const Vec3& to_m, double width_m, double height_m, Paint paint) {
  return bent_beam({from_m, to_m}, width_m, height_m, paint);
}

Part post(const Vec3& foot_m, const Vec3& head_m, double width_m, Paint paint) {
  return prism(square(foot_m.x(), foot_m.y(), foot_m.z(), width_m), head_m - foot_m,
               uniform(paint));
}

Part bent_beam(const std::vector<Vec3>& line_m, double width_m, double height_m, Paint paint) {
  const auto [side, up] = across(line_m.at(0), line_m.at(1));
  const Vec3 a = 0.5 * width_m * side, b = 0.5 * height_m * up, at = line_m.front();
  return swept({at - a - b, at + a - b, at + a + b, at - a + b}, line_m, paint);
}

Part bent_pipe(const std::vector<Vec3>& line_m, double radius_m, std::size_t sides, Paint paint) {
  const auto [side, up] = across(line_m.at(0), line_m.at(1));
  Ring ring;
  for (std::size_t k = 0; k < sides; ++k) {
    const double angle_rad =
        2.0 * kPi * (static_cast<double>(k) + 0.5) / static_cast<double>(sides);
    ring.push_back(line_m.front() +
                   radius_m * (std::cos(angle_rad) * side + std::sin(angle_rad) * up));
  }
  return swept(std::move(ring), line_m, paint);
}

Parts railing(const std::vector<Vec3>& line_m, double height_m, Paint paint) {
  constexpr double kPost_m = 0.034, kRail_m = 0.026, kPostSpacing_m = 1.46, kFoot_m = 0.04;
  Parts parts;
  const auto add_post = [&](const Vec3& at_m) {
    parts += bent_pipe({at_m - kFoot_m * Vec3::UnitZ(), at_m + height_m * Vec3::UnitZ()}, kPost_m,
                       3, paint);
  };
  for (std::size_t i = 0; i + 1 < line_m.size(); ++i) {
    const Vec3 way_m = line_m[i + 1] - line_m[i];
    const int bays = static_cast<int>(std::ceil(way_m.norm() / kPostSpacing_m));
    for (int k = 0; k < bays; ++k) add_post(line_m[i] + way_m * k / bays);
  }
  if (line_m.front() != line_m.back()) add_post(line_m.back());
  std::vector<Vec3> rail_m = line_m;
  for (Vec3& p : rail_m) p.z() += height_m;
  parts += bent_pipe(rail_m, kRail_m, 3, paint);
  return parts;
}

Parts lattice(const std::vector<Ring>& sections, const Bars& bars) {
  Parts parts;
  const std::size_t corners = sections.front().size();
  for (std::size_t k = 0; k < corners; ++k) {
    std::vector<Vec3> chord_m;
    for (const Ring& section : sections) chord_m.push_back(section[k]);
    parts += bent_beam(chord_m, bars.chord_m, bars.chord_m, bars.paint);
  }
  for (std::size_t i = 0; i < sections.size(); ++i)
    for (std::size_t k = 0; k < corners; ++k) {
      const std::size_t next = (k + 1) % corners;
      const Ring& here = sections[i];
      parts += beam(here[k], here[next], bars.brace_m, bars.brace_m, bars.paint);
      if (i + 1 == sections.size()) continue;
      const Ring& beyond = sections[i + 1];
      fill_panel(parts, {here[k], here[next], beyond[k], beyond[next]}, i, bars);
    }
  return parts;
}

Parts ladder(const std::vector<Vec3>& chord_a, const std::vector<Vec3>& chord_b, const Bars& bars) {
  Parts parts = {bent_beam(chord_a, bars.chord_m, bars.chord_m, bars.paint),
                 bent_beam(chord_b, bars.chord_m, bars.chord_m, bars.paint)};
  for (std::size_t i = 0; i < chord_a.size(); ++i) {
    if ((chord_a[i] - chord_b[i]).norm() > 2.0 * bars.chord_m)
      parts += beam(chord_a[i], chord_b[i], bars.brace_m, bars.brace_m, bars.paint);
    if (i + 1 < chord_a.size())
      fill_panel(parts, {chord_a[i], chord_b[i], chord_a[i + 1], chord_b[i + 1]}, i, bars);
  }
  return parts;
}

Ring square(double x_m, double y_m, double z_m, double width_m) {
  const double h_m = 0.5 * width_m;
  return rectangle({x_m - h_m, x_m + h_m, y_m - h_m, y_m + h_m, z_m, z_m}, 0.0, z_m);
}

Ring polygon(int corners, double radius_m, double z_m) {
  return stepped(corners - 1, [&](int k) -> Vec3 {
    const double angle_rad = 2.0 * kPi * (k + 0.5) / corners;
    return {radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), z_m};
  });
}

}  // namespace gnbv::random_parts
