#include "planner/candidate_stats.hpp"

#include "planner/view/released_slips.hpp"

namespace gnbv {

ViewStats candidate_stats(const UtilityConfig& config, const OccupancyGrid& grid,
                          const SurfaceCloud& cloud, const ShadowBand& shadow, double sparse_below,
                          const ViewRays& rays, const ViewPose& candidate, VisitMarks& marks) {
  const UtilityNeeds needs = needs_of(config);
  const ReleasedSlips slips = {
      .excludes_hit_voxel = needs.released_baseline && config.hit_voxel == HitVoxel::excluded,
      .prediction_hides_hits =
          needs.released_baseline && config.prediction_hides_hits && config.gamma > 0.0};
  if (slips.excludes_hit_voxel || slips.prediction_hides_hits) {
    return evaluate_view_with_slips(grid, cloud, rays, candidate, slips, sparse_below);
  }
  return evaluate_view(grid, cloud, rays, candidate, marks,
                       {.detail = needs.detail,
                        .legacy_visibility = config.legacy_visibility,
                        .sparse_below = sparse_below,
                        .shadow = needs.shadow ? &shadow : nullptr});
}

}  // namespace gnbv
