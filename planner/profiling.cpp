#include "planner/profiling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "planner/map/scan_insertion.hpp"
#include "planner/motion/paths.hpp"

namespace gnbv {
namespace {

struct Heights {
  double low_m, high_m;
};

/// The longest piece of the vertical line through p that the sphere may fly, up to a millimetre.
std::optional<Heights> allowed_heights(const NoFly& no_fly, const Eigen::Vector2d& p,
                                       const Heights& whole) {
  constexpr double kRounding_m = 1e-3;
  std::multimap<double, double> forbidden = {{whole.high_m, whole.high_m}};  // from and to
  for (const Box3& box_m : no_fly.boxes_m) {
    const Box3 at_level_m(Vec3(box_m.min().x(), box_m.min().y(), 0.0),
                          Vec3(box_m.max().x(), box_m.max().y(), 0.0));
    const double across2_m2 = at_level_m.squaredExteriorDistance(Vec3(p.x(), p.y(), 0.0));
    const double reach2_m2 = no_fly.margin_m * no_fly.margin_m - across2_m2;
    if (reach2_m2 < 0.0) continue;
    const double reach_m = std::sqrt(reach2_m2) + kRounding_m;
    forbidden.emplace(box_m.min().z() - reach_m, box_m.max().z() + reach_m);
  }
  std::optional<Heights> longest;
  double low_m = whole.low_m;
  for (const auto& [from_m, to_m] : forbidden) {
    const Heights piece = {low_m, std::min(from_m, whole.high_m)};
    const double longest_m = longest ? longest->high_m - longest->low_m : 0.0;
    if (piece.high_m - piece.low_m > longest_m) longest = piece;
    low_m = std::max(low_m, to_m);
  }
  return longest;
}

}  // namespace

std::vector<ProfileLeg> bounding_box_profile(const Box3& navigation_m, const ViewPose& start,
                                             const NoFly& no_fly) {
  const std::array<Vec3, 3> lines = {navigation_m.min(), navigation_m.center(), navigation_m.max()};
  // corners and side middles, counter-clockwise
  constexpr std::array<std::size_t, 8> kX = {0, 1, 2, 2, 2, 1, 0, 0};
  constexpr std::array<std::size_t, 8> kY = {0, 0, 0, 1, 2, 2, 2, 1};
  const auto station_m = [&](std::size_t i) {
    return Eigen::Vector2d(lines[kX[i % 8]].x(), lines[kY[i % 8]].y());
  };
  const auto distance_m = [&](std::size_t i) {
    return (station_m(i) - start.p_world_m.head<2>()).norm();
  };
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < 8; ++i) {
    if (distance_m(i) < distance_m(nearest)) nearest = i;
  }
  const bool counter_clockwise = distance_m(nearest + 1) <= distance_m(nearest + 7);
  std::vector<ProfileLeg> legs;
  for (std::size_t k = 0; k < 8; ++k) {
    const Eigen::Vector2d p = station_m(nearest + (counter_clockwise ? k : 8 - k));
    const Eigen::Vector2d to_center = navigation_m.center().head<2>() - p;
    const double yaw_rad = std::atan2(to_center.y(), to_center.x());
    const auto heights = allowed_heights(no_fly, p, {lines[0].z(), lines[2].z()});
    if (!heights) continue;
    legs.push_back({{Vec3(p.x(), p.y(), heights->high_m), yaw_rad}, false});
    legs.push_back({{Vec3(p.x(), p.y(), heights->low_m), yaw_rad}, true});
  }
  return legs;
}

ProfileRoute::ProfileRoute(const ProfilingConfig& config, const Box3& navigation_m,
                           const ViewPose& start, NoFly no_fly)
    : config_(config),
      navigation_m_(navigation_m),
      no_fly_(std::move(no_fly)),
      at_m_(start.p_world_m),
      z_m_(navigation_m.min().z()) {
  if (config.method == ProfilingMethod::bounding_box) {
    legs_ = bounding_box_profile(navigation_m, start, no_fly_);
  }
  const Vec3 from_center_m = start.p_world_m - navigation_m.center();
  bearing_rad_ = std::atan2(from_center_m.y(), from_center_m.x());
}

