#include "assets/lab_shapes.hpp"

#include <array>
#include <cmath>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

Ring rectangle(const Isometry& T_world_box, double x_m, double y_m, double z_m) {
  Ring ring;
  for (const auto& [side_x, side_y] :
       {std::array{-0.5, -0.5}, std::array{0.5, -0.5}, std::array{0.5, 0.5}, std::array{-0.5, 0.5}})
    ring.emplace_back(T_world_box * Vec3(side_x * x_m, side_y * y_m, z_m));
  return ring;
}

/// Direction of the path at point i: the mean of its segments.
Vec3 tangent(const std::vector<TubePoint>& path, std::size_t i) {
  Vec3 sum = Vec3::Zero();
  if (i > 0) sum += (path[i].centre_m - path[i - 1].centre_m).normalized();
  if (i + 1 < path.size()) sum += (path[i + 1].centre_m - path[i].centre_m).normalized();
  return sum.normalized();
}

}  // namespace

Part box(const Isometry& T_world_box, const Vec3& size_m, std::uint16_t material) {
  return loft({rectangle(T_world_box, size_m.x(), size_m.y(), 0.0),
               rectangle(T_world_box, size_m.x(), size_m.y(), size_m.z())},
              {}, {}, uniform(material));
}

Part open_box(const Isometry& T_world_box, const Vec3& size_m, double wall_m, double depth_m,
              std::uint16_t material, std::uint16_t inside) {
  const double x_m = size_m.x(), y_m = size_m.y(), z_m = size_m.z();
  const double pit_x_m = x_m - 2.0 * wall_m, pit_y_m = y_m - 2.0 * wall_m;
  return loft({rectangle(T_world_box, x_m, y_m, 0.0), rectangle(T_world_box, x_m, y_m, z_m),
               rectangle(T_world_box, pit_x_m, pit_y_m, z_m),
               rectangle(T_world_box, pit_x_m, pit_y_m, z_m - depth_m)},
              {}, {}, [=](std::size_t ring, std::size_t) { return ring < 2 ? material : inside; });
}

std::vector<Ring> tube_rings(const std::vector<TubePoint>& path, std::size_t sides) {
  GNBV_CHECK(path.size() >= 2 && sides >= 3, "a tube of {} points and {} sides", path.size(),
             sides);
  const Vec3 along = tangent(path, 0);
  Vec3 across = along.cross(std::abs(along.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY()).normalized();
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < path.size(); ++i) {
    // Parallel transport: the rings do not twist against each other.
    const Vec3 direction = tangent(path, i);
    across = (across - across.dot(direction) * direction).normalized();
    const Vec3 third = direction.cross(across);
    Ring ring;
    for (std::size_t k = 0; k < sides; ++k) {
      const double turn_rad = 2.0 * kPi * static_cast<double>(k) / static_cast<double>(sides);
      ring.emplace_back(path[i].centre_m + path[i].radius_m * (std::cos(turn_rad) * across +
                                                               std::sin(turn_rad) * third));
    }
    rings.push_back(ring);
  }
  return rings;
}

Part rod(const std::vector<TubePoint>& path, std::size_t sides, std::uint16_t material) {
  return loft(tube_rings(path, sides), {path.front().centre_m}, {path.back().centre_m},
              uniform(material));
}

Part pipe(const std::vector<TubePoint>& path, std::size_t sides, double wall_m, double depth_m,
          std::uint16_t material, std::uint16_t inside) {
  std::vector<Ring> rings = tube_rings(path, sides);
  const std::size_t rim = rings.size() - 1;
  const TubePoint& end = path.back();
  const Vec3 floor_m = end.centre_m - depth_m * tangent(path, rim);
  Ring mouth, bottom;
  for (const Vec3& p : rings[rim]) {
    const Vec3 arm_m = (1.0 - wall_m / end.radius_m) * (p - end.centre_m);
    mouth.emplace_back(end.centre_m + arm_m);
    bottom.emplace_back(floor_m + arm_m);
  }
  rings.push_back(mouth);
  rings.push_back(bottom);
  return loft(rings, {path.front().centre_m}, {floor_m},
              [=](std::size_t ring, std::size_t) { return ring <= rim ? material : inside; });
}

}  // namespace gnbv
