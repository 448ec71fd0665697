#include "planner/profiling.hpp"

#include <array>
#include <cmath>

namespace gnbv {
namespace {

/// Corners and side middles of the box, counter-clockwise from the corner (min x, min y).
std::array<Eigen::Vector2d, 8> stations_m(const Box3& box) {
  const Vec3 lo = box.min();
  const Vec3 hi = box.max();
  const Vec3 mid = box.center();
  return {{{lo.x(), lo.y()},
           {mid.x(), lo.y()},
           {hi.x(), lo.y()},
           {hi.x(), mid.y()},
           {hi.x(), hi.y()},
           {mid.x(), hi.y()},
           {lo.x(), hi.y()},
           {lo.x(), mid.y()}}};
}

}  // namespace

std::vector<ProfileLeg> bounding_box_profile(const Box3& navigation_m, const ViewPose& start) {
  const std::array<Eigen::Vector2d, 8> stations = stations_m(navigation_m);
  const auto distance_m = [&](std::size_t i) {
    return (stations[i % 8] - start.p_world_m.head<2>()).norm();
  };
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < 8; ++i) {
    if (distance_m(i) < distance_m(nearest)) nearest = i;
  }
  const bool counter_clockwise = distance_m(nearest + 1) <= distance_m(nearest + 7);

  std::vector<ProfileLeg> legs;
  for (std::size_t k = 0; k < 8; ++k) {
    const Eigen::Vector2d& p = stations[(nearest + (counter_clockwise ? k : 8 - k)) % 8];
    const Eigen::Vector2d to_center = navigation_m.center().head<2>() - p;
    const double yaw_rad = std::atan2(to_center.y(), to_center.x());
    legs.push_back({{Vec3(p.x(), p.y(), navigation_m.max().z()), yaw_rad}, false});
    legs.push_back({{Vec3(p.x(), p.y(), navigation_m.min().z()), yaw_rad}, true});
  }
  return legs;
}

}  // namespace gnbv
