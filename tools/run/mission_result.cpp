#include "tools/run/mission_result.hpp"

#include <fmt/format.h>

#include "sim/core/sha256.hpp"
#include "sim/flight/guidance.hpp"

namespace gnbv {

std::vector<ViewMark> view_marks(const Scenario& scenario, std::span<const ViewRecord> views) {
  const PowerParameters& power = scenario.vehicle.power;
  const double battery_wh = power.battery_wh > 0.0 ? power.battery_wh : kUsualBattery_wh;
  std::vector<ViewMark> marks;
  for (const ViewRecord& view : views) {
    const ViewPose& at = view.decision.view;
    ViewPose home = at;  // as it looks: the way home needs no turn
    home.p_world_m = views.front().decision.view.p_world_m;
    const double needed_wh = view.energy_wh.value_or(0.0) +
                             leg_energy_wh(scenario.vehicle, scenario.guidance, at, home) +
                             landing_energy_wh(scenario.vehicle, home.p_world_m.z());
    marks.push_back({view.cloud_points, view.straight_m, view.time_s, view.energy_wh,
                     needed_wh <= (1.0 - power.reserve_share) * battery_wh});
  }
  return marks;
}

ScoredCloud scored_cloud(const Scenario& scenario, const MissionResult& result) {
  return {.points_world_m = result.belief.cloud.points_world_m(),
          .profile_points = result.profile_points_world_m.size(),
          .before = {.profile_m = result.distance.profile_m,
                     .transfer_m = result.distance.transfer_m,
                     .profile_end_s = result.profile_end_s},
          .views = view_marks(scenario, result.views)};
}

std::string margin_note(const Scenario& scenario, const PathError& error) {
  const double radius_m = scenario.planner.validity.collision_radius_m;
  const double hull_m = scenario.vehicle.airframe.hull_radius_m;
  if (radius_m <= hull_m || error.max_m <= radius_m - hull_m) return "";
  return fmt::format(
      "the vehicle was up to {:.2f} m off its path, more than the {:.2f} m that are kept free "
      "beyond its hull; what helps: planner.validity.collision_radius_m of at least {:.2f}\n",
      error.max_m, radius_m - hull_m, error.max_m + hull_m);
}

std::string result_sha256(const MissionResult& result) {
  Sha256 hash;
  hash.add(name_of(result.termination));
  for (const TrajectorySample& sample : result.trajectory) {
    hash.add(sample.time_s);
    hash.add(std::span<const double>(sample.T_world_body.data(), 16));
  }
  for (const ViewRecord& view : result.views) {
    const Vec3& p = view.decision.view.p_world_m;
    hash.add(std::span<const double>(p.data(), 3));
    for (const double value : {view.decision.view.yaw_rad, view.decision.scale,
                               view.decision.score.value, view.entropy_nat, view.flown_m}) {
      hash.add(value);
    }
    if (view.decision.view.gimbal_pitch_rad != 0.0) {  // so that others keep their hash
      hash.add(view.decision.view.gimbal_pitch_rad);
    }
  }
  hash.add(result.energy_wh);
  hash.add(result.belief.grid.all_log_odds());
  for (const Vec3f& point : result.belief.cloud.points_world_m()) {
    hash.add(std::span<const float>(point.data(), 3));
  }
  return hash.hex();
}

}  // namespace gnbv
