#include "tools/gnbv/figures.hpp"

namespace gnbv {

RunFigures figures_of(const Scenario& scenario, const ExecutedMission& mission) {
  const MissionResult& r = mission.result;
  RunFigures f;
  f.scenario = scenario.name;
  f.structure = scenario.structure.file.path.empty() ? scenario.structure.builtin
                                                     : scenario.structure.file.path;
  f.utility = scenario.planner.utility.name;
  f.seed = scenario.seed;
  f.termination = std::string(name_of(r.termination));
  f.iterations = static_cast<int>(r.views.size());
  f.entropy_reduction_nat = r.entropy_after_profile_nat - r.belief.grid.total_entropy_nat();
  f.straight_m = r.distance.straight_m;
  f.flown_m = r.distance.flown_m;
  f.profile_m = r.distance.profile_m;
  f.coverage_final = mission.score.final;
  f.coverage_profile = mission.score.profile;
  f.coverage_final_raw = mission.score.final_raw;
  f.density_points_per_voxel = r.views.empty() ? 0.0 : r.views.back().density_points_per_voxel;
  f.wall_s = mission.total_wall_s;
  return f;
}

}  // namespace gnbv
