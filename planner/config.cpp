#include "planner/config.hpp"

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

void set_paper(PlannerConfig& config) {
  const PlannerConfig paper;
  config.profiling.scan_in_transit = paper.profiling.scan_in_transit;
  config.fvs.frontier.max_extent_m = paper.fvs.frontier.max_extent_m;
  config.fvs.tries = paper.fvs.tries;
  config.fvs.pool_clusters = paper.fvs.pool_clusters;
  config.fvs.views_per_layer = paper.fvs.views_per_layer;
  config.fvs.needs_visible_cluster = paper.fvs.needs_visible_cluster;
  config.fvs.agvs_when_stuck = paper.fvs.agvs_when_stuck;
  config.fvs.when_grid_finds_nothing = paper.fvs.when_grid_finds_nothing;
  config.utility.bircher_lambda_per_m = paper.utility.bircher_lambda_per_m;
  config.utility.hit_voxel = paper.utility.hit_voxel;
  config.utility.prediction_hides_hits = paper.utility.prediction_hides_hits;
}

void set_released(PlannerConfig& config) {
  config.profiling.scan_in_transit = false;
  config.fvs.frontier.max_extent_m = 0.0;
  config.fvs.tries = 50;
  config.fvs.pool_clusters = true;
  config.fvs.views_per_layer = 8;
  config.fvs.needs_visible_cluster = false;
  config.fvs.agvs_when_stuck = false;
  config.fvs.when_grid_finds_nothing = false;
  config.utility.bircher_lambda_per_m = 0.5;
  config.utility.hit_voxel = HitVoxel::excluded;
  config.utility.prediction_hides_hits = true;
}

}  // namespace

void set_preset_switches(PlannerConfig& config) {
  GNBV_CHECK(config.preset == "paper" || config.preset == "released", "no preset '{}'",
             config.preset);
  set_paper(config);
  if (config.preset == "released") set_released(config);
}

}  // namespace gnbv
