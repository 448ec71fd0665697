#include <fmt/format.h>

#include <algorithm>

#include "scenarios/builtin.hpp"
#include "scenarios/reader.hpp"
#include "scenarios/values.hpp"

namespace gnbv {
namespace {

/// `px4` of a vehicle's preset: what its commander is set to, by PX4's names.
void read_px4(const YamlNode& px4, CommanderParameters& commander, ValidationErrors& errors) {
  for (const YamlEntry& entry : px4.entries) {
    const Px4Parameter* const parameter = find_px4_parameter(entry.key);
    if (parameter == nullptr) {
      errors.add(entry.location, entry.key, "", "is no parameter of PX4's commander");
      continue;
    }
    Field field;
    field.allowed = {parameter->min, parameter->max};
    double value = 0.0;
    for (const ValueError& error : read_value(entry.value, field, "", &value)) {
      errors.add(entry.location, entry.key, entry.value.text, error.what);
    }
    set_px4_value(commander, *parameter, value);
  }
}

/// What the preset's overlay makes of a scenario at its defaults.
Scenario overlaid(std::string_view folder, std::string_view name) {
  const std::vector<BuiltinFile> files = builtin_files(folder);
  const auto file = std::ranges::find(files, name, &BuiltinFile::name);
  GNBV_CHECK(file != files.end(), "there is no preset '{}' among the {}", name, folder);
  ValidationErrors errors;
  const SourceLocation start = {fmt::format("presets/{}/{}.yaml", folder, name), 1, 0};
  std::optional<YamlNode> root = parse_document(std::string(file->yaml), start, errors);
  errors.throw_if_any();
  YamlNode px4;
  std::erase_if(root->entries, [&](YamlEntry& entry) {
    if (entry.key != "px4") return false;
    px4 = std::move(entry.value);
    return true;
  });
  Scenario scenario;
  SourceLocations locations;
  read_scenario(*root, "", scenario, errors, locations);
  read_px4(px4, scenario.vehicle.autopilot.commander, errors);
  errors.throw_if_any();
  return scenario;
}

template <typename Config>
Config mounted_as(Config sensor, const Config& on_vehicle) {
  sensor.preset = on_vehicle.preset;
  sensor.name = on_vehicle.name;
  sensor.p_body_m = on_vehicle.p_body_m;
  sensor.roll_rad = on_vehicle.roll_rad;
  sensor.pitch_rad = on_vehicle.pitch_rad;
  sensor.yaw_rad = on_vehicle.yaw_rad;
  return sensor;
}

}  // namespace

VehicleConfig vehicle_preset(std::string_view name) {
  VehicleConfig vehicle = overlaid("vehicles", name).vehicle;
  vehicle.preset = name;
  return vehicle;
}

CameraConfig with_preset_values(const CameraConfig& camera) {
  CameraConfig config = mounted_as(overlaid("cameras", camera.preset).cameras.front(), camera);
  config.gimbal = camera.gimbal;
  return config;
}

LidarConfig with_preset_values(const LidarConfig& lidar) {
  return mounted_as(overlaid("lidars", lidar.preset).lidars.front(), lidar);
}

}  // namespace gnbv
