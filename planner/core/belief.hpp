// What is believed about the world, and how what the sensors measured is added to it. Nothing here
// ever sees the mesh, the world or the vehicle.
#pragma once

#include <span>

#include "planner/map/occupancy_grid.hpp"
#include "planner/map/surface_cloud.hpp"
#include "planner/view/shadow_band.hpp"
#include "sensors/frames.hpp"

namespace gnbv {

struct PlannerModel;
struct Scratch;

struct Belief {
  explicit Belief(const PlannerModel& model);

  OccupancyGrid grid;
  SurfaceCloud cloud;
  ShadowBand shadow;
  double floor_z_m;               // returns below were taken for the floor
  bool has_depth_return = false;  // any camera has seen a surface
};

/// Adds the buffered sweeps of the profile in one batch (paper section 2.2).
void integrate_profile(const PlannerModel& model, std::span<const LidarScan> scans,
                       Scratch& scratch, Belief& belief);

/// Adds the frames of one view, camera by camera.
void integrate_view(const PlannerModel& model, std::span<const DepthFrame> frames, Scratch& scratch,
                    Belief& belief);

}  // namespace gnbv
