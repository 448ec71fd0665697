// The one place that knows all planners: what a name stands for.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "planner/config.hpp"

namespace gnbv {

/// What those around a planner ask of it before it flies.
struct PlannerTraits {
  bool scores_views = false;     // samples candidates, and a utility chooses
  bool lays_views = false;       // all at once, around the profile
  bool spaces_rows = false;      // of those: by RouteConfig::overlap
  bool takes_views = false;      // a user gives them: RouteConfig::views, PlannerSources::next_view
  bool knows_structure = false;  // its views are planned on the true one: PlannerSources::route
  bool counts_metres = false;    // of those: the fewest metres, not the fewest views
  bool counts_seconds = false;   // of those: the least time in flight
  bool makes_tours = false;      // Plan::tour
  bool reads_prediction = false;  // of surface by symmetry (section 2.3)
  bool keeps_shadow = false;      // BeliefConfig::keeps_shadow
};
/// Requires a name of planner_names(), or that of a user's utility.
PlannerTraits traits_of(const PlannerConfig& config);

/// The most that the dense arrays of the belief and the planner take: map_bytes(), and of a planner
/// that makes tours tour_bytes(). Of a name that no planner has, the former alone.
double planning_bytes(const PlannerConfig& config, const Box3& workspace_m, int threads,
                      std::size_t cameras);

/// All that planner.utility.name may be, the formulas of utility_names() first.
std::vector<std::string_view> planner_names();

/// Those of them with a trait, such as planners_that(&PlannerTraits::takes_views).
std::vector<std::string_view> planners_that(bool PlannerTraits::*have);

/// What comes to a planner from outside.
struct PlannerSources {
  UserScores user_scores = {};  // of a utility of the user's own
  KnownRoute route = {};        // of who knows the structure
  NextView next_view = {};      // of who takes views
  OnRefused on_refused = {};    // likewise
};

/// Requires what traits_of() does, and a route for who knows the structure. Keeps a reference to
/// the model.
std::unique_ptr<Planner> make_planner(const PlannerConfig& config, const PlannerModel& model,
                                      PlannerSources sources = {});

/// What the settings mean for these cameras and this workspace.
PlannerModel make_model(const PlannerConfig& config, const Box3& workspace_m,
                        std::span<const CameraConfig> cameras, std::span<const LidarConfig> lidars,
                        std::uint64_t seed = 0, NoFly no_fly = {});

}  // namespace gnbv
