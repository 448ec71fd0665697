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
  GNBV_CHECK(parts.sources.route, "{} without its route", parts.config.utility.name);
  return std::make_unique<KnownRoutePlanner>(std::move(parts.sources.route));
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
    NamedPlanner{"oracle_seconds", make_known, {.knows_structure = true, .counts_seconds = true}},
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

namespace {

/// What differs between a flight from take-off on and one after a profile.
void set_takeoff_switches(PlannerConfig& config, bool is_takeoff) {
  const PlannerConfig paper;
  config.profiling.method = is_takeoff ? ProfilingMethod::none : paper.profiling.method;
  config.profiling.flight_rate_hz = is_takeoff ? 10.0 : paper.profiling.flight_rate_hz;
  config.tour.cost = is_takeoff ? TourCost::seconds : paper.tour.cost;
  config.tour.explore = is_takeoff ? false : paper.tour.explore;
  config.tour.price = is_takeoff ? 0.3 : paper.tour.price;
}

}  // namespace

void set_preset_switches(PlannerConfig& config, std::string_view before) {
  const auto known = std::find(kPlannerPresets.begin(), kPlannerPresets.end(), config.preset);
  GNBV_CHECK(known != kPlannerPresets.end(), "no preset '{}'", config.preset);
  const bool is_takeoff = config.preset == kTakeoff;
  if (is_takeoff || before == kTakeoff) set_takeoff_switches(config, is_takeoff);
  const auto index = is_takeoff ? 0 : static_cast<std::size_t>(known - kPlannerPresets.begin());
  const auto set = [&]<typename T>(T& value, const std::type_identity_t<T>& papers,
                                   const std::type_identity_t<T>& released,
                                   const std::type_identity_t<T>& authors_2018) {
    value = std::array{papers, released, authors_2018}[index];
  };
  const PlannerConfig paper;
  FvsConfig& fvs = config.fvs;
  UtilityConfig& utility = config.utility;
  set(config.agvs.utility_window, 3, 2, 2);  // the third that they read is past the end
  set(config.agvs.look_again, false, false, true);
  set(fvs.mode, FvsMode::burst, FvsMode::single, FvsMode::burst);
  set_mode_switches(fvs);
  fvs.entropy_window = paper.fvs.entropy_window;
  fvs.entropy_lag = paper.fvs.entropy_lag;
  fvs.voxels_in_view = paper.fvs.voxels_in_view;
  fvs.frontier.occupied_only = paper.fvs.frontier.occupied_only;
  fvs.frontier.max_extent_m = paper.fvs.frontier.max_extent_m;
  set(fvs.clusters, paper.fvs.clusters, paper.fvs.clusters, 5);
  set(fvs.retries, 0, 0, 2);
  set(fvs.culling, Culling::map, Culling::map, Culling::front);
  set(fvs.fov_margin_m, 0.0, 0.0, 0.70711);
  set(fvs.first_bearing_twice, false, true, true);
  set(fvs.keeps_blind, false, false, true);
  set(config.validity.leg_radius_m, 0.0, 0.0, 0.5);
  set(fvs.pool_clusters, paper.fvs.pool_clusters, true, false);
  set(fvs.views_per_layer, paper.fvs.views_per_layer, 8, 8);
  set(fvs.radius_m, paper.fvs.radius_m, 3.5, 3.5);
  set(fvs.needs_visible_cluster, false, false, false);
  set(fvs.agvs_when_stuck, true, false, false);
  set(fvs.when_grid_finds_nothing, true, false, false);
  set(config.profiling.scan_in_transit, paper.profiling.scan_in_transit, false, false);
  set(config.termination.within_plans, true, true, false);
  const double settled_percent = paper.termination.entropy_change_percent;
  set(config.termination.entropy_change_percent, settled_percent, settled_percent, 0.0);
  set(utility.bircher_lambda_per_m, paper.utility.bircher_lambda_per_m, 0.5, 0.2);
  set(utility.hit_voxel, HitVoxel::counted, HitVoxel::excluded, HitVoxel::excluded);
  set(utility.prediction_hides_hits, false, true, true);
  set(utility.leaving_rays, LeavingRays::counted, LeavingRays::dropped, LeavingRays::dropped);
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
                               .object_bounds_m = config.object_bounds_m,
                               .shadow = config.utility.shadow,
                               .keeps_shadow = traits_of(config).keeps_shadow};
  return {belief, config.validity, workspace_m, cameras, lidars, seed, std::move(no_fly)};
}

}  // namespace gnbv
