// The YAML files of this folder, compiled in: scenarios, and presets of vehicles and sensors, which
// are overlays of a scenario (presets/*/*.yaml).
#pragma once

#include <string_view>
#include <vector>

#include "sensors/camera_model.hpp"
#include "sensors/lidar_model.hpp"
#include "sim/flight/vehicle_config.hpp"

namespace gnbv {

struct BuiltinFile {
  std::string_view folder;  // "scenarios", or a folder of presets: "vehicles", "cameras", "lidars"
  std::string_view name;    // the file's, without .yaml
  std::string_view yaml;
};

/// Those of a folder, sorted by name.
std::vector<BuiltinFile> builtin_files(std::string_view folder);
std::vector<std::string_view> builtin_names(std::string_view folder);

/// The vehicle of that name, one of builtin_names("vehicles").
VehicleConfig vehicle_preset(std::string_view name);

/// The camera, or LIDAR, turned into the sensor that its `preset` names: everything but what
/// depends on the vehicle, that is its name, its place and its rotation.
CameraConfig with_preset_values(const CameraConfig& camera);
LidarConfig with_preset_values(const LidarConfig& lidar);

}  // namespace gnbv
