#include "tools/mission/score.hpp"

namespace gnbv {

MissionScore score_mission(const SurfaceReference& reference, const MissionResult& result) {
  const std::span<const Vec3f> profile = result.profile_points_world_m;
  const std::span<const Vec3f> cloud = result.belief.cloud.points_world_m();
  return {.profile = coverage_at_all_sizes(reference.outside, profile),
          .final = coverage_at_all_sizes(reference.outside, cloud),
          .profile_raw = coverage_at_all_sizes(reference.raw, profile),
          .final_raw = coverage_at_all_sizes(reference.raw, cloud)};
}

}  // namespace gnbv
