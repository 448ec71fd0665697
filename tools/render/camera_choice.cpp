#include "tools/render/camera_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "scenarios/validation_error.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {
namespace {

struct Preset {
  std::string_view name;
  double azimuth_deg;
  double elevation_deg;
};
// a little from above, so that the ground is seen as a plane
constexpr std::array<Preset, 6> kPresets = {{{"iso", -120.0, 28.0},
                                             {"front", -90.0, 8.0},
                                             {"back", 90.0, 8.0},
                                             {"left", 180.0, 8.0},
                                             {"right", 0.0, 8.0},
                                             {"top", -90.0, 90.0}}};

Vec3 vector_at(const nlohmann::json& json, const char* key) {
  const nlohmann::json values = json.value(key, nlohmann::json());
  const bool are_numbers =
      values.is_array() && values.size() == 3 &&
      std::all_of(values.begin(), values.end(), [](const auto& v) { return v.is_number(); });
  const Vec3 p_m = are_numbers ? Vec3(values[0], values[1], values[2]) : Vec3(Vec3::Zero());
  constexpr double kFarthest_m = 1e6;
  if (!are_numbers || !(p_m.cwiseAbs().maxCoeff() < kFarthest_m)) {
    throw BadInput(fmt::format("{}: {} is not three numbers of metres", key, values.dump()));
  }
  return p_m;
}

RenderView read_camera(const std::filesystem::path& path) {
  RenderView view;
  double fov_y_deg = 30.0;
  try {
    const nlohmann::json json = nlohmann::json::parse(read_file(path));
    if (!json.is_object()) throw BadInput("is no object of keys and values");
    for (const auto& [key, value] : json.items()) {
      if (key == "position_m" || key == "target_m" || key == "fov_y_deg") continue;
      throw BadInput(
          fmt::format("{}: no such key; there are position_m, target_m and fov_y_deg", key));
    }
    const Vec3 position_m = vector_at(json, "position_m");
    const Vec3 target_m = vector_at(json, "target_m");
    if (json.contains("fov_y_deg")) {
      if (!json["fov_y_deg"].is_number()) throw BadInput("fov_y_deg: is not a number");
      fov_y_deg = json["fov_y_deg"];
    }
    view.focus_m = (target_m - position_m).norm();
    if (view.focus_m < 1e-6) throw BadInput("target_m: is where position_m is");
    view.T_world_camera = look_at(position_m, target_m);
    view.to_light_world = key_light(view.T_world_camera);
  } catch (const std::exception& error) {
    throw BadInput(fmt::format("{}: {}", path.string(), json_reason(error)));
  }
  if (!(fov_y_deg > 0.0 && fov_y_deg < 180.0)) {
    throw BadInput(
        fmt::format("{}: fov_y_deg: {} is not between 0 and 180", path.string(), fov_y_deg));
  }
  view.fov_y_rad = deg_to_rad(fov_y_deg);
  return view;
}

}  // namespace

CameraChoice choose_camera(const std::string& name_or_file) {
  std::vector<std::string_view> names;
  for (const Preset& preset : kPresets) {
    if (preset.name == name_or_file) {
      return {.angles = {deg_to_rad(preset.azimuth_deg), deg_to_rad(preset.elevation_deg)}};
    }
    names.push_back(preset.name);
  }
  if (!std::filesystem::exists(name_or_file)) {
    throw BadInput(fmt::format("--camera {}: no such file, and no preset ({}there are: {})",
                               name_or_file, did_you_mean(name_or_file, names), join(names)));
  }
  return {.angles = {}, .camera = read_camera(name_or_file)};
}

}  // namespace gnbv
