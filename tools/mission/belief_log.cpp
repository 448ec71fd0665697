#include "tools/mission/belief_log.hpp"

#include <algorithm>

#include "planner/belief.hpp"
#include "planner/view/voxels_in_sight.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

PlannerModel model_of(const Scenario& scenario) {
  std::vector<LidarModel> lidars;
  for (const LidarConfig& lidar : scenario.lidars) lidars.push_back(make_lidar_model(lidar));
  return {scenario.planner, scenario.workspace_m, camera_models(scenario),
          lidars,           scenario.seed,        no_fly_of(scenario)};
}

void add_frontiers(const PlannerModel& model, const Belief& belief, const Plan& plan,
                   FrontierMarks& marks, BelievedVoxels& voxels) {
  std::vector<VoxelIndex> all;
  for (const FrontierCluster& cluster :
       find_frontiers(model.config.fvs.frontier, belief.grid, belief.cloud, marks)) {
    all.insert(all.end(), cluster.voxels.begin(), cluster.voxels.end());
  }
  const int chosen = plan.chosen ? plan.candidates[*plan.chosen].cluster : -1;
  if (chosen >= 0) {
    voxels.looked_at = runs_of(plan.clusters[static_cast<std::size_t>(chosen)].voxels);
  }
  std::sort(all.begin(), all.end());
  voxels.frontier = runs_of(all);
}

}  // namespace

BelievedVoxels believed_voxels(const PlannerModel& model, const Belief& belief, const Plan& plan,
                               FrontierMarks& marks) {
  GNBV_CHECK(plan.next.has_value(), "nothing was chosen");
  const ViewPose& view = plan.next->view;
  const VoxelsInSight seen =
      voxels_in_sight(belief.grid, model.rays_at(view.gimbal_pitch_rad), view);
  BelievedVoxels voxels{.unknown = runs_of(seen.unknown), .predicted = runs_of(seen.predicted)};
  const bool asked_fvs = std::any_of(plan.candidates.begin(), plan.candidates.end(),
                                     [](const Candidate& c) { return c.cluster >= 0; });
  if (asked_fvs) add_frontiers(model, belief, plan, marks, voxels);
  return voxels;
}

BeliefLog::BeliefLog(const Scenario& scenario, const std::filesystem::path& folder,
                     std::size_t first_iteration)
    : model_(model_of(scenario)),
      marks_(GridGeometry(scenario.workspace_m, scenario.planner.map.resolution_m).voxel_count()),
      file_(folder, first_iteration) {}

void BeliefLog::connect(MissionHooks& hooks) {
  hooks.on_view_belief = [this, before = hooks.on_view_belief](const Belief& belief) {
    before(belief);
    belief_ = &belief;
  };
  hooks.on_candidates = [this, before = hooks.on_candidates](std::size_t iteration,
                                                             const Plan& plan) {
    before(iteration, plan);
    GNBV_CHECK(belief_ != nullptr, "a decision before the first view");
    if (plan.next) file_.write(iteration, believed_voxels(model_, *belief_, plan, marks_));
  };
}

}  // namespace gnbv
