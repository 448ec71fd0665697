// Believes and decides: integrates what the sensors measured, then names the next view. Nothing
// here ever sees the mesh, the world or the vehicle.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/map/scan_insertion.hpp"
#include "planner/map/surface_cloud.hpp"
#include "planner/profiling.hpp"
#include "planner/termination.hpp"
#include "planner/utility.hpp"
#include "planner/view_sampling.hpp"
#include "planner/view_validity.hpp"
#include "planner/visibility.hpp"

namespace gnbv {

struct PlannerConfig {
  OccupancyConfig map;
  CloudConfig cloud;
  double floor_z_m = 0.3;  // returns below are the floor: they clear, but mark nothing
  ProfilingConfig profiling;
  AgvsConfig agvs;
  ValidityConfig validity;
  UtilityConfig utility;
  TerminationConfig termination;
};

/// What the planner is given once: its settings and what it knows of vehicle and workspace.
struct PlannerModel {
  PlannerModel(const PlannerConfig& config, const Box3& workspace_m,
               std::span<const CameraModel> cameras, std::span<const LidarModel> lidars);

  PlannerConfig config;
  Box3 workspace_m;
  Box3 navigation_m;
  std::vector<CameraModel> cameras;
  std::vector<LidarModel> lidars;
  ViewRays view_rays;
  double view_voxels;  // of the cameras' frusta together
};

/// What is believed about the world, and all of it.
struct Belief {
  explicit Belief(const PlannerModel& model);

  OccupancyGrid grid;
  SurfaceCloud cloud;
  ShadowBand shadow;
  bool has_depth_return = false;  // any camera has seen a surface
};

/// Memory to work in, kept from view to view. No result depends on what it holds.
struct Workbench {
  Workbench(const PlannerModel& model, int thread_count);

  int threads;
  ScanInserter inserter;
  std::vector<VisitMarks> marks;  // one a thread
};

/// Adds the buffered sweeps of the profile in one batch (paper section 2.2).
void integrate_profile(const PlannerModel& model, std::span<const LidarScan> scans,
                       Workbench& bench, Belief& belief);

/// Adds the frames of one view, camera by camera.
void integrate_view(const PlannerModel& model, std::span<const DepthFrame> frames, Workbench& bench,
                    Belief& belief);

/// A chosen view and why.
struct Decision {
  ViewPose view;
  std::string_view sampler = "start";
  double scale = 1.0;
  int candidates = 0;  // sampled
  int valid = 0;       // of them not rejected
  Score score = {};
};

/// What was decided so far, oldest first, and how the total entropy went: the memory that sampling,
/// validity and termination look back on.
struct History {
  std::vector<Decision> decisions;
  std::vector<double> entropies_nat;  // as entropy_has_settled() wants them
};

/// Records the outcome of the latest decision's view.
void remember_entropy(const Belief& belief, double entropy_before_nat, History& history);

/// The next best view from `current`, or nothing when no sampled view is valid at any scale.
std::optional<Decision> plan_next_view(const PlannerModel& model, const Belief& belief,
                                       const History& history, const ViewPose& current,
                                       Workbench& bench);

}  // namespace gnbv
