// What looks at a view, all of it as cameras: the cameras themselves, and of each LIDAR whose
// sweeps are views the sectors of its field of view, images of azimuths and elevations. Header
// only, as camera_model.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "sensors/camera_model.hpp"
#include "sensors/lidar_model.hpp"

namespace gnbv {

/// Where there is no camera every LIDAR looks.
inline bool looks_at_views(const LidarConfig& lidar, bool has_cameras) {
  return lidar.looks != LidarLooks::profile || !has_cameras;
}

/// Between neighbouring beams, up and down. A rosette fills its field evenly, in the mean.
inline double elevation_step_rad(const LidarConfig& c) {
  if (c.pattern == LidarPattern::spinning && c.rings > 1) {
    return (c.elevation_max_rad - c.elevation_min_rad) / (c.rings - 1);
  }
  if (c.pattern != LidarPattern::rosette) return std::max(azimuth_step_rad(c), 1e-3);
  const double field_sr =
      c.fov_rad * (std::sin(c.elevation_max_rad) - std::sin(c.elevation_min_rad));
  return std::sqrt(field_sr / c.beams);
}

/// Its field of view in parts of at most a quarter turn, a pixel a beam; half a row is seen beyond
/// the lowest and the highest ring. `reach_m`: nothing is looked for beyond.
inline std::vector<CameraConfig> sectors_of(const LidarConfig& c, double reach_m) {
  const double row_rad = elevation_step_rad(c);
  const bool is_rosette = c.pattern == LidarPattern::rosette;
  const double column_rad = is_rosette ? row_rad : std::max(azimuth_step_rad(c), 1e-3);
  const double beyond_rad = is_rosette ? 0.0 : 0.5 * row_rad;
  const bool is_fan = c.pattern == LidarPattern::fan;
  const double high_rad = (is_fan ? 0.0 : c.elevation_max_rad) + beyond_rad;
  const double low_rad = (is_fan ? 0.0 : c.elevation_min_rad) - beyond_rad;
  const double fov_rad = std::max(c.fov_rad, column_rad);
  const int sectors = std::max(1, static_cast<int>(std::ceil(fov_rad / (0.5 * kPi) - 1e-9)));
  CameraConfig sector;
  sector.name = c.name;
  sector.fov_x_rad = fov_rad / sectors;
  sector.fov_y_rad = high_rad - low_rad;
  const auto pixels = [](double span_rad, double step_rad) {
    return std::max(1, static_cast<int>(std::lround(span_rad / step_rad)));
  };
  sector.width_px = pixels(sector.fov_x_rad, column_rad);
  sector.height_px = pixels(sector.fov_y_rad, row_rad);
  sector.distortion.model = Distortion::panorama;
  sector.distortion.max_angle_rad = deg_to_rad(85.0);
  sector.range_min_m = c.range_min_m;
  sector.range_max_m = std::min(c.range_max_m, reach_m);
  sector.rate_hz = c.looks == LidarLooks::flight ? c.rate_hz : 0.0;
  sector.p_body_m = c.p_body_m;
  std::vector<CameraConfig> all;
  for (int i = 0; i < sectors; ++i) {
    const double azimuth_rad = (i + 0.5) * sector.fov_x_rad - 0.5 * fov_rad;
    const Eigen::Matrix3d R =
        T_body_lidar(c).linear() * Eigen::AngleAxisd(azimuth_rad, Vec3::UnitZ()).toRotationMatrix();
    sector.roll_rad = std::atan2(R(2, 1), R(2, 2));
    sector.pitch_rad = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
    sector.yaw_rad = std::atan2(R(1, 0), R(0, 0));
    sector.distortion.k1 = high_rad;  // the image's upper edge
    all.push_back(sector);
  }
  return all;
}

/// The cameras, then the sectors of each LIDAR that looks.
inline std::vector<CameraConfig> sights_of(std::span<const CameraConfig> cameras,
                                           std::span<const LidarConfig> lidars,
                                           const Box3& workspace_m) {
  std::vector<CameraConfig> sights(cameras.begin(), cameras.end());
  for (const LidarConfig& lidar : lidars) {
    if (!looks_at_views(lidar, !cameras.empty())) continue;
    const std::vector<CameraConfig> sectors = sectors_of(lidar, workspace_m.diagonal().norm());
    sights.insert(sights.end(), sectors.begin(), sectors.end());
  }
  return sights;
}

}  // namespace gnbv