std::optional<ProfileLeg> ProfileRoute::next(bool saw_surface) {
  while (detour_.empty()) {
    if (next_leg_ == legs_.size() && !plan_on_circle(saw_surface)) return std::nullopt;
    const ProfileLeg& leg = legs_[next_leg_++];
    const Vec3& to_m = leg.goal.p_world_m;
    if (!no_fly_.allows(to_m)) continue;
    const auto via_m = way_around(no_fly_, navigation_m_, at_m_, to_m);
    if (!via_m) continue;
    detour_ = {leg};
    for (auto p_m = via_m->rbegin(); p_m != via_m->rend(); ++p_m) {
      detour_.push_back({{*p_m, leg.goal.yaw_rad}, false});
    }
  }
  const ProfileLeg leg = detour_.back();
  detour_.pop_back();
  at_m_ = leg.goal.p_world_m;
  return leg;
}

double ProfileRoute::share_done() const {
  if (config_.method == ProfilingMethod::circular) {
    return static_cast<double>(std::max(station_, 0)) / config_.circle_stations;
  }
  return legs_.empty() ? 1.0 : static_cast<double>(next_leg_) / static_cast<double>(legs_.size());
}

/// Adds the legs that come next on the circle that the navigation box holds: one more climb while
/// surface is seen, else all to the next station's first climb. False when there are none.
bool ProfileRoute::plan_on_circle(bool saw_surface) {
  constexpr double kArc_rad = deg_to_rad(18.0);  // its chord comes 1.2 % of the radius inside
  const int stations = config_.circle_stations;
  if (config_.method != ProfilingMethod::circular || station_ == stations) return false;
  const double bottom_m = navigation_m_.min().z();
  const double top_m = navigation_m_.max().z();
  const double radius_m = 0.5 * std::min(navigation_m_.sizes().x(), navigation_m_.sizes().y());
  const double spacing_rad = 2.0 * kPi / stations;
  const auto add = [&](double to_go, double z_m, bool is_scan) {
    const double bearing_rad = bearing_rad_ + station_ * spacing_rad - to_go * spacing_rad;
    const Vec3 outwards(std::cos(bearing_rad), std::sin(bearing_rad), 0.0);
    Vec3 p_m = navigation_m_.center() + radius_m * outwards;
    p_m.z() = z_m_ = z_m;
    legs_.push_back({{p_m, wrap_angle_rad(bearing_rad + kPi)}, is_scan});
  };
  const auto climb = [&] { add(0.0, std::min(z_m_ + config_.climb_step_m, top_m), true); };
  if (station_ >= 0 && saw_surface && z_m_ < top_m) {
    climb();
    return true;
  }
  if (++station_ == stations) return false;
  // in arcs that stay outside the structure, at the height it has climbed to
  const int arcs = station_ == 0 ? 1 : static_cast<int>(std::ceil(spacing_rad / kArc_rad - 1e-9));
  for (int arc = 1; arc <= arcs; ++arc) add(1.0 - static_cast<double>(arc) / arcs, z_m_, false);
  if (z_m_ > bottom_m) add(0.0, bottom_m, true);
  if (z_m_ < top_m) climb();
  return true;
}

bool sees_surface(std::span<const LidarScan> scans, std::span<const LidarModel> lidars,
                  double floor_z_m) {
  return std::any_of(scans.begin(), scans.end(), [&](const LidarScan& scan) {
    const std::vector<ScanRay> rays =
        rays_of(scan, lidars[static_cast<std::size_t>(scan.lidar)], floor_z_m);
    return std::any_of(rays.begin(), rays.end(), [](const ScanRay& ray) { return ray.hit; });
  });
}

}  // namespace gnbv
