#include "tools/mission/decision_log.hpp"

#include <algorithm>

#include "planner/view/visibility.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// Of all of them, each once.
VoxelRuns runs_of_all(std::vector<VoxelIndex> voxels) {
  std::ranges::sort(voxels);
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
  return runs_of(voxels);
}

void append(const std::vector<VoxelIndex>& more, std::vector<VoxelIndex>& all) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

BelievedVoxels believed_voxels(const PlannerModel& model, const Belief& belief, const Plan& plan) {
  GNBV_CHECK(plan.has_view(), "nothing was chosen");
  VoxelsInSight seen;
  for (const Decision& next : plan.views) {
    const ViewRays& rays = model.rays_at(next.view.gimbal_pitch_rad);
    const VoxelsInSight more = voxels_in_sight(belief.grid, rays, next.view);
    append(more.unknown, seen.unknown);
    append(more.predicted, seen.predicted);
  }
  std::vector<VoxelIndex> looked_at;
  for (std::size_t i = 0; i < plan.clusters.size(); ++i) {
    if (plan.looks_at(static_cast<int>(i))) append(plan.clusters[i].voxels, looked_at);
  }
  return {.unknown = runs_of_all(std::move(seen.unknown)),
          .predicted = runs_of_all(std::move(seen.predicted)),
          .frontier = runs_of(plan.frontier),
          .looked_at = runs_of_all(std::move(looked_at))};
}

DecisionLog::DecisionLog(const Scenario& scenario, const std::filesystem::path& folder,
                         std::size_t first_iteration)
    : model_(planner_model(scenario)),
      candidates_(folder, first_iteration),
      beliefs_(folder, first_iteration) {}

void DecisionLog::on_plan(std::size_t iteration, const Plan& plan) {
  candidates_.write(iteration, plan);
  GNBV_CHECK(belief_ != nullptr, "a decision before the first view");
  if (!plan.has_view() || plan.candidates.empty()) return;
  beliefs_.write(iteration, believed_voxels(model_, *belief_, plan));
}

void DecisionLog::finish() {
  candidates_.finish();
  beliefs_.finish();
}

}  // namespace gnbv
