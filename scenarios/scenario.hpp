// What to run: one value, assembled from every module's own config, read once.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "planner/config.hpp"
#include "sensors/camera_model.hpp"
#include "sensors/lidar_model.hpp"
#include "sim/flight/guidance.hpp"
#include "sim/flight/vehicle_config.hpp"
#include "sim/mesh/mesh_file.hpp"

namespace gnbv {

/// Structures that assets/ generates, by the name StructureConfig::builtin takes.
constexpr std::array<std::string_view, 5> kStructureNames = {"aircraft", "power_plant", "lab_model",
                                                             "lab_airplane", "smoke"};

struct StructureConfig {
  std::string builtin = "aircraft";  // used when file.path is empty
  MeshFileConfig file;
  bool ground = true;
};

/// The built-in name, or the path of the mesh file.
inline const std::string& structure_name(const StructureConfig& structure) {
  return structure.file.path.empty() ? structure.builtin : structure.file.path;
}

/// Where the views begin; the paper is silent, the default is the authors' batch configuration.
/// A seed moves it uniformly within +- jitter, clipped to the navigation box.
struct StartConfig {
  ViewPose pose = {Vec3(0.0, -20.0, 5.0), deg_to_rad(90.0)};
  Vec3 jitter_m = Vec3(5.0, 1.0, 2.0);
  double jitter_yaw_rad = 0.0;
};

/// What only a benchmark may know: it is asked of the truth, never of the belief.
struct BenchmarkConfig {
  double stop_at_coverage = 0.0;  // of the surface seen from outside, at 0.05 m; 0 switches it off
};

/// What missions are scored by.
struct ScoreConfig {
  std::vector<double> sizes_m = {0.05, 0.10, 0.50};  // the paper's are measured in any case
};

struct Scenario {
  std::string name = "unnamed";
  std::uint64_t seed = 1;
  Box3 workspace_m = Box3(Vec3(-20, -20, 0), Vec3(20, 20, 20));
  StructureConfig structure;
  std::vector<CameraConfig> cameras;
  std::vector<LidarConfig> lidars = {LidarConfig{}};
  VehicleConfig vehicle;
  GuidanceConfig guidance;
  StartConfig start;
  PlannerConfig planner;
  BenchmarkConfig benchmark;
  ScoreConfig score;
};

}  // namespace gnbv
