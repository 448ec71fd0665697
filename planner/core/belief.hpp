// What every planner works on: what it is given once (the model), what is believed about the world,
// how measurements are added to that, how a file keeps it, and memory to work in. Nothing here ever
// sees the mesh, the world or the vehicle.
#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/map/frontiers.hpp"
#include "planner/map/scan_insertion.hpp"
#include "planner/motion/config.hpp"
#include "planner/view/visibility.hpp"

namespace gnbv {

/// How what the sensors measured is believed.
struct BeliefConfig {
  OccupancyConfig map = {};
  CloudConfig cloud = {};
  double floor_z_m = 0.3;  // returns below are the floor: they clear, but mark nothing
  Box3 object_bounds_m = kEverywhere_m;
  ShadowConfig shadow = {};
  bool keeps_shadow = false;  // whether anybody asks for Belief::shadow
};

/// What a planner knows of vehicle and workspace, and how it believes.
struct PlannerModel {
  PlannerModel(const BeliefConfig& belief_config, const ValidityConfig& validity_config,
               const Box3& workspace, std::span<const CameraConfig> camera_configs,
               std::span<const LidarConfig> lidar_configs, std::uint64_t mission_seed = 0,
               NoFly mission_no_fly = {});

  BeliefConfig belief;
  ValidityConfig validity;
  ValidityConfig validity_around;  // what blocks the straight way is flown around
  std::uint64_t seed;              // of what a planner leaves to chance
  Box3 workspace_m;
  Box3 navigation_m;
  NoFly no_fly;
  TravelConfig travel = {};
  std::vector<CameraModel> cameras;
  std::vector<LidarModel> lidars;
  /// What looks at a view: the cameras, then the sectors of the LIDARs that do
  /// (sensors/sights.hpp).
  std::vector<CameraModel> sights;
  /// Of each LIDAR: its sectors are sights [first_sector[i], first_sector[i + 1]), maybe none.
  std::vector<std::size_t> first_sector;
  std::optional<GimbalConfig> gimbal;  // of the cameras that have one
  std::vector<double> pitches_rad;     // that it offers; without one only 0
  std::vector<ViewRays> view_rays;     // by those pitches
  double view_voxels = 0.0;            // of what looks, its frusta together, up to maximum range

  GridGeometry geometry() const { return {workspace_m, belief.map.resolution_m}; }
  /// The rays of a view whose gimbal has this pitch, or the nearest that it offers.
  const ViewRays& rays_at(double gimbal_pitch_rad) const;
  /// Whether the gimbal reaches this pitch; without one, only 0 means anything.
  bool can_pitch(double gimbal_pitch_rad) const;
  /// Whether sweeps of this LIDAR are views.
  bool looks(std::size_t lidar) const { return first_sector[lidar] < first_sector[lidar + 1]; }
};

/// Where a camera took a frame, or a LIDAR's sector its part of a sweep, as believed.
struct FramePose {
  int camera = 0;                                  // into PlannerModel::sights
  Isometry T_world_camera = Isometry::Identity();  // optical frame
};

struct Belief {
  explicit Belief(const PlannerModel& model);

  OccupancyGrid grid;
  SurfaceCloud cloud;
  SurfaceCloud ranged;  // what LIDARs saw between views: surface to look at, which covers nothing
  std::vector<FramePose> frame_poses;  // in their order
  ShadowBand shadow;
  double floor_z_m;               // returns below were taken for the floor
  bool has_depth_return = false;  // any view has seen a surface
};

/// Thrown out of a planner that was asked to stop in the middle of its work.
class StopRequested : public std::exception {
 public:
  const char* what() const noexcept override { return "asked to stop"; }
};

/// Memory to work in, kept from view to view, and whether somebody wants the work to stop. No
/// result depends on what it holds.
struct Scratch {
  Scratch(const PlannerModel& model, int thread_count);

  int threads;
  std::function<bool()> should_stop;  // none: nobody asks; any thread may call it
  ScanInserter inserter;
  std::vector<FrameRays> frame_rays;  // of the view at hand
  std::vector<VisitMarks> marks;      // one a thread
  FrontierMarks frontier_marks;

  /// For loops that may take long, several times a second. Throws StopRequested.
  void heed_stop() const {
    if (should_stop && should_stop()) throw StopRequested();
  }
};

/// Adds the buffered sweeps of the profile in one batch (paper section 2.2).
void integrate_profile(const PlannerModel& model, std::span<const LidarScan> scans,
                       Scratch& scratch, Belief& belief);

/// Adds sweeps that were taken between views.
void integrate_sweeps(const PlannerModel& model, std::span<const LidarScan> scans, Scratch& scratch,
                      Belief& belief);

/// Adds sweeps that are views, one after the other, to the map and to the cloud as cameras' frames
/// are.
void integrate_looks(const PlannerModel& model, std::span<const LidarScan> scans, Scratch& scratch,
                     Belief& belief);

/// Adds the frames of one view, camera by camera.
void integrate_view(const PlannerModel& model, std::span<const DepthFrame> frames, Scratch& scratch,
                    Belief& belief);

// profile.map: what was believed after the profile, so that another mission can begin there.

/// Writes all of the belief, exactly. Little-endian: the line "gnbv belief 1", the float64 settings
/// it was made with, has_depth_return, the cloud's points in their order as float32 triples, the
/// voxels as runs of equal ones, the shadow band, and the SHA-256 of it all. Whole or not at all,
/// by rename. Throws BadInput when it cannot be written.
void write_belief(const Belief& belief, const std::filesystem::path& path);

/// The belief of the file, which goes on as the written one would have, bit by bit. Throws BadInput
/// naming the file when it cannot be read, is no belief, is damaged or cut short, or is that of
/// another map than the model's.
/// An OctoMap (.bt, .ot; world frame, metres, z up) gives the map alone: no points, no shadow. Each
/// voxel has the highest log-odds of the leaves that it overlaps, whatever their size, within the
/// clamping bounds; what is occupied below the floor is left out, as returns there are. `notes`
/// gets what that changed. Throws BadInput, too, for one that holds nothing within the workspace.
Belief read_belief(const std::filesystem::path& path, const PlannerModel& model,
                   std::vector<std::string>* notes = nullptr);

}  // namespace gnbv
