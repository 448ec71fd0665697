// An RGBD camera on the body. Header only: the planner has the type without the ray tracer.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sensors/lens.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

/// Models of depth noise, defined in sensors/depth_noise.hpp.
enum class DepthNoise { none, released, khoshelham, nguyen, stereo };

struct DepthNoiseConfig {
  DepthNoise model = DepthNoise::none;
  // stereo only: sigma = z^2 * disparity_noise_px / (focal length in pixels * baseline_m)
  double baseline_m = 0.063;
  double disparity_noise_px = 0.1;
};

/// A gimbal turns its camera about body y, positive looks down. A view may choose min_rad,
/// min_rad + step_rad and so on up to max_rad.
struct GimbalConfig {
  double min_rad = deg_to_rad(-30.0);
  double max_rad = deg_to_rad(60.0);
  double step_rad = deg_to_rad(30.0);
};

/// Ascending, min_rad at least. A pitch less than a nanoradian beyond max_rad, by rounding, is
/// max_rad.
inline std::vector<double> pitches_rad(const GimbalConfig& gimbal) {
  constexpr double kRounding_rad = 1e-9;
  std::vector<double> pitches = {gimbal.min_rad};
  for (int i = 1;; ++i) {
    const double pitch_rad = gimbal.min_rad + i * gimbal.step_rad;
    if (pitch_rad > gimbal.max_rad + kRounding_rad) return pitches;
    pitches.push_back(std::min(pitch_rad, gimbal.max_rad));
  }
}

/// The gimbal's pitch nearest to the one wanted, the lower of equals.
inline double nearest_pitch_rad(const GimbalConfig& gimbal, double wanted_rad) {
  const std::vector<double> pitches = pitches_rad(gimbal);
  return *std::min_element(pitches.begin(), pitches.end(), [&](double a, double b) {
    return std::abs(a - wanted_rad) < std::abs(b - wanted_rad);
  });
}

/// Defaults: the forward camera of the paper's simulated RGBD pair (section 3.1.1, Table 1).
struct CameraConfig {
  std::string preset = "rgbd_sim";  // a label: the sensor whose values these began as
  std::string name = "rgbd";
  int width_px = 640;
  int height_px = 480;
  double fov_x_rad = deg_to_rad(60.0);
  double fov_y_rad = deg_to_rad(45.0);
  double fx_px = 0.0;    // 0: of the angles above
  double fy_px = 0.0;    // 0: as fx_px
  double cx_px = 0.0;    // 0: the image's middle; the top left pixel's centre is at 0.5
  double cy_px = 0.0;    // 0: the image's middle
  double skew_px = 0.0;  // added to the column, a focal length further down
  DistortionConfig distortion = {};
  double range_min_m = 0.3;       // along the optical axis; nearer returns are invalid
  double range_max_m = 8.0;       // along the optical axis (a plane, not a sphere; see Lens)
  double return_max_m = 0.0;      // deeper surface gives no return; 0: all up to range_max_m
  double rate_hz = 0.0;           // frames a second in flight; 0: none but one at each view
  double drop_probability = 0.0;  // of a frame to be lost
  Vec3 p_body_m = Vec3::Zero();
  double roll_rad = 0.0;   // about body x, applied first
  double pitch_rad = 0.0;  // about body y: positive looks down; applied second; a gimbal's at rest
  double yaw_rad = 0.0;    // about body z: positive looks left; applied last
  DepthNoiseConfig noise = {};
  std::optional<GimbalConfig> gimbal = {};  // nothing: fixed at pitch_rad
};

/// Where the camera's returns end, along its optical axis. Beyond, up to range_max_m, a pixel says
/// "no return", whatever stands there.
inline double return_end_m(const CameraConfig& c) {
  return c.return_max_m > 0.0 ? std::min(c.return_max_m, c.range_max_m) : c.range_max_m;
}

/// Geometry of a CameraConfig. Pixel (0, 0) is top left; centres lie at half pixels.
struct CameraModel {
  CameraConfig config;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  Isometry T_body_camera = Isometry::Identity();  // optical frame: x right, y down, z forward
  /// Nothing: a pinhole around the image's middle. Else all that the camera sees is what this says.
  std::shared_ptr<const Lens> lens = {};
  Eigen::AlignedBox2d sight = {};      // what the image spans at z = 1
  Eigen::AlignedBox2d sight_rad = {};  // the same as angles from the optical axis

  bool is_radial() const { return lens && lens->is_radial(); }
  /// What range_min_m and range_max_m are compared with.
  double range_of(const Vec3& p_camera_m) const {
    return is_radial() ? p_camera_m.norm() : p_camera_m.z();
  }
  /// Whether a point before the camera is in the image, at whatever range.
  bool has_in_image(const Vec3& p_camera_m) const {
    return lens ? lens->sees(p_camera_m)
                : std::abs(p_camera_m.x()) <= p_camera_m.z() * sight.max().x() &&
                      std::abs(p_camera_m.y()) <= p_camera_m.z() * sight.max().y();
  }

  /// For a camera without a lens: where the ray of the centre of pixel (u, v) meets the plane z = 1
  /// of the optical frame.
  Vec3f ray_camera(int u, int v) const {
    return {static_cast<float>((u + 0.5 - cx_px) / fx_px),
            static_cast<float>((v + 0.5 - cy_px) / fy_px), 1.0F};
  }
};

