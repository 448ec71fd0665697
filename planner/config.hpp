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
  ProfilingConfig profiling;
  AgvsConfig agvs;
  FvsConfig fvs;
  ValidityConfig validity;
  UtilityConfig utility;
  RouteConfig routes;
  TourConfig tour;
  SymmetryConfig symmetry;
  TerminationConfig termination;
};

constexpr std::array<std::string_view, 2> kPlannerPresets = {"paper", "released"};

/// Sets every switch in which the two differ (FIDELITY.md lists them) as `config.preset` says, and
/// nothing else: resolution, weights and sizes stay the scenario's. Requires a name of
/// kPlannerPresets.
void set_preset_switches(PlannerConfig& config);

}  // namespace gnbv
