#include "bench/limits/lidar_sight.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/limits/sight_search.hpp"
#include "planner/motion/config.hpp"
#include "planner/profiling.hpp"
#include "sensors/lidar_model.hpp"

namespace gnbv {
namespace {

constexpr double kLean_rad = deg_to_rad(4.0);

struct Leg {
  Vec3 from_m, to_m;
  double yaw_rad;
};

std::vector<Leg> scanned_legs(const Scenario& scenario) {
  ProfilingConfig profiling = scenario.planner.profiling;
  if (profiling.method == ProfilingMethod::none) return {};
  if (profiling.method == ProfilingMethod::saved) profiling.method = ProfilingMethod::bounding_box;
  const Box3 navigation_m = navigation_box_m(scenario.planner.validity, scenario.workspace_m);
  const ViewPose& start = scenario.start.pose;
  ProfileRoute route(profiling, navigation_m, start, no_fly_of(scenario));
  std::vector<Leg> legs;
  ViewPose at = start;
  bool is_first = true;
  while (const auto leg = route.next(true)) {
    if (leg->is_scan || (profiling.scan_in_transit && !is_first)) {
      legs.push_back({at.p_world_m, leg->goal.p_world_m, leg->goal.yaw_rad});
      if (at.yaw_rad != leg->goal.yaw_rad)
        legs.push_back({at.p_world_m, leg->goal.p_world_m, at.yaw_rad});
    }
    at = leg->goal;
    is_first = false;
  }
  return legs;
}

}  // namespace

LidarSight::LidarSight(const Scenario& scenario, const RayScene& scene) : scene_(scene) {
  constexpr std::array<double, 3> kLeans_rad = {0.0, -kLean_rad, kLean_rad};
  for (const Leg& leg : scanned_legs(scenario)) {
    for (const LidarConfig& config : scenario.lidars) {
      for (const double pitch_rad : kLeans_rad) {
        for (const double roll_rad : kLeans_rad) {
          const Eigen::Matrix3d R_world_body = (Eigen::AngleAxisd(leg.yaw_rad, Vec3::UnitZ()) *
                                                Eigen::AngleAxisd(pitch_rad, Vec3::UnitY()) *
                                                Eigen::AngleAxisd(roll_rad, Vec3::UnitX()))
                                                   .toRotationMatrix();
          const Isometry T_body = T_body_lidar(config);
          sweeps_.push_back({.from_m = leg.from_m + R_world_body * T_body.translation(),
                             .along_m = leg.to_m - leg.from_m,
                             .R_lidar_world = (R_world_body * T_body.linear()).transpose(),
                             .range_min_m = config.range_min_m,
                             .range_max_m = config.range_max_m,
                             .half_fov_rad = 0.5 * config.fov_rad,
                             .lidar = config});
        }
      }
    }
  }
}

std::vector<Vec3> LidarSight::origins_m(const Sweep& sweep, const Vec3& point_world_m) {
  if (sweep.lidar.pattern == LidarPattern::fan) {
    // where on the leg the fan's plane passes through the point
    const Vec3 normal = sweep.R_lidar_world.row(2).transpose();
    const double share = normal.dot(point_world_m - sweep.from_m) / normal.dot(sweep.along_m);
    if (!(share >= 0.0 && share <= 1.0)) return {};  // never for a leg within the plane, either
    return {sweep.from_m + share * sweep.along_m};
  }
  constexpr double kApart_m = 0.5;
  std::vector<Vec3> origins;
  const double steps = std::max(1.0, std::ceil(sweep.along_m.norm() / kApart_m));
  for (double i = 0.0; i <= steps; ++i) {
    const Vec3 origin_m = sweep.from_m + i / steps * sweep.along_m;
    const Vec3 in_lidar_m = sweep.R_lidar_world * (point_world_m - origin_m);
    const double up_rad = std::atan2(in_lidar_m.z(), in_lidar_m.head<2>().norm());
    if (up_rad < sweep.lidar.elevation_min_rad || up_rad > sweep.lidar.elevation_max_rad) continue;
    origins.push_back(origin_m);
  }
  return origins;
}

bool LidarSight::is_seen(const Vec3f& point_world_m) const {
  const Vec3 point_m = point_world_m.cast<double>();
  std::vector<Vec3f> origins, directions;
  for (const Sweep& sweep : sweeps_) {
    for (const Vec3& origin_m : origins_m(sweep, point_m)) {
      const Vec3 to_m = point_m - origin_m;
      const double range_m = to_m.norm();
      const Vec3 in_fan_m = sweep.R_lidar_world * to_m;
      if (range_m < sweep.range_min_m || range_m > sweep.range_max_m ||
          std::abs(std::atan2(in_fan_m.y(), in_fan_m.x())) > sweep.half_fov_rad) {
        continue;
      }
      origins.emplace_back(origin_m.cast<float>());
      directions.emplace_back(to_m.cast<float>());
    }
  }
  std::vector<std::uint8_t> blocked(origins.size());
  scene_.find_blocked(kMeshParts, origins, directions, 0.0F, kSightEnd, blocked);
  return std::find(blocked.begin(), blocked.end(), 0) != blocked.end();
}

}  // namespace gnbv