/// Pixel (x to the right, y down) of a point before the camera, in its optical frame. For any type
/// with focal lengths, centre and lens; NaN where no pixel shows the point.
template <typename Camera>
Eigen::Vector2d pixel_of(const Camera& camera, const Vec3& p_camera_m) {
  if (camera.lens) return camera.lens->pixel_of(p_camera_m);
  return {camera.fx_px * p_camera_m.x() / p_camera_m.z() + camera.cx_px,
          camera.fy_px * p_camera_m.y() / p_camera_m.z() + camera.cy_px};
}

/// Its columns are the optical axes of a level camera that looks ahead, in the body.
inline Eigen::Matrix3d R_body_optical() {
  Eigen::Matrix3d R;
  R << 0, 0, 1,  //
      -1, 0, 0,  //
      0, -1, 0;
  return R;
}

/// The camera's mounting at this pitch.
inline Isometry T_body_camera_at(const CameraConfig& config, double pitch_rad) {
  Isometry T = mounted(config.p_body_m, config.roll_rad, pitch_rad, config.yaw_rad);
  T.rotate(R_body_optical());
  return T;
}

/// Whether the camera is more than a pinhole around the image's middle, as its angles say.
inline bool has_lens(const CameraConfig& c) {
  return c.fx_px != 0.0 || c.fy_px != 0.0 || c.cx_px != 0.0 || c.cy_px != 0.0 || c.skew_px != 0.0 ||
         c.distortion.model != Distortion::none;
}

inline CameraModel make_camera_model(const CameraConfig& config) {
  CameraModel model;
  model.config = config;
  const double tan_x = std::tan(0.5 * config.fov_x_rad);
  const double tan_y = std::tan(0.5 * config.fov_y_rad);
  const auto given_or = [](double given, double otherwise) {
    return given != 0.0 ? given : otherwise;
  };
  model.fx_px = given_or(config.fx_px, 0.5 * config.width_px / tan_x);
  model.fy_px = given_or(given_or(config.fy_px, config.fx_px), 0.5 * config.height_px / tan_y);
  model.cx_px = given_or(config.cx_px, 0.5 * config.width_px);
  model.cy_px = given_or(config.cy_px, 0.5 * config.height_px);
  model.sight = {Eigen::Vector2d(-tan_x, -tan_y), Eigen::Vector2d(tan_x, tan_y)};
  model.sight_rad = {-0.5 * Eigen::Vector2d(config.fov_x_rad, config.fov_y_rad),
                     0.5 * Eigen::Vector2d(config.fov_x_rad, config.fov_y_rad)};
  if (config.distortion.model == Distortion::panorama) {
    model.fx_px = config.width_px / config.fov_x_rad;
    model.fy_px = config.height_px / config.fov_y_rad;
    model.cy_px = config.distortion.k1 * model.fy_px;
  }
  if (has_lens(config)) {
    model.lens = std::make_shared<const Lens>(
        config.width_px, config.height_px,
        Lens::Pinhole{model.fx_px, model.fy_px, model.cx_px, model.cy_px, config.skew_px},
        config.distortion);
    model.sight = model.lens->sight();
    const auto angles = [](const Eigen::Vector2d& tangents) -> Eigen::Vector2d {
      return tangents.array().atan();
    };
    model.sight_rad = {angles(model.sight.min()), angles(model.sight.max())};
    if (model.lens->is_panorama()) {
      const double up_rad = config.distortion.k1;
      model.sight_rad = {Eigen::Vector2d(-0.5 * config.fov_x_rad, -up_rad),
                         Eigen::Vector2d(0.5 * config.fov_x_rad, config.fov_y_rad - up_rad)};
    }
  }
  model.T_body_camera = T_body_camera_at(config, config.pitch_rad);
  return model;
}

/// Volume that the camera sees up to its maximum range.
inline double frustum_m3(const CameraConfig& c) {
  if (has_lens(c)) return make_camera_model(c).lens->unit_m3() * std::pow(c.range_max_m, 3);
  return 4.0 / 3.0 * std::tan(0.5 * c.fov_x_rad) * std::tan(0.5 * c.fov_y_rad) *
         std::pow(c.range_max_m, 3);
}

/// The camera at this pitch of the vehicle's gimbal; a fixed camera stays as it is.
inline CameraModel turned(CameraModel camera, double gimbal_pitch_rad) {
  if (camera.config.gimbal) {
    camera.T_body_camera = T_body_camera_at(camera.config, gimbal_pitch_rad);
  }
  return camera;
}
inline std::vector<CameraModel> turned(std::span<const CameraModel> cameras,
                                       double gimbal_pitch_rad) {
  std::vector<CameraModel> all;
  for (const CameraModel& camera : cameras) all.push_back(turned(camera, gimbal_pitch_rad));
  return all;
}

/// The gimbal of cameras (configs or models), which all have the same (scenarios/problems.cpp).
template <typename Cameras>
std::optional<GimbalConfig> gimbal_of(const Cameras& cameras) {
  for (const auto& camera : cameras) {
    if constexpr (requires { camera.config; }) {
      if (camera.config.gimbal) return camera.config.gimbal;
    } else {
      if (camera.gimbal) return camera.gimbal;
    }
  }
  return std::nullopt;
}

/// The camera fixed at each pitch of its gimbal; the camera itself without one.
inline std::vector<CameraModel> at_all_pitches(const CameraModel& camera) {
  if (!camera.config.gimbal) return {camera};
  std::vector<CameraModel> fixed;
  for (const double pitch_rad : pitches_rad(*camera.config.gimbal)) {
    CameraConfig config = camera.config;
    config.gimbal.reset();
    config.pitch_rad = pitch_rad;
    fixed.push_back(make_camera_model(config));
  }
  return fixed;
}

}  // namespace gnbv
