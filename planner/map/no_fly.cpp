#include "planner/map/no_fly.hpp"

#include <algorithm>
#include <limits>

#include "planner/map/clearance.hpp"

namespace gnbv {
namespace {

constexpr double kBeyondMargin = 1.001;  // of the corners, which have to be allowed themselves

/// The corners of each box grown by the margin, pulled into the navigation box.
std::vector<Vec3> corners_around(const NoFly& no_fly, const Box3& navigation_m) {
  const Vec3 margin_m = Vec3::Constant(kBeyondMargin * no_fly.margin_m + 1e-3);
  std::vector<Vec3> corners_m;
  for (const Box3& box_m : no_fly.boxes_m) {
    const Box3 grown_m(box_m.min() - margin_m, box_m.max() + margin_m);
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner_m = grown_m.corner(static_cast<Box3::CornerType>(i))
                                .cwiseMax(navigation_m.min())
                                .cwiseMin(navigation_m.max());
      if (no_fly.allows(corner_m)) corners_m.push_back(corner_m);
    }
  }
  return corners_m;
}

}  // namespace

bool NoFly::allows(const Vec3& p_world_m) const {
  return std::none_of(boxes_m.begin(), boxes_m.end(), [&](const Box3& box_m) {
    return box_m.squaredExteriorDistance(p_world_m) < margin_m * margin_m ||
           box_m.contains(p_world_m);
  });
}

bool NoFly::allows_leg(const Vec3& from_world_m, const Vec3& to_world_m) const {
  constexpr double kRounding_m2 = 1e-9;  // of the search for the nearest point
  return std::none_of(boxes_m.begin(), boxes_m.end(), [&](const Box3& box_m) {
    const double nearest2_m2 = box_to_segment_m2(box_m, from_world_m, to_world_m);
    return nearest2_m2 < margin_m * margin_m &&
           nearest2_m2 < box_m.squaredExteriorDistance(from_world_m) - kRounding_m2;
  });
}

std::optional<std::vector<Vec3>> way_around(
    const NoFly& no_fly, const Box3& navigation_m, const Vec3& from_world_m, const Vec3& to_world_m,
    const std::function<bool(const Vec3&, const Vec3&)>& is_clear) {
  const auto may_fly = [&](const Vec3& a_m, const Vec3& b_m) {
    return no_fly.allows_leg(a_m, b_m) && (!is_clear || is_clear(a_m, b_m));
  };
  if (may_fly(from_world_m, to_world_m)) return std::vector<Vec3>{};
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<Vec3> points_m = {from_world_m};
  for (const Vec3& corner_m : corners_around(no_fly, navigation_m)) points_m.push_back(corner_m);
  points_m.push_back(to_world_m);
  const std::size_t goal = points_m.size() - 1;
  std::vector<double> length_m(points_m.size(), kFar);
  std::vector<std::size_t> before(points_m.size(), 0);
  std::vector<bool> is_done(points_m.size(), false);
  length_m[0] = 0.0;
  while (!is_done[goal]) {
    std::size_t at = goal;
    for (std::size_t i = 0; i < points_m.size(); ++i) {
      if (!is_done[i] && length_m[i] < length_m[at]) at = i;
    }
    if (length_m[at] == kFar) return std::nullopt;
    is_done[at] = true;
    for (std::size_t next = 1; next < points_m.size(); ++next) {
      const double next_m = length_m[at] + (points_m[next] - points_m[at]).norm();
      if (is_done[next] || next_m >= length_m[next]) continue;
      if (!may_fly(points_m[at], points_m[next])) continue;
      length_m[next] = next_m;
      before[next] = at;
    }
  }
  std::vector<Vec3> via_m;
  for (std::size_t at = before[goal]; at != 0; at = before[at]) via_m.push_back(points_m[at]);
  std::reverse(via_m.begin(), via_m.end());
  return via_m;
}

}  // namespace gnbv
