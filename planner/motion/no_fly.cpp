#include "planner/motion/no_fly.hpp"

#include <algorithm>

#include "planner/motion/free_space.hpp"

namespace gnbv {

bool NoFly::allows(const Vec3& p_world_m) const {
  return std::none_of(boxes_m.begin(), boxes_m.end(), [&](const Box3& box_m) {
    return box_m.squaredExteriorDistance(p_world_m) < margin_m * margin_m ||
           box_m.contains(p_world_m);
  });
}

bool NoFly::allows_leg(const Vec3& from_world_m, const Vec3& to_world_m) const {
  return std::none_of(boxes_m.begin(), boxes_m.end(), [&](const Box3& box_m) {
    return is_approached(box_m, from_world_m, to_world_m, margin_m);
  });
}

}  // namespace gnbv
