#include "planner/tour/unseen_space.hpp"

#include <vector>

#include "planner/core/belief.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {

std::optional<std::size_t> most_unseen(const PlannerModel& model, const Belief& belief,
                                       std::span<const ViewPose> views,
                                       std::span<const double> way_m, Scratch& scratch) {
  constexpr double kLeastShare = 0.02;
  constexpr double kLook_m = 4.0;  // what stopping to look costs beside the way
  std::vector<std::uint32_t> unknown(views.size(), 0);
  const std::size_t shares = scratch.marks.size();
  parallel_for(scratch.threads, shares, [&](std::size_t share) {
    for (std::size_t i = share; i < views.size(); i += shares) {
      const ViewRays& rays = model.rays_at(views[i].gimbal_pitch_rad);
      unknown[i] = evaluate_view(belief.grid, belief.cloud, rays, views[i], scratch.marks[share])
                       .unknown_voxels;
    }
  });
  std::optional<std::size_t> best;
  double most = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (unknown[i] < kLeastShare * model.view_voxels) continue;
    const double rate = unknown[i] / (way_m[i] + kLook_m);
    if (rate <= most) continue;
    most = rate;
    best = i;
  }
  return best;
}

}  // namespace gnbv
