// What is believed, and the model it is believed by: integrates what the sensors measured. Nothing
// here ever sees the mesh, the world or the vehicle.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/map/scan_insertion.hpp"
#include "planner/map/surface_cloud.hpp"
#include "planner/profiling.hpp"
#include "planner/routes.hpp"
#include "planner/symmetry/symmetry.hpp"
#include "planner/termination.hpp"
#include "planner/utility.hpp"
#include "planner/view/visibility.hpp"
#include "planner/view_sampling.hpp"
#include "planner/view_validity.hpp"

namespace gnbv {

struct PlannerConfig {
  std::string preset = "paper";  // what the switches began as; see presets.hpp
  OccupancyConfig map;
  CloudConfig cloud;
  double floor_z_m = 0.3;  // returns below are the floor: they clear, but mark nothing
  ProfilingConfig profiling;
  AgvsConfig agvs;
  FvsConfig fvs;
  ValidityConfig validity;
  UtilityConfig utility;
  RouteConfig routes;
  SymmetryConfig symmetry;
  TerminationConfig termination;
};

/// What the planner is given once: its settings and what it knows of vehicle and workspace.
struct PlannerModel {
  PlannerModel(const PlannerConfig& config, const Box3& workspace_m,
               std::span<const CameraModel> cameras, std::span<const LidarModel> lidars,
               std::uint64_t seed = 0);

  PlannerConfig config;
  std::uint64_t seed;  // of what the planner leaves to chance
  Box3 workspace_m;
  Box3 navigation_m;
  std::vector<CameraModel> cameras;
  std::vector<LidarModel> lidars;
  ViewRays view_rays;
  double view_voxels;  // of the cameras' frusta together
  bool needs_shadow;   // whether the utility asks for Belief::shadow
};

/// What is believed about the world, and all of it.
struct Belief {
  explicit Belief(const PlannerModel& model);

  OccupancyGrid grid;
  SurfaceCloud cloud;
  ShadowBand shadow;
  double floor_z_m;               // returns below were taken for the floor
  bool has_depth_return = false;  // any camera has seen a surface
};

/// Memory to work in, kept from view to view. No result depends on what it holds.
struct Workbench {
  Workbench(const PlannerModel& model, int thread_count);

  int threads;
  std::vector<ScanInserter> inserters;  // one a frame of a view; the first also for the profile
  std::vector<FrameRays> frame_rays;    // of the view at hand
  std::vector<VisitMarks> marks;        // one a thread
  FrontierMarks frontier_marks;
};

/// Adds the buffered sweeps of the profile in one batch (paper section 2.2).
void integrate_profile(const PlannerModel& model, std::span<const LidarScan> scans,
                       Workbench& bench, Belief& belief);

/// Whether any of the sweeps had a return above the floor.
bool sees_surface(std::span<const LidarScan> scans, std::span<const LidarModel> lidars,
                  double floor_z_m);

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
  std::vector<Vec3> via_world_m = {};  // points on the way there; none: straight
};

/// What was decided so far, oldest first, and how the total entropy went: the memory that sampling,
/// validity and termination look back on.
struct History {
  std::vector<Decision> decisions;
  std::vector<double> entropies_nat;  // as entropy_has_settled() wants them
  std::vector<ViewPose> route;        // of a baseline that plans all views at once
};

/// Where the views were taken, oldest first.
std::vector<Vec3> positions_of(const History& history);

/// Records the outcome of the latest decision's view.
void remember_entropy(const Belief& belief, double entropy_before_nat, History& history);

}  // namespace gnbv
