// What is wrong with cameras and LIDARs.
#include <algorithm>
#include <cmath>

#include "planner/planners.hpp"
#include "scenarios/problems.hpp"
#include "scenarios/values.hpp"

namespace gnbv {
namespace {

/// Of either list. Files and messages tell its sensors apart by their names.
template <typename Sensor>
void check_list(const std::vector<Sensor>& sensors, const std::string& list, Problems& out) {
  const auto name_key = [&](std::size_t i) { return fmt::format("{}.{}.name", list, i); };
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    require_below(out, fmt::format("{}.{}.", list, i), "range_min_m", sensors[i].range_min_m,
                  "range_max_m", sensors[i].range_max_m);
    for (std::size_t j = 0; j < i; ++j) {
      if (!require(sensors[i].name != sensors[j].name, out, {name_key(i), name_key(j)},
                   "two {}, {} and {}, are named '{}'", list, j, i, sensors[i].name)) {
        break;
      }
    }
  }
}

/// A vehicle has one gimbal; several cameras may hang on it.
void check_gimbal(const std::vector<CameraConfig>& cameras, Problems& out) {
  const std::optional<GimbalConfig> gimbal = gimbal_of(cameras);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const std::string key = fmt::format("cameras.{}.pitch_deg", i);
    const std::optional<GimbalConfig>& own = cameras[i].gimbal;
    if (!own) continue;
    require_below(out, key + '.', "min", degrees_of(own->min_rad), "max", degrees_of(own->max_rad));
    require(own->min_rad == gimbal->min_rad && own->max_rad == gimbal->max_rad &&
                own->step_rad == gimbal->step_rad,
            out, {key},
            "another gimbal than that of the camera before: cameras that are not fixed hang on "
            "one gimbal, with the same min, max and step");
  }
}

/// The optical axis in the image; a model that goes at least that far; no field of view from square
/// pixels that a file could not hold.
void check_lens(const CameraConfig& c, const std::string& key, Problems& out) {
  constexpr double kLeast_rad = deg_to_rad(1.0);
  constexpr double kMost_rad = deg_to_rad(170.0);
  for (const double fov_rad : {c.fov_x_rad, c.fov_y_rad}) {
    require(fov_rad >= kLeast_rad && fov_rad <= kMost_rad, out,
            {key + "fov_x_deg", key + "fov_y_deg", key + "width_px", key + "height_px"},
            "square pixels make the other field of view {:.3g} degrees; 1 to 170 are allowed",
            rad_to_deg(fov_rad));
  }
  require(c.cx_px <= c.width_px, out, {key + "cx_px", key + "width_px", key + "calibration"},
          "cx_px = {} lies outside the image, width_px = {}", c.cx_px, c.width_px);
  require(c.cy_px <= c.height_px, out, {key + "cy_px", key + "height_px", key + "calibration"},
          "cy_px = {} lies outside the image, height_px = {}", c.cy_px, c.height_px);
  if (c.distortion.model == Distortion::none || c.cx_px > c.width_px || c.cy_px > c.height_px)
    return;
  require(
      make_camera_model(c).sight_rad.sizes().minCoeff() >= kLeast_rad, out,
      {key + "distortion", key + "distortion.k1", key + "distortion.model", key + "calibration"},
      "the model folds within a degree of the optical axis: no image comes of it");
}

}  // namespace

void check_sensors(const Scenario& s, Problems& out) {
  const ProfilingConfig& profiling = s.planner.profiling;
  require(!s.cameras.empty() || !s.lidars.empty(), out, {"cameras"},
          "names no camera, and lidars no LIDAR; at least one has to look");
  check_list(s.cameras, "cameras", out);
  check_gimbal(s.cameras, out);
  for (std::size_t i = 0; i < s.cameras.size(); ++i) {
    const CameraConfig& camera = s.cameras[i];
    const std::string key = fmt::format("cameras.{}.", i);
    check_lens(camera, key, out);
    if (camera.return_max_m == 0.0) continue;
    require_below(out, key, "range_min_m", camera.range_min_m, "return_max_m", camera.return_max_m);
  }
  check_list(s.lidars, "lidars", out);
  for (std::size_t i = 0; i < s.lidars.size(); ++i) {
    const LidarConfig& lidar = s.lidars[i];
    if (lidar.pattern == LidarPattern::fan) continue;
    require_below(out, fmt::format("lidars.{}.", i), "elevation_min_deg",
                  rad_to_deg(lidar.elevation_min_rad), "elevation_max_deg",
                  rad_to_deg(lidar.elevation_max_rad));
  }
  require(!s.lidars.empty() || !flies_a_profile(s), out, {"lidars", "planner.profiling.method"},
          "the profile needs a LIDAR to scan it");
  require(profiling.method != ProfilingMethod::saved || !profiling.file.empty(), out,
          {"planner.profiling.file", "planner.profiling.method"},
          "saved: names no file; an earlier run's profile.map, or an OctoMap (.bt, .ot), has to be "
          "named");
}

}  // namespace gnbv
