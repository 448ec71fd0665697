#include "tools/scene/view.hpp"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "scenarios/validation_error.hpp"
#include "sim/core/error.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {
namespace {

Isometry camera_pose(const Vec3& eye_world_m, const Vec3& forward) {
  // seen plumb, "up" is north
  const Vec3 up = std::abs(forward.z()) > 0.999999 ? Vec3::UnitY() : Vec3::UnitZ();
  const Vec3 right = forward.cross(up).normalized();
  Isometry T = Isometry::Identity();
  T.linear().col(0) = right;
  T.linear().col(1) = forward.cross(right);
  T.linear().col(2) = forward;
  T.translation() = eye_world_m;
  return T;
}

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
    throw BadInput("{}: {} is not three numbers of metres", key, values.dump());
  }
  return p_m;
}

RenderView read_camera(const std::filesystem::path& path) {
  RenderView view;
  try {
    const nlohmann::json json = nlohmann::json::parse(read_json_text(path));
    if (!json.is_object()) throw BadInput("is no object of keys and values");
    for (const auto& [key, value] : json.items()) {
      if (key == "position_m" || key == "target_m" || key == "fov_y_deg") continue;
      throw BadInput(key + ": no such key; there are position_m, target_m and fov_y_deg");
    }
    const Vec3 position_m = vector_at(json, "position_m");
    const Vec3 target_m = vector_at(json, "target_m");
    const nlohmann::json fov_y_deg = json.value("fov_y_deg", nlohmann::json(30.0));
    if (!fov_y_deg.is_number() || !(fov_y_deg > 0.0 && fov_y_deg < 180.0)) {
      throw BadInput("fov_y_deg: {} is no number between 0 and 180", fov_y_deg.dump());
    }
    view.fov_y_rad = deg_to_rad(fov_y_deg);
    view.focus_m = (target_m - position_m).norm();
    if (view.focus_m < 1e-6) throw BadInput("target_m: is where position_m is");
    view.T_world_camera = look_at(position_m, target_m);
    view.to_light_world = key_light(view.T_world_camera);
  } catch (const std::exception& error) {
    throw BadInput("{}: {}", path.string(), json_reason(error));
  }
  return view;
}

}  // namespace

Vec3 to_camera(const ViewAngles& angles) {
  const double level = std::cos(angles.elevation_rad);
  return {level * std::cos(angles.azimuth_rad), level * std::sin(angles.azimuth_rad),
          std::sin(angles.elevation_rad)};
}

Isometry look_at(const Vec3& eye_world_m, const Vec3& target_world_m) {
  return camera_pose(eye_world_m, (target_world_m - eye_world_m).normalized());
}

Vec3 key_light(const Isometry& T_world_camera) {
  const Vec3 right = T_world_camera.linear().col(0);  // level, even of a plumb view
  const double behind_rad = std::atan2(right.y(), right.x()) - 0.5 * kPi;
  return to_camera({behind_rad - deg_to_rad(50.0), deg_to_rad(52.0)});
}

RenderView frame_points(std::span<const Vec3> points_world_m, const ViewAngles& angles,
                        int width_px, int height_px, const FrameMargins& margins) {
  if (points_world_m.empty()) throw BadInput("nothing to draw: the scene holds no point");
  if (width_px < 1 || height_px < 1) {
    throw BadInput("picture size {} x {} px: both must be at least 1", width_px, height_px);
  }
  RenderView view;
  view.width_px = width_px;
  view.height_px = height_px;
  // half-angle tangents of the four sides
  const double ty = std::tan(0.5 * view.fov_y_rad);
  const double tx = ty * width_px / height_px;
  const double left = tx * (1.0 - 2.0 * margins.left);
  const double right = tx * (1.0 - 2.0 * margins.right);
  const double top = ty * (1.0 - 2.0 * margins.top);
  const double bottom = ty * (1.0 - 2.0 * margins.bottom);
  if (left + right <= 0.0 || top + bottom <= 0.0) {
    throw BadInput("the margins leave nothing of the picture");
  }
  view.T_world_camera = camera_pose(Vec3::Zero(), -to_camera(angles));
  view.to_light_world = key_light(view.T_world_camera);

  // In the turned frame, (x, y, z) is left of the right side while x - ex <= right (z - ez), and so
  // on: linear in the eye (ex, ey, ez), so that one extreme a side decides.
  constexpr double kInf = std::numeric_limits<double>::infinity();
  std::array<double, 4> least = {kInf, kInf, kInf, kInf};
  double z_min = kInf;
  double z_max = -kInf;
  for (const Vec3& p_world : points_world_m) {
    const Vec3 p = view.T_world_camera.linear().transpose() * p_world;
    least[0] = std::min(least[0], right * p.z() - p.x());
    least[1] = std::min(least[1], left * p.z() + p.x());
    least[2] = std::min(least[2], bottom * p.z() - p.y());
    least[3] = std::min(least[3], top * p.z() + p.y());
    z_min = std::min(z_min, p.z());
    z_max = std::max(z_max, p.z());
  }
  // a single point would put the eye into it
  const double ez = std::min({(least[0] + least[1]) / (left + right),
                              (least[2] + least[3]) / (top + bottom), z_min - 0.1});
  // the middle of what the two sides allow
  const double ex = 0.5 * (right * ez - least[0] + least[1] - left * ez);
  const double ey = 0.5 * (bottom * ez - least[2] + least[3] - top * ez);
  view.T_world_camera.translation() = view.T_world_camera.linear() * Vec3(ex, ey, ez);
  view.focus_m = 0.5 * (z_min + z_max) - ez;
  return view;
}

std::optional<Vec3> project(const RenderView& view, const Vec3& p_world_m) {
  const Vec3 p = view.T_world_camera.inverse() * p_world_m;
  if (p.z() <= 0.0) return std::nullopt;
  const double f_px = px_per_m_at_focus(view) * view.focus_m;
  return Vec3(0.5 * view.width_px + f_px * p.x() / p.z(),
              0.5 * view.height_px + f_px * p.y() / p.z(), p.z());
}

std::array<Vec3, 8> corners_m(const Box3& box_m) {
  std::array<Vec3, 8> corners;
  for (int i = 0; i < 8; ++i) {
    corners[static_cast<std::size_t>(i)] = box_m.corner(static_cast<Box3::CornerType>(i));
  }
  return corners;
}

bool is_within(const RenderView& view, const Vec3& p_world_m) {
  const std::optional<Vec3> px = project(view, p_world_m);
  return px && px->x() >= 0.0 && px->y() >= 0.0 && px->x() <= view.width_px &&
         px->y() <= view.height_px;
}

double px_per_m_at_focus(const RenderView& view) {
  return 0.5 * view.height_px / std::tan(0.5 * view.fov_y_rad) / view.focus_m;
}

CameraChoice choose_camera(const std::string& name_or_file) {
  std::vector<std::string_view> names;
  for (const Preset& preset : kPresets) {
    if (preset.name == name_or_file) {
      return {.angles = {deg_to_rad(preset.azimuth_deg), deg_to_rad(preset.elevation_deg)}};
    }
    names.push_back(preset.name);
  }
  if (!std::filesystem::exists(name_or_file)) {
    throw BadInput("--camera {}: no such file, and no preset ({}there are: {})", name_or_file,
                   did_you_mean(name_or_file, names), join(names));
  }
  return {.angles = {}, .camera = read_camera(name_or_file)};
}

}  // namespace gnbv
