// A LIDAR on the body: where its beams go. Header only, as camera_model.hpp.
#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// fan: one plane. spinning: a cone a ring, all azimuths of all rings in a sweep. rosette: a beam
/// that two wedge prisms turn, which draws other points in each sweep.
enum class LidarPattern { fan, spinning, rosette };

/// Which sweeps are views: none, so that it only scans the profile; one at each view; those taken
/// in flight, too.
enum class LidarLooks { profile, views, flight };

/// Defaults: the profiling laser of the paper (180 degrees, 0.1-30 m) with the beams and rate of
/// the released floating_sensor.sdf, tilted down so that it gives the paper's profile.
struct LidarConfig {
  std::string preset = "profiling_sim";  // a label: the sensor whose values these began as
  std::string name = "lidar";
  LidarPattern pattern = LidarPattern::fan;
  LidarLooks looks = LidarLooks::profile;
  int beams = 720;                               // of a sweep; spinning: of each ring
  int rings = 16;                                // spinning, evenly from the lowest to the highest
  double elevation_min_rad = deg_to_rad(-15.0);  // not of a fan
  double elevation_max_rad = deg_to_rad(15.0);
  double fov_rad = kPi;
  double rate_hz = 40.0;
  double range_min_m = 0.1;
  double range_max_m = 30.0;
  Vec3 p_body_m = Vec3::Zero();
  double roll_rad = 0.0;                // about body x, applied first
  double pitch_rad = deg_to_rad(10.0);  // about body y: positive tilts the fan down; second
  double yaw_rad = 0.0;                 // about body z, applied last
  double range_sigma_m = 0.0;           // of each range
  /// Whether the beams of a sweep are taken one after the other while the vehicle moves (fov / 2 pi
  /// of a period, all of it for a rosette); else all at once.
  bool rolling = false;
};

/// From the first beam of a sweep to its last: the head turns evenly, once a period.
inline double sweep_duration_s(const LidarConfig& config) {
  if (!config.rolling) return 0.0;
  const bool is_whole = config.pattern == LidarPattern::rosette;
  return (is_whole ? 1.0 : config.fov_rad / (2.0 * kPi)) / config.rate_hz;
}

/// LIDAR frame: FLU, a fan's beams in its x-y plane, counter-clockwise from -fov/2 to +fov/2.
inline Isometry T_body_lidar(const LidarConfig& config) {
  return mounted(config.p_body_m, config.roll_rad, config.pitch_rad, config.yaw_rad);
}

inline std::size_t beam_count(const LidarConfig& config) {
  const int rings = config.pattern == LidarPattern::spinning ? config.rings : 1;
  return static_cast<std::size_t>(config.beams) * static_cast<std::size_t>(rings);
}

/// Between neighbouring azimuths of a fan or a ring, whose last one is at +fov/2, or a step before
/// it when the ring is closed.
inline double azimuth_step_rad(const LidarConfig& config) {
  const bool is_closed =
      config.pattern == LidarPattern::spinning && config.fov_rad >= 2.0 * kPi - 1e-9;
  const int steps = is_closed ? config.beams : config.beams - 1;
  return steps > 0 ? config.fov_rad / steps : 0.0;
}

/// Azimuth and elevation of a beam, in its frame. Rings are taken together, azimuth by azimuth.
struct BeamAngles {
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
};
inline BeamAngles angles_of_beam(const LidarConfig& c, std::size_t beam) {
  const double step_rad = azimuth_step_rad(c);
  if (c.pattern == LidarPattern::fan) {
    return {-0.5 * c.fov_rad + static_cast<double>(beam) * step_rad, 0.0};
  }
  const double middle_rad = 0.5 * (c.elevation_min_rad + c.elevation_max_rad);
  const double half_rad = 0.5 * (c.elevation_max_rad - c.elevation_min_rad);
  const auto rings = static_cast<std::size_t>(c.rings);
  const double up =
      c.rings > 1 ? 2.0 * static_cast<double>(beam % rings) / (c.rings - 1) - 1.0 : 0.0;
  return {-0.5 * c.fov_rad + static_cast<double>(beam / rings) * step_rad,
          middle_rad + up * half_rad};
}

/// A rosette's at that time. Two prisms of equal power turn the beam by the sum of two vectors that
/// revolve at the rates of the Mid-40's, 7294 and -4664 a minute (first order: Marshall, SPIE 3787,
/// 1999; rates: Liu, Zhang, Hong, IEEE/ASME Trans. Mechatronics 27, 2022). Drawn to the field of
/// view. One that looks all around has no such formula in public; its azimuth revolves at one rate
/// and its elevation swings at the other.
inline BeamAngles angles_of_rosette(const LidarConfig& c, double time_s) {
  constexpr double kFirst_hz = 7294.0 / 60.0;
  constexpr double kSecond_hz = -4664.0 / 60.0;
  const double a = 2.0 * kPi * std::fmod(kFirst_hz * time_s, 1.0);
  const double b = 2.0 * kPi * std::fmod(kSecond_hz * time_s, 1.0);
  const double middle_rad = 0.5 * (c.elevation_min_rad + c.elevation_max_rad);
  const double half_rad = 0.5 * (c.elevation_max_rad - c.elevation_min_rad);
  if (c.fov_rad >= 2.0 * kPi - 1e-9) {
    return {wrap_angle_rad(a), middle_rad + half_rad * std::sin(b)};
  }
  return {0.25 * c.fov_rad * (std::cos(a) + std::cos(b)),
          middle_rad + 0.5 * half_rad * (std::sin(a) + std::sin(b))};
}

/// Unit direction, in the LIDAR frame.
inline Vec3f direction_of(const BeamAngles& angles) {
  const double level = std::cos(angles.elevation_rad);
  return Vec3(level * std::cos(angles.azimuth_rad), level * std::sin(angles.azimuth_rad),
              std::sin(angles.elevation_rad))
      .cast<float>();
}

inline Vec3f beam_lidar(const LidarConfig& config, std::size_t beam) {
  return direction_of(angles_of_beam(config, beam));
}

/// Geometry of a LidarConfig.
struct LidarModel {
  LidarConfig config;
  Isometry T_body_lidar = Isometry::Identity();
  std::vector<Vec3f> beams_lidar;  // beam_lidar() of every beam; a rosette has none that stay

  /// Unit directions of the sweep that begins then, in its order, in the LIDAR frame; `memory` may
  /// hold them.
  std::span<const Vec3f> beams_at(double begin_s, std::vector<Vec3f>& memory) const {
    if (config.pattern != LidarPattern::rosette) return beams_lidar;
    memory.clear();
    for (int beam = 0; beam < config.beams; ++beam) {
      const double at_s = begin_s + beam / (config.beams * config.rate_hz);
      memory.push_back(direction_of(angles_of_rosette(config, at_s)));
    }
    return memory;
  }
};

inline LidarModel make_lidar_model(const LidarConfig& config) {
  LidarModel model = {config, T_body_lidar(config), {}};
  if (config.pattern == LidarPattern::rosette) return model;
  for (std::size_t beam = 0; beam < beam_count(config); ++beam) {
    model.beams_lidar.push_back(beam_lidar(config, beam));
  }
  return model;
}

}  // namespace gnbv
