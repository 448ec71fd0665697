#include "assets/random/solids.hpp"

#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "sim/core/error.hpp"

namespace gnbv {
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
Part swept(Ring ring, const std::vector<Vec3>& line_m, std::uint16_t paint) {
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

std::vector<Vec3> raised(std::vector<Vec3> line_m, double by_m) {
  for (Vec3& p : line_m) p.z() += by_m;
  return line_m;
}

Ring rectangle(const Isometry& T_world_box, double x_m, double y_m, double z_m) {
  Ring ring;
  for (const auto& [side_x, side_y] :
       {std::array{-0.5, -0.5}, std::array{0.5, -0.5}, std::array{0.5, 0.5}, std::array{-0.5, 0.5}})
    ring.emplace_back(T_world_box * Vec3(side_x * x_m, side_y * y_m, z_m));
  return ring;
}

}  // namespace

Part block(const BlockExtent& e, std::uint16_t paint) {
  return loft({rectangle(e, 0.0, e.z0_m), rectangle(e, 0.0, e.z1_m)}, {}, {}, uniform(paint));
}

Part parapet_block(const BlockExtent& e, double parapet_height_m, const ParapetPaint& paint) {
  constexpr double kThickness_m = 0.11;
  const std::array<std::uint16_t, 4> by_ring = {paint.wall, paint.coping, paint.wall, paint.roof};
  return loft(
      {rectangle(e, 0.0, e.z0_m), rectangle(e, 0.0, e.z1_m), rectangle(e, kThickness_m, e.z1_m),
       rectangle(e, kThickness_m, e.z1_m - parapet_height_m)},
      {}, {}, [&](std::size_t ring, std::size_t) { return by_ring[ring]; });
}

Part box(const Isometry& T_world_box, const Vec3& size_m, std::uint16_t material) {
  return loft({rectangle(T_world_box, size_m.x(), size_m.y(), 0.0),
               rectangle(T_world_box, size_m.x(), size_m.y(), size_m.z())},
              {}, {}, uniform(material));
}

Part prism(const Ring& outline, const Vec3& along_m, const Painter& painter) {
  Ring moved = outline;
  for (Vec3& p : moved) p += along_m;
  return loft({outline, moved}, {}, {}, painter);
}

Part upright(Part part, const Vec3& origin_m) {
  for (Vec3& p : part.points_m) p = Vec3(p.x(), 0.0 - p.z(), p.y());
  return translated(std::move(part), origin_m);
}

Part lying_along_x(Part part, const Vec3& origin_m) {
  for (Vec3& p : part.points_m) p = Vec3(p.y(), 0.0 - p.x(), p.z());
  return translated(std::move(part), origin_m);
}

Part beam(const Vec3& from_m, const Vec3& to_m, double width_m, double height_m,
          std::uint16_t paint) {
  return bent_beam({from_m, to_m}, width_m, height_m, paint);
}

Part post(const Vec3& foot_m, const Vec3& head_m, double width_m, std::uint16_t paint) {
  const double half_m = 0.5 * width_m, x_m = foot_m.x(), y_m = foot_m.y();
  return prism(rectangle({x_m - half_m, x_m + half_m, y_m - half_m, y_m + half_m, 0.0, 0.0}, 0.0,
                         foot_m.z()),
               head_m - foot_m, uniform(paint));
}

Part bent_beam(const std::vector<Vec3>& line_m, double width_m, double height_m,
               std::uint16_t paint) {
  const auto [side, up] = across(line_m.at(0), line_m.at(1));
  const Vec3 a = 0.5 * width_m * side, b = 0.5 * height_m * up, at = line_m.front();
  return swept({at - a - b, at + a - b, at + a + b, at - a + b}, line_m, paint);
}

Part bent_pipe(const std::vector<Vec3>& line_m, double radius_m, std::size_t sides,
               std::uint16_t paint) {
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

std::vector<Part> railing(const std::vector<Vec3>& line_m, double height_m, std::uint16_t paint) {
  constexpr double kPost_m = 0.034, kRail_m = 0.026, kPostSpacing_m = 1.46, kFoot_m = 0.04;
  std::vector<Part> parts;
  const auto add_post = [&](const Vec3& at_m) {
    parts.push_back(bent_pipe({at_m - kFoot_m * Vec3::UnitZ(), at_m + height_m * Vec3::UnitZ()},
                              kPost_m, 3, paint));
  };
  for (std::size_t i = 0; i + 1 < line_m.size(); ++i) {
    const Vec3 way_m = line_m[i + 1] - line_m[i];
    const int bays = static_cast<int>(std::ceil(way_m.norm() / kPostSpacing_m));
    for (int k = 0; k < bays; ++k) add_post(line_m[i] + way_m * k / bays);
  }
  if (line_m.front() != line_m.back()) add_post(line_m.back());
  parts.push_back(bent_pipe(raised(line_m, height_m), kRail_m, 3, paint));
  return parts;
}

void add(std::vector<Part>& parts, std::vector<Part> more) {
  parts.insert(parts.end(), std::make_move_iterator(more.begin()),
               std::make_move_iterator(more.end()));
}

}  // namespace gnbv
