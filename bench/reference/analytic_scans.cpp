#include "bench/reference/analytic_scans.hpp"

#include <cmath>
#include <limits>

namespace gnbv {
namespace {

constexpr double kNoHit = std::numeric_limits<double>::infinity();

double nearer_of_sphere(const Sphere& sphere, const Vec3& origin_m, const Vec3& direction) {
  const Vec3 from_center_m = origin_m - sphere.center_m;
  const double a = direction.squaredNorm();
  const double b = from_center_m.dot(direction);
  const double c = from_center_m.squaredNorm() - sphere.radius_m * sphere.radius_m;
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0) return kNoHit;
  const double t = (-b - std::sqrt(discriminant)) / a;
  return t > 0.0 ? t : kNoHit;
}

double plane_hit(double from_m, double speed) {
  const double t = from_m / speed;
  return t > 0.0 ? t : kNoHit;
}

float measured(double range, double range_min_m, double range_max_m) {
  if (range < range_min_m) return kInvalidRange;
  return range > range_max_m ? kNoReturn : static_cast<float>(range);
}

}  // namespace

AnalyticScene example_scene() {
  return {.spheres = {{Vec3(0.0, 0.0, 3.0), 3.0},
                      {Vec3(6.0, 4.0, 2.0), 2.0},
                      {Vec3(-5.0, 5.5, 2.5), 2.5}},
          .ground_z_m = 0.0,
          .wall_x_m = 12.0};
}

double first_hit(const AnalyticScene& scene, const Vec3& origin_m, const Vec3& direction) {
  double nearest = kNoHit;
  for (const Sphere& sphere : scene.spheres) {
    nearest = std::min(nearest, nearer_of_sphere(sphere, origin_m, direction));
  }
  if (direction.z() != 0.0) {
    nearest = std::min(nearest, plane_hit(scene.ground_z_m - origin_m.z(), direction.z()));
  }
  if (direction.x() != 0.0) {
    nearest = std::min(nearest, plane_hit(scene.wall_x_m - origin_m.x(), direction.x()));
  }
  return nearest;
}

DepthFrame analytic_depth(const AnalyticScene& scene, const CameraModel& camera,
                          const Isometry& T_world_body) {
  DepthFrame frame;
  frame.T_world_camera = T_world_body * camera.T_body_camera;
  const CameraConfig& config = camera.config;
  for (int v = 0; v < config.height_px; ++v) {
    for (int u = 0; u < config.width_px; ++u) {
      // z of the direction is 1 in the camera, so the distance along it is the depth
      const Vec3 direction = frame.T_world_camera.linear() * camera.ray_camera(u, v).cast<double>();
      const double depth_m = first_hit(scene, frame.T_world_camera.translation(), direction);
      frame.depth_m.push_back(measured(depth_m, config.range_min_m, return_end_m(config)));
    }
  }
  return frame;
}

LidarScan analytic_scan(const AnalyticScene& scene, const LidarConfig& lidar,
                        const Isometry& T_world_body) {
  LidarScan scan;
  scan.T_world_lidar = T_world_body * T_body_lidar(lidar);
  for (int beam = 0; beam < lidar.beams; ++beam) {
    const Vec3 direction = scan.T_world_lidar.linear() * beam_lidar(lidar, beam).cast<double>();
    const double range_m = first_hit(scene, scan.T_world_lidar.translation(), direction);
    scan.range_m.push_back(measured(range_m, lidar.range_min_m, lidar.range_max_m));
  }
  return scan;
}

}  // namespace gnbv
