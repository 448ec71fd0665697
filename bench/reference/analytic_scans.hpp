// Frames of a scene in closed form, for tests and benches that need no ray tracer: spheres on the
// ground, and a wall.
#pragma once

#include <vector>

#include "planner/map/scan_rays.hpp"
#include "sensors/camera_model.hpp"
#include "sensors/frames.hpp"
#include "sensors/lidar_model.hpp"

namespace gnbv {

struct Sphere {
  Vec3 center_m = Vec3::Zero();
  double radius_m = 1.0;
};

struct AnalyticScene {
  std::vector<Sphere> spheres;
  double ground_z_m = 0.0;
  double wall_x_m = 1e9;  // a plane facing -x; far away means none
};

/// Three spheres of 2 to 3 m within 10 m of the origin, on the ground, and a wall at x = 12 m.
AnalyticScene example_scene();

/// Distance along the ray to the nearest surface in units of `direction`; infinity without one.
double first_hit(const AnalyticScene& scene, const Vec3& origin_m, const Vec3& direction);

/// As capture_depth and capture_scan: invalid nearer than the minimum, no return beyond the
/// maximum.
DepthFrame analytic_depth(const AnalyticScene& scene, const CameraModel& camera,
                          const Isometry& T_world_body);
LidarScan analytic_scan(const AnalyticScene& scene, const LidarConfig& lidar,
                        const Isometry& T_world_body);

// ---- depth_rays.cpp: the rays of a depth frame one by one, the slow twin of
// planner/map/scan_rays.hpp

/// Rays of a depth frame in row-major pixel order, by the rules of PixelRay: kInvalidRange, or
/// nearer than range_min_m, gives no ray; kNoReturn, or beyond range_max_m, a clearing ray to the
/// plane at range_max_m, or none with NoReturn::unknown; a return below `floor_z_m` clears but
/// marks nothing.
std::vector<ScanRay> rays_of(const DepthFrame& frame, const CameraModel& camera, double floor_z_m,
                             NoReturn no_return = NoReturn::free);

}  // namespace gnbv
