#include "tools/gnbv/figures.hpp"

namespace gnbv {

MissionFigures figures_of(const Scenario& scenario, const ExecutedMission& mission) {
  const MissionResult& r = mission.result;
  return {
      .utility = scenario.planner.utility.name,
      .termination = std::string(name_of(r.termination)),
      .iterations = static_cast<int>(r.views.size()),
      .entropy_reduction_nat = r.entropy_after_profile_nat - r.belief.grid.total_entropy_nat(),
      .straight_m = r.distance.straight_m,
      .flown_m = r.distance.flown_m,
      .profile_m = r.distance.profile_m,
      .coverage_final = mission.score.final,
      .coverage_profile = mission.score.profile,
      .coverage_final_raw = mission.score.final_raw,
      .density_points_per_voxel = r.views.empty() ? 0.0 : r.views.back().density_points_per_voxel,
      .wall_s = mission.total_wall_s};
}

}  // namespace gnbv
