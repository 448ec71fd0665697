#include "scenarios/sensor_presets.hpp"

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// Field of view as in Table 1. 640 x 370 pixels make a pixel of it square to 0.2 %, about as many
/// as the device's smallest mode has (672 x 376). Range and noise by its maker's data sheet: 0.1 to
/// 15 m, at its best up to 9 m, a baseline of 63 mm; a disparity error of 0.1 pixels of its 1280 x
/// 720 image is 0.05 pixels of this one: 2.48e-3 z^2.
CameraConfig zed_mini() {
  CameraConfig c;
  c.width_px = 640;
  c.height_px = 370;
  c.fov_x_rad = deg_to_rad(90.0);
  c.fov_y_rad = deg_to_rad(60.0);
  c.range_min_m = 0.1;
  c.range_max_m = 9.0;
  c.noise = {DepthNoise::stereo, 0.063, 0.05};
  return c;
}

/// 270 degrees in steps of a quarter, forty sweeps a second, one beam after the other.
LidarConfig hokuyo() {
  LidarConfig c;
  c.beams = 1081;
  c.fov_rad = deg_to_rad(270.0);
  c.rate_hz = 40.0;
  c.rolling = true;
  return c;
}

/// An accuracy of +-30 mm up to 10 m, read as three standard deviations and used at every range.
LidarConfig utm_30lx() {
  LidarConfig c = hokuyo();
  c.range_min_m = 0.1;
  c.range_max_m = 30.0;
  c.range_sigma_m = 0.01;
  return c;
}

/// An accuracy of +-40 mm, read as three standard deviations.
LidarConfig ust_10lx() {
  LidarConfig c = hokuyo();
  c.range_min_m = 0.06;
  c.range_max_m = 10.0;
  c.range_sigma_m = 0.04 / 3.0;
  return c;
}

CameraConfig camera_of(std::string_view preset) {
  if (preset == "rgbd_sim") return {};
  if (preset == "zed_mini") return zed_mini();
  throw BrokenInvariant("camera preset outside kCameraPresets");
}

LidarConfig lidar_of(std::string_view preset) {
  if (preset == "profiling_sim") return {};
  if (preset == "hokuyo_utm_30lx") return utm_30lx();
  if (preset == "hokuyo_ust_10lx") return ust_10lx();
  throw BrokenInvariant("LIDAR preset outside kLidarPresets");
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

CameraConfig with_preset_values(const CameraConfig& camera) {
  CameraConfig config = mounted_as(camera_of(camera.preset), camera);
  config.gimbal = camera.gimbal;
  return config;
}

LidarConfig with_preset_values(const LidarConfig& lidar) {
  return mounted_as(lidar_of(lidar.preset), lidar);
}

}  // namespace gnbv
