// What the planner is given once: its settings, and what it knows of vehicle and workspace.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner/config.hpp"
#include "planner/map/no_fly.hpp"
#include "planner/view/visibility.hpp"
#include "sensors/camera_model.hpp"
#include "sensors/lidar_model.hpp"

namespace gnbv {

struct PlannerModel {
  PlannerModel(const PlannerConfig& config, const Box3& workspace_m,
               std::span<const CameraModel> cameras, std::span<const LidarModel> lidars,
               std::uint64_t seed = 0, NoFly no_fly = {}, OwnScores own_scores = {});

  PlannerConfig config;
  std::uint64_t seed;  // of what the planner leaves to chance
  Box3 workspace_m;
  Box3 navigation_m;
  NoFly no_fly;
  std::vector<CameraModel> cameras;
  std::vector<LidarModel> lidars;
  std::optional<GimbalConfig> gimbal;  // of the cameras that have one
  std::vector<double> pitches_rad;     // that it offers; without one only 0
  std::vector<ViewRays> view_rays;     // by those pitches
  double view_voxels;                  // of the cameras' frusta together
  bool needs_shadow;                   // whether the utility asks for Belief::shadow
  OwnScores own_scores;                // asked where the utility is the user's own

  /// The rays of a view whose gimbal has this pitch, or the nearest that it offers.
  const ViewRays& rays_at(double gimbal_pitch_rad) const;
  /// Whether the gimbal reaches this pitch; without one, only 0 means anything.
  bool can_pitch(double gimbal_pitch_rad) const;
};

}  // namespace gnbv
