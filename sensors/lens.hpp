// What a lens does to directions, and its inverse. Header only, as camera_model.hpp.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/error.hpp"
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

inline const char* distortion_name(Distortion model) {
  return std::array{"none", "brown_conrady", "kannala_brandt",
                    "panorama"}[static_cast<std::size_t>(model)];
}
/// Throws BadInput for a name that is none of them.
inline Distortion distortion_named(const std::string& name) {
  for (const Distortion model :
       {Distortion::none, Distortion::brown_conrady, Distortion::kannala_brandt}) {
    if (name == distortion_name(model)) return model;
  }
  throw BadInput("no model of distortion is named '" + name + "'");
}

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
inline std::vector<double> coefficients_of(const DistortionConfig& d) {
  if (d.model == Distortion::kannala_brandt) return {d.k1, d.k2, d.k3, d.k4};
  std::vector<double> all;
  if (d.model == Distortion::none || d.model == Distortion::panorama) return all;
  for (const auto& [name, member] : kCoefficients) all.push_back(d.*member);
  return all;
}

/// Maps directions (x, y, 1) of the optical frame to places in the image, in pixels: (0, 0) is the
/// outer corner of the top left one, its centre (0.5, 0.5).
class Lens {
 public:
  using Vec2 = Eigen::Vector2d;

  struct Pinhole {
    double fx_px, fy_px, cx_px, cy_px, skew_px;
  };

  Lens(int width_px, int height_px, const Pinhole& pinhole, const DistortionConfig& distortion)
      : width_px_(width_px),
        height_px_(height_px),
        pinhole_(pinhole),
        distortion_(distortion),
        argument_max_(find_argument_max()),
        radius_max_(is_radial() ? std::tan(argument_max_) : argument_max_),
        sight_(find_sight()) {}

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
  Vec2 distort(const Vec2& xy) const {
    if (distortion_.model == Distortion::none) return xy;
    if (is_panorama()) return xy_to_angles(xy);
    const double r = xy.norm();
    if (is_radial()) return r > 0.0 ? Vec2(spread(std::atan(r)) / r * xy) : xy;
    return xy * (r > 0.0 ? spread(r) / r : 1.0) + decentred(xy);
  }

  /// Its inverse; nothing where no direction within radius_max() goes.
  std::optional<Vec2> undistort(const Vec2& distorted) const {
    Vec2 xy = distorted;
    if (is_panorama()) {
      if (distorted.cwiseAbs().maxCoeff() >= argument_max_) return std::nullopt;
      xy.x() = std::tan(distorted.x());
      xy.y() = std::tan(distorted.y()) * std::hypot(1.0, xy.x());
    } else if (distortion_.model != Distortion::none) {
      const double r = distorted.norm();
      if (r > 0.0) {
        const double argument = argument_of(r);
        xy = distorted / r * (is_radial() ? std::tan(argument) : argument);
      }
      if (!is_radial() && !refine(distorted, xy)) return std::nullopt;
      if (is_radial() && r > spread(argument_max_)) return std::nullopt;
    }
    if (!(xy.norm() <= radius_max_)) return std::nullopt;
    return xy;
  }

  /// NaN for a point that no ray of the model meets.
  Vec2 pixel_of(const Vec3& p_camera_m) const {
    const Vec2 xy = p_camera_m.head<2>() / p_camera_m.z();
    if (!(p_camera_m.z() > 0.0) || xy.norm() > radius_max_) {
      return Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
    }
    const Vec2 d = distort(xy);
    return {pinhole_.fx_px * d.x() + pinhole_.skew_px * d.y() + pinhole_.cx_px,
            pinhole_.fy_px * d.y() + pinhole_.cy_px};
  }

  /// (x, y) of the direction that a place of the image shows; nothing outside the model.
  std::optional<Vec2> direction_at(double u_px, double v_px) const {
    const double y = (v_px - pinhole_.cy_px) / pinhole_.fy_px;
    return undistort({(u_px - pinhole_.cx_px - pinhole_.skew_px * y) / pinhole_.fx_px, y});
  }

  bool sees(const Vec3& p_camera_m) const {
    const Vec2 px = pixel_of(p_camera_m);
    return px.x() >= 0.0 && px.x() <= width_px_ && px.y() >= 0.0 && px.y() <= height_px_;
  }

  /// direction_at() of every pixel's centre, (height, width) row-major; NaN: none. Made when first
  /// asked for.
  const std::vector<Eigen::Vector2f>& directions() const {
    std::call_once(made_, [&] {
      directions_.reserve(static_cast<std::size_t>(width_px_) *
                          static_cast<std::size_t>(height_px_));
      for (int v = 0; v < height_px_; ++v) {
        for (int u = 0; u < width_px_; ++u) {
          const Vec2 none = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
          directions_.push_back(direction_at(u + 0.5, v + 0.5).value_or(none).cast<float>());
        }
      }
    });
    return directions_;
  }

  /// Volume that it sees to a range of 1.
  double unit_m3() const {
    if (is_panorama()) {
      const double up_rad = pinhole_.cy_px / pinhole_.fy_px;
      const double down_rad = height_px_ / pinhole_.fy_px - up_rad;
      return width_px_ / pinhole_.fx_px * (std::sin(up_rad) + std::sin(down_rad)) / 3.0;
    }
    constexpr int kRings = 128;
    constexpr int kBearings = 256;
    const double step_rad = std::atan(radius_max_) / kRings;
    double sum = 0.0;
    for (int i = 0; i < kRings * kBearings; ++i) {
      const double off_rad = (i / kBearings + 0.5) * step_rad;
      const double bearing_rad = 2.0 * kPi * (i % kBearings) / kBearings;
      const Vec3 along(std::sin(off_rad) * std::cos(bearing_rad),
                       std::sin(off_rad) * std::sin(bearing_rad), std::cos(off_rad));
      if (!sees(along)) continue;
      sum += std::sin(off_rad) / (is_radial() ? 1.0 : std::pow(along.z(), 3));
    }
    return sum * step_rad * 2.0 * kPi / kBearings / 3.0;
  }

