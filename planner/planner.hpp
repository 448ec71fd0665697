// Believes and decides: integrates what the sensors measured, then names the next view.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/map/surface_cloud.hpp"
#include "planner/profiling.hpp"
#include "planner/termination.hpp"
#include "planner/utility.hpp"
#include "planner/view_sampling.hpp"
#include "planner/view_validity.hpp"
#include "planner/visibility.hpp"
#include "sensors/frames.hpp"
#include "sensors/lidar_model.hpp"

namespace gnbv {

struct PlannerConfig {
  OccupancyConfig map;
  CloudConfig cloud;
  double floor_z_m = 0.3;      // returns below are the floor: they clear, but mark nothing
  ProfilingConfig profiling;
  AgvsConfig agvs;
  ValidityConfig validity;
  UtilityConfig utility;
  TerminationConfig termination;
};

}  // namespace gnbv
