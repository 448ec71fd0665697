// What a lens does to directions, and its inverse.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// panorama: rows and columns are even steps of angle; no camera's, but what a sector of a LIDAR
/// sees.
enum class Distortion { none, brown_conrady, kannala_brandt, panorama };

/// brown_conrady: OpenCV's k1 k2 p1 p2 k3 k4 k5 k6, the last three a rational model's (Brown 1966;
/// Claus, Fitzgibbon 2005). kannala_brandt: OpenCV's fisheye, k1 to k4 (Kannala, Brandt 2006).
/// panorama: k1 is the elevation of the upper edge, in radians.
struct DistortionConfig {
  Distortion model = Distortion::none;
  double k1 = 0.0, k2 = 0.0, k3 = 0.0, k4 = 0.0, k5 = 0.0, k6 = 0.0, p1 = 0.0, p2 = 0.0;
  double max_angle_rad = deg_to_rad(85.0);  // what lies farther off the axis is not seen
};

const char* distortion_name(Distortion model);
/// Throws BadInput for a name that is none of them.
Distortion distortion_named(const std::string& name);

/// In OpenCV's order; a fisheye has those named k1 to k4 alone.
constexpr std::array<std::pair<const char*, double DistortionConfig::*>, 8> kCoefficients = {
    {{"k1", &DistortionConfig::k1},
     {"k2", &DistortionConfig::k2},
     {"p1", &DistortionConfig::p1},
     {"p2", &DistortionConfig::p2},
     {"k3", &DistortionConfig::k3},
     {"k4", &DistortionConfig::k4},
     {"k5", &DistortionConfig::k5},
     {"k6", &DistortionConfig::k6}}};

/// As OpenCV, COLMAP and ROS list them: none, eight, or a fisheye's four.
std::vector<double> coefficients_of(const DistortionConfig& d);

/// Maps directions (x, y, 1) of the optical frame to places in the image, in pixels: (0, 0) is the
/// outer corner of the top left one, its centre (0.5, 0.5).
class Lens {
 public:
  using Vec2 = Eigen::Vector2d;

  struct Pinhole {
    double fx_px, fy_px, cx_px, cy_px, skew_px;
  };

  Lens(int width_px, int height_px, const Pinhole& pinhole, const DistortionConfig& distortion);

  const Pinhole& pinhole() const { return pinhole_; }
  const DistortionConfig& distortion() const { return distortion_; }
  /// Neither skewed nor distorted.
  bool is_pinhole() const {
    return distortion_.model == Distortion::none && pinhole_.skew_px == 0.0;
  }
  /// Ranges count along the ray, not along the optical axis: so wide a plane is no range.
  bool is_radial() const { return distortion_.model >= Distortion::kannala_brandt; }
  bool is_panorama() const { return distortion_.model == Distortion::panorama; }
  /// What the image spans at z = 1; what is distorted does not fill it.
  const Eigen::AlignedBox2d& sight() const { return sight_; }
  /// Of (x, y): the model is one to one within it.
  double radius_max() const { return radius_max_; }

  /// Of (x, y) within radius_max().
  Vec2 distort(const Vec2& xy) const;

  /// Its inverse; nothing where no direction within radius_max() goes.
  std::optional<Vec2> undistort(const Vec2& distorted) const;

  /// NaN for a point that no ray of the model meets.
  Vec2 pixel_of(const Vec3& p_camera_m) const;

  /// (x, y) of the direction that a place of the image shows; nothing outside the model.
  std::optional<Vec2> direction_at(double u_px, double v_px) const;

  bool sees(const Vec3& p_camera_m) const;

  /// direction_at() of every pixel's centre, (height, width) row-major; NaN: none. Made when first
  /// asked for.
  const std::vector<Eigen::Vector2f>& directions() const;

  /// Volume that it sees to a range of 1.
  double unit_m3() const;

 private:
  /// The distorted radius, of the undistorted one or, for a fisheye, of the angle off the axis.
  double spread(double s) const;
  double slope(double s) const;
  /// To the right and down, as a LIDAR's azimuth and elevation.
  static Vec2 xy_to_angles(const Vec2& xy);
  Vec2 decentred(const Vec2& xy) const;

  /// As far as the argument of spread() goes before the model folds: there its inverse has no more
  /// digits.
  double find_argument_max() const;

  /// The argument of spread() that gives this radius; argument_max_ for larger ones.
  double argument_of(double radius) const;

  /// Newton's steps on the whole model; whether they met `distorted`.
  bool refine(const Vec2& distorted, Vec2& xy) const;

  /// The border of what is seen is the image's, or the model's within it.
  Eigen::AlignedBox2d find_sight() const;

  int width_px_, height_px_;
  Pinhole pinhole_;
  DistortionConfig distortion_;
  double argument_max_, radius_max_;
  Eigen::AlignedBox2d sight_;
  mutable std::once_flag made_;
  mutable std::vector<Eigen::Vector2f> directions_;
};

}  // namespace gnbv
