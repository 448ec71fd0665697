// Vehicles and sensors by name: overlays of a scenario, presets/*/*.yaml.
#pragma once

#include <string_view>

#include "sensors/camera_model.hpp"
#include "sensors/lidar_model.hpp"
#include "sim/flight/vehicle_config.hpp"

namespace gnbv {

/// The vehicle of that name, one of builtin_names("vehicles").
VehicleConfig vehicle_preset(std::string_view name);

/// The camera, or LIDAR, turned into the sensor that its `preset` names: everything but what
/// depends on the vehicle, that is its name, its place and its rotation.
CameraConfig with_preset_values(const CameraConfig& camera);
LidarConfig with_preset_values(const LidarConfig& lidar);

}  // namespace gnbv
