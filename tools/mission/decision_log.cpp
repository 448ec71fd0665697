#include "tools/mission/decision_log.hpp"

#include <algorithm>

#include "planner/core/belief.hpp"
#include "planner/view/visibility.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

void add_frontiers(const FrontierConfig& frontier, const Belief& belief, const Plan& plan,
                   FrontierMarks& marks, BelievedVoxels& voxels) {
  std::vector<VoxelIndex> all;
  for (const FrontierCluster& cluster :
       find_frontiers(frontier, belief.grid, belief.cloud, marks)) {
    all.insert(all.end(), cluster.voxels.begin(), cluster.voxels.end());
  }
  const int chosen = plan.chosen.empty() ? -1 : plan.candidates[plan.chosen.front()].cluster;
  if (chosen >= 0) {
    voxels.looked_at = runs_of(plan.clusters[static_cast<std::size_t>(chosen)].voxels);
  }
  std::sort(all.begin(), all.end());
  voxels.frontier = runs_of(all);
}

}  // namespace

BelievedVoxels believed_voxels(const PlannerModel& model, const FrontierConfig& frontier,
                               const Belief& belief, const Plan& plan, FrontierMarks& marks) {
  GNBV_CHECK(plan.has_view(), "nothing was chosen");
  const ViewPose& view = plan.next().view;
  const VoxelsInSight seen =
      voxels_in_sight(belief.grid, model.rays_at(view.gimbal_pitch_rad), view);
  BelievedVoxels voxels{.unknown = runs_of(seen.unknown), .predicted = runs_of(seen.predicted)};
  const bool asked_fvs = std::any_of(plan.candidates.begin(), plan.candidates.end(),
                                     [](const Candidate& c) { return c.cluster >= 0; });
  if (asked_fvs) add_frontiers(frontier, belief, plan, marks, voxels);
  return voxels;
}

DecisionLog::DecisionLog(const Scenario& scenario, const std::filesystem::path& folder,
                         std::size_t first_iteration)
    : model_(planner_model(scenario)),
      frontier_(scenario.planner.fvs.frontier),
      marks_(GridGeometry(scenario.workspace_m, scenario.planner.map.resolution_m).voxel_count()),
      candidates_(folder, first_iteration),
      beliefs_(folder, first_iteration) {}

void DecisionLog::on_plan(std::size_t iteration, const Plan& plan) {
  candidates_.write(iteration, plan);
  GNBV_CHECK(belief_ != nullptr, "a decision before the first view");
  if (!plan.has_view() || plan.candidates.empty()) return;
  beliefs_.write(iteration, believed_voxels(model_, frontier_, *belief_, plan, marks_));
}

void DecisionLog::finish() {
  candidates_.finish();
  beliefs_.finish();
}

}  // namespace gnbv
