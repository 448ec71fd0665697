// What every planner is given once: what it knows of vehicle and workspace, and how it believes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner/map/config.hpp"
#include "planner/motion/no_fly.hpp"
#include "planner/motion/view_checker.hpp"
#include "planner/view/config.hpp"
#include "planner/view/visibility.hpp"
#include "sensors/camera_model.hpp"
#include "sensors/lidar_model.hpp"

namespace gnbv {

/// How what the sensors measured is believed.
struct BeliefConfig {
  OccupancyConfig map = {};
  CloudConfig cloud = {};
  double floor_z_m = 0.3;  // returns below are the floor: they clear, but mark nothing
  ShadowConfig shadow = {};
  bool keeps_shadow = false;  // whether anybody asks for Belief::shadow
};

struct PlannerModel {
  PlannerModel(const BeliefConfig& belief_config, const ValidityConfig& validity_config,
               const Box3& workspace, std::span<const CameraModel> camera_models,
               std::span<const LidarModel> lidar_models, std::uint64_t mission_seed = 0,
               NoFly mission_no_fly = {});

  BeliefConfig belief;
  ValidityConfig validity;
  std::uint64_t seed;  // of what a planner leaves to chance
  Box3 workspace_m;
  Box3 navigation_m;
  NoFly no_fly;
  std::vector<CameraModel> cameras;
  std::vector<LidarModel> lidars;
  std::optional<GimbalConfig> gimbal;  // of the cameras that have one
  std::vector<double> pitches_rad;     // that it offers; without one only 0
  std::vector<ViewRays> view_rays;     // by those pitches
  double view_voxels;                  // of the cameras' frusta together

  GridGeometry geometry() const { return {workspace_m, belief.map.resolution_m}; }
  /// The rays of a view whose gimbal has this pitch, or the nearest that it offers.
  const ViewRays& rays_at(double gimbal_pitch_rad) const;
  /// Whether the gimbal reaches this pitch; without one, only 0 means anything.
  bool can_pitch(double gimbal_pitch_rad) const;
};

}  // namespace gnbv
