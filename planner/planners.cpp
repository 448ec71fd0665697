#include "planner/planners.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "planner/guided/guided_planner.hpp"
#include "planner/map/memory.hpp"
#include "planner/tour/tour_planner.hpp"
#include "planner/tour/tour_state.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

using Make = std::unique_ptr<Planner> (*)(const PlannerConfig&, const PlannerModel&,
                                          PlannerSources&&);

std::unique_ptr<Planner> make_guided(const PlannerConfig& config, const PlannerModel& model,
                                     PlannerSources&& sources) {
  return std::make_unique<GuidedPlanner>(GuidedConfig{config.agvs, config.fvs, config.utility},
                                         model, std::move(sources.user_scores));
}

std::unique_ptr<Planner> make_tour(const PlannerConfig& config, const PlannerModel& model,
                                   PlannerSources&&) {
  const bool has_profile = config.profiling.method != ProfilingMethod::none;
  return std::make_unique<TourPlanner>(config.tour, model, has_profile);
}

template <LayViews lay>
std::unique_ptr<Planner> make_laid(const PlannerConfig& config, const PlannerModel& model,
                                   PlannerSources&&) {
  return std::make_unique<LaidRoutePlanner>(lay, config.routes, config.termination.max_iterations,
                                            model);
}

std::unique_ptr<Planner> make_given(const PlannerConfig& config, const PlannerModel& model,
                                    PlannerSources&& sources) {
  return std::make_unique<UserRoutePlanner>(config.routes.views, std::move(sources.next_view),
                                            std::move(sources.on_refused), model);
}

std::unique_ptr<Planner> make_known(const PlannerConfig& config, const PlannerModel&,
                                    PlannerSources&& sources) {
  GNBV_CHECK(sources.route.has_value(), "{} without its route", config.utility.name);
  return std::make_unique<KnownRoutePlanner>(std::move(*sources.route));
}

struct NamedPlanner {
  std::string_view name;
  Make make;
  PlannerTraits traits;
};

/// Those that have names of their own. Any other name is a utility's of the guided planner.
constexpr std::array kPlanners = {
    NamedPlanner{"uniform_hemisphere", make_laid<lay_hemisphere>, {.lays_views = true}},
    NamedPlanner{"lawnmower", make_laid<lay_lawnmower>, {.lays_views = true, .spaces_rows = true}},
    NamedPlanner{"route", make_given, {.takes_views = true}},
    NamedPlanner{"oracle_views", make_known, {.knows_structure = true}},
    NamedPlanner{"oracle_metres", make_known, {.knows_structure = true, .counts_metres = true}},
    NamedPlanner{"tour", make_tour, {.makes_tours = true}},
};

/// Nothing for the guided planner.
const NamedPlanner* planner_named(std::string_view name) {
  const auto* const found =
      std::find_if(kPlanners.begin(), kPlanners.end(),
                   [&](const NamedPlanner& planner) { return planner.name == name; });
  return found == kPlanners.end() ? nullptr : found;
}

}  // namespace

PlannerTraits traits_of(const PlannerConfig& config) {
  if (const NamedPlanner* const named = planner_named(config.utility.name)) return named->traits;
  const UtilityNeeds needs = needs_of(config.utility);
  return {.scores_views = true, .reads_prediction = needs.prediction, .keeps_shadow = needs.shadow};
}

double planning_bytes(const PlannerConfig& config, const Box3& workspace_m, int threads,
                      std::size_t cameras) {
  const double resolution_m = config.map.resolution_m;
  const double map = map_bytes(workspace_m, resolution_m, threads, cameras);
  const NamedPlanner* const named = planner_named(config.utility.name);
  const bool makes_tours = named != nullptr && named->traits.makes_tours;
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
  const NamedPlanner* const named = planner_named(config.utility.name);
  return (named != nullptr ? named->make : make_guided)(config, model, std::move(sources));
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
