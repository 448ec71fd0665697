#include "planner/core/history.hpp"

#include <algorithm>

#include "planner/core/belief.hpp"

namespace gnbv {

std::vector<Vec3> positions_of(const History& history) {
  std::vector<Vec3> positions_m;
  for (const Decision& decision : history.decisions) {
    positions_m.push_back(decision.view.p_world_m);
  }
  return positions_m;
}

std::vector<ViewPose> recent_views(const History& history, int count) {
  const std::vector<Decision>& all = history.decisions;
  const std::size_t first = all.size() - std::min(all.size(), static_cast<std::size_t>(count));
  std::vector<ViewPose> recent;
  for (std::size_t i = first; i < all.size(); ++i) recent.push_back(all[i].view);
  return recent;
}

void remember_entropy(const Belief& belief, double entropy_before_nat, History& history) {
  if (!belief.has_depth_return) return;
  if (history.entropies_nat.empty()) history.entropies_nat.push_back(entropy_before_nat);
  history.entropies_nat.push_back(belief.grid.total_entropy_nat());
}

void remember_progress(const Belief& belief, double straight_m, History& history) {
  history.progress.push_back({.occupied_voxels = belief.grid.occupied_count(),
                              .cloud_points = belief.cloud.points_world_m().size(),
                              .straight_m = straight_m});
}

}  // namespace gnbv