 private:
  /// The distorted radius, of the undistorted one or, for a fisheye, of the angle off the axis.
  double spread(double s) const {
    const DistortionConfig& d = distortion_;
    const double s2 = s * s;
    if (is_radial()) return s * (1.0 + s2 * (d.k1 + s2 * (d.k2 + s2 * (d.k3 + s2 * d.k4))));
    return s * (1.0 + s2 * (d.k1 + s2 * (d.k2 + s2 * d.k3))) /
           (1.0 + s2 * (d.k4 + s2 * (d.k5 + s2 * d.k6)));
  }
  double slope(double s) const {
    const double h = 1e-6 * (1.0 + s);
    return (spread(s + h) - spread(s - h)) / (2.0 * h);
  }
  /// To the right and down, as a LIDAR's azimuth and elevation.
  static Vec2 xy_to_angles(const Vec2& xy) {
    return {std::atan(xy.x()), std::atan(xy.y() / std::hypot(1.0, xy.x()))};
  }
  Vec2 decentred(const Vec2& xy) const {
    const double r2 = xy.squaredNorm();
    const double xy2 = 2.0 * xy.x() * xy.y();
    const DistortionConfig& d = distortion_;
    return {d.p1 * xy2 + d.p2 * (r2 + 2.0 * xy.x() * xy.x()),
            d.p1 * (r2 + 2.0 * xy.y() * xy.y()) + d.p2 * xy2};
  }

  /// As far as the argument of spread() goes before the model folds: there its inverse has no more
  /// digits.
  double find_argument_max() const {
    constexpr double kLeastSlope = 0.1;
    constexpr int kSteps = 4096;
    const double most =
        is_radial() ? distortion_.max_angle_rad : std::tan(distortion_.max_angle_rad);
    const bool folds = distortion_.model != Distortion::none && !is_panorama();
    for (int i = 1; i <= kSteps && folds; ++i) {
      const double s = most * i / kSteps;
      // off its centre, the lens adds no more than this to either way's slope
      const double off_centre =
          is_radial() ? 0.0 : 6.0 * std::hypot(distortion_.p1, distortion_.p2) * s;
      const double least = std::min(slope(s), is_radial() ? slope(s) : spread(s) / s) - off_centre;
      if (!(least >= kLeastSlope)) return most * (i - 1) / kSteps;
    }
    return most;
  }

  /// The argument of spread() that gives this radius; argument_max_ for larger ones.
  double argument_of(double radius) const {
    double low = 0.0, high = argument_max_;
    double s = std::min(radius, high);
    for (int i = 0; i < 60; ++i) {
      const double off = spread(s) - radius;
      (off > 0.0 ? high : low) = s;
      const double next = s - off / slope(s);
      const double before = s;
      s = next > low && next < high ? next : 0.5 * (low + high);
      if (std::abs(s - before) <= 1e-15 * (1.0 + s)) break;
    }
    return s;
  }

  /// Newton's steps on the whole model; whether they met `distorted`.
  bool refine(const Vec2& distorted, Vec2& xy) const {
    constexpr double kMet = 1e-12;
    for (int i = 0; i < 30; ++i) {
      const Vec2 off = distort(xy) - distorted;
      if (off.norm() <= kMet * (1.0 + distorted.norm())) return true;
      const double h = 1e-7 * (1.0 + xy.norm());
      Eigen::Matrix2d J;
      for (int a = 0; a < 2; ++a) {
        const Vec2 step = h * Vec2::Unit(a);
        J.col(a) = (distort(xy + step) - distort(xy - step)) / (2.0 * h);
      }
      Vec2 step = J.inverse() * off;
      if (!step.allFinite()) return false;
      for (int half = 0; half < 8; ++half, step *= 0.5) {
        if ((distort(xy - step) - distorted).norm() < off.norm()) break;
      }
      xy -= step;
    }
    return false;
  }

  /// The border of what is seen is the image's, or the model's within it.
  Eigen::AlignedBox2d find_sight() const {
    constexpr int kAlong = 512;
    Eigen::AlignedBox2d box;
    const auto add = [&](double u_px, double v_px) {
      if (const auto xy = direction_at(u_px, v_px)) box.extend(*xy);
    };
    for (int i = 0; i <= kAlong; ++i) {
      const double u_px = static_cast<double>(width_px_) * i / kAlong;
      const double v_px = static_cast<double>(height_px_) * i / kAlong;
      add(u_px, 0.0);
      add(u_px, height_px_);
      add(0.0, v_px);
      add(width_px_, v_px);
      const double bearing_rad = 2.0 * kPi * i / kAlong;
      const Vec2 rim =
          radius_max_ * (1.0 - 1e-9) * Vec2(std::cos(bearing_rad), std::sin(bearing_rad));
      if (sees(rim.homogeneous())) box.extend(rim);
    }
    return box;
  }

  int width_px_, height_px_;
  Pinhole pinhole_;
  DistortionConfig distortion_;
  double argument_max_, radius_max_;
  Eigen::AlignedBox2d sight_;
  mutable std::once_flag made_;
  mutable std::vector<Eigen::Vector2f> directions_;
};

}  // namespace gnbv
