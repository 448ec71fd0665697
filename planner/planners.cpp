#include "planner/planners.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "planner/guided/guided_planner.hpp"
#include "planner/map/grid_geometry.hpp"
#include "planner/tour/tour_planner.hpp"
#include "planner/tour/tour_state.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

struct Parts {
  const PlannerConfig& config;
  const PlannerModel& model;
  PlannerSources sources;
};
using Made = std::unique_ptr<Planner>;

Made make_guided(Parts parts) {
  const PlannerConfig& config = parts.config;
  return std::make_unique<GuidedPlanner>(GuidedConfig{config.agvs, config.fvs, config.utility},
                                         parts.model, std::move(parts.sources.user_scores));
}

Made make_tour(Parts parts) {
  const bool has_profile = parts.config.profiling.method != ProfilingMethod::none;
  return std::make_unique<TourPlanner>(parts.config.tour, parts.model, has_profile);
}

template <auto lay>
Made make_laid(Parts parts) {
  const auto lay_here = [&model = parts.model, config = parts.config](const OccupancyGrid& map,
                                                                      const ViewPose& start) {
    return lay(config.routes, model, map, start, config.termination.max_iterations);
  };
  return std::make_unique<RoutePlanner>(Route{.lay = lay_here}, parts.model);
}

Made make_given(Parts parts) {
  return std::make_unique<RoutePlanner>(
      Route{.views = parts.config.routes.views,
            .next_view = std::move(parts.sources.next_view),
            .on_refused = std::move(parts.sources.on_refused),
            .trusts_record = is_user_planner(parts.config.utility)},
      parts.model);
}

Made make_known(Parts parts) {
  GNBV_CHECK(parts.sources.route.has_value(), "{} without its route", parts.config.utility.name);
  return std::make_unique<KnownRoutePlanner>(std::move(*parts.sources.route));
}

struct NamedPlanner {
  std::string_view name;
  Made (*make)(Parts);
  PlannerTraits traits;
};

/// Those that have names of their own. Any other name is a utility's of the guided planner.
constexpr std::array kPlanners = {
    NamedPlanner{"uniform_hemisphere", make_laid<lay_hemisphere>, {.lays_views = true}},
    NamedPlanner{"lawnmower", make_laid<lay_lawnmower>, {.lays_views = true, .spaces_rows = true}},
    NamedPlanner{kRouteName, make_given, {.takes_views = true}},
    NamedPlanner{"oracle_views", make_known, {.knows_structure = true}},
    NamedPlanner{"oracle_metres", make_known, {.knows_structure = true, .counts_metres = true}},
    NamedPlanner{"tour", make_tour, {.makes_tours = true}},
};

/// The guided planner's for all other names. A planner of the user's own gives views.
const NamedPlanner& planner_of(const UtilityConfig& utility) {
  static constexpr NamedPlanner kGuided = {"", make_guided, {.scores_views = true}};
  const std::string_view name = is_user_planner(utility) ? kRouteName : utility.name;
  for (const NamedPlanner& planner : kPlanners) {
    if (planner.name == name) return planner;
  }
  return kGuided;
}

}  // namespace

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

PlannerTraits traits_of(const PlannerConfig& config) {
  PlannerTraits traits = planner_of(config.utility).traits;
  if (!traits.scores_views) return traits;
  const UtilityTraits needs = needs_of(config.utility);
  traits.reads_prediction = needs.prediction;
  traits.keeps_shadow = needs.shadow;
  return traits;
}

double planning_bytes(const PlannerConfig& config, const Box3& workspace_m, int threads,
                      std::size_t cameras) {
  const double resolution_m = config.map.resolution_m;
  const double map = map_bytes(workspace_m, resolution_m, threads, cameras);
  const bool makes_tours = planner_of(config.utility).traits.makes_tours;
  return makes_tours ? map + tour_bytes(config.tour, workspace_m, resolution_m) : map;
}

std::vector<std::string_view> planner_names() {
  std::vector<std::string_view> names = utility_names();
  for (const NamedPlanner& planner : kPlanners) names.push_back(planner.name);
  return names;
}

std::vector<std::string_view> planners_that(bool PlannerTraits::*have) {
  std::vector<std::string_view> names;
  for (const NamedPlanner& planner : kPlanners) {
    if (planner.traits.*have) names.push_back(planner.name);
  }
  return names;
}

std::unique_ptr<Planner> make_planner(const PlannerConfig& config, const PlannerModel& model,
                                      PlannerSources sources) {
  return planner_of(config.utility).make({config, model, std::move(sources)});
}

PlannerModel make_model(const PlannerConfig& config, const Box3& workspace_m,
                        std::span<const CameraConfig> cameras, std::span<const LidarConfig> lidars,
                        std::uint64_t seed, NoFly no_fly) {
  const BeliefConfig belief = {.map = config.map,
                               .cloud = config.cloud,
                               .floor_z_m = config.floor_z_m,
                               .shadow = config.utility.shadow,
                               .keeps_shadow = traits_of(config).keeps_shadow};
  return {belief, config.validity, workspace_m, cameras, lidars, seed, std::move(no_fly)};
}

}  // namespace gnbv
