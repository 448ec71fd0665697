#include "planner/config.hpp"

#include <algorithm>

#include "sim/core/error.hpp"

namespace gnbv {

void set_preset_switches(PlannerConfig& config) {
  const auto known = std::find(kPlannerPresets.begin(), kPlannerPresets.end(), config.preset);
  GNBV_CHECK(known != kPlannerPresets.end(), "no preset '{}'", config.preset);
  const bool is_released = config.preset == "released";
  const auto set = [&](auto& value, const auto& papers, const auto& released) {
    value = is_released ? released : papers;
  };
  const PlannerConfig paper;
  FvsConfig& fvs = config.fvs;
  UtilityConfig& utility = config.utility;
  set(config.profiling.scan_in_transit, paper.profiling.scan_in_transit, false);
  set(fvs.frontier.max_extent_m, paper.fvs.frontier.max_extent_m, 0.0);
  set(fvs.tries, paper.fvs.tries, 50);
  set(fvs.pool_clusters, paper.fvs.pool_clusters, true);
  set(fvs.views_per_layer, paper.fvs.views_per_layer, 8);
  set(fvs.needs_visible_cluster, paper.fvs.needs_visible_cluster, false);
  set(fvs.agvs_when_stuck, paper.fvs.agvs_when_stuck, false);
  set(fvs.when_grid_finds_nothing, paper.fvs.when_grid_finds_nothing, false);
  set(utility.bircher_lambda_per_m, paper.utility.bircher_lambda_per_m, 0.5);
  set(utility.hit_voxel, paper.utility.hit_voxel, HitVoxel::excluded);
  set(utility.prediction_hides_hits, paper.utility.prediction_hides_hits, true);
}

}  // namespace gnbv
