// The planner's settings, assembled from those of its parts, and the two readings of the method:
// the paper's, and that of the code its authors released.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "planner/core/planner.hpp"
#include "planner/guided/utility.hpp"
#include "planner/guided/view_sampling.hpp"
#include "planner/map/occupancy_grid.hpp"
#include "planner/map/surface_cloud.hpp"
#include "planner/motion/config.hpp"
#include "planner/profiling.hpp"
#include "planner/route/route_planners.hpp"
#include "planner/symmetry/symmetry.hpp"
#include "planner/tour/config.hpp"

namespace gnbv {

struct PlannerConfig {
  std::string preset = "paper";  // what the switches began as; see set_preset_switches()
  OccupancyConfig map;
  CloudConfig cloud;
  double floor_z_m = 0.3;  // returns below are the floor: they clear, but mark nothing
  Box3 object_bounds_m = kEverywhere_m;  // where entropy and information count
  ProfilingConfig profiling;
  AgvsConfig agvs;
  FvsConfig fvs;
  ValidityConfig validity;
  UtilityConfig utility;
  RouteConfig routes;
  OracleConfig oracle;
  TourConfig tour;
  SymmetryConfig symmetry;
  TerminationConfig termination;
};

/// The paper's text, and its code where the text is silent; the code that its authors released in
/// 2017 (master, 5750058); the code behind the paper with its settings of 5 August 2018 (branch
/// frontier_viewgenerator_update, e45ff3f). See FIDELITY.md. And ours: flown on from take-off
/// without a profile (docs/decisions, 111), the paper's otherwise.
constexpr std::string_view kTakeoff = "takeoff";
constexpr std::array<std::string_view, 4> kPlannerPresets = {"paper", "released", "authors_2018",
                                                             kTakeoff};

/// Sets every switch in which they differ (FIDELITY.md lists them) as `config.preset` says, and
/// nothing else: resolution, weights and sizes stay the scenario's. `before`: the preset that the
/// switches were set by. Requires a name of kPlannerPresets.
void set_preset_switches(PlannerConfig& config, std::string_view before = "paper");

}  // namespace gnbv
