#include "sensors/lens.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/error.hpp"

namespace gnbv {

const char* distortion_name(Distortion model) {
  return std::array{"none", "brown_conrady", "kannala_brandt",
                    "panorama"}[static_cast<std::size_t>(model)];
}

Distortion distortion_named(const std::string& name) {
  for (const Distortion model :
       {Distortion::none, Distortion::brown_conrady, Distortion::kannala_brandt}) {
    if (name == distortion_name(model)) return model;
  }
  throw BadInput("no model of distortion is named '" + name + "'");
}

std::vector<double> coefficients_of(const DistortionConfig& d) {
  if (d.model == Distortion::kannala_brandt) return {d.k1, d.k2, d.k3, d.k4};
  std::vector<double> all;
  if (d.model == Distortion::none || d.model == Distortion::panorama) return all;
  for (const auto& [name, member] : kCoefficients) all.push_back(d.*member);
  return all;
}

Lens::Lens(int width_px, int height_px, const Pinhole& pinhole, const DistortionConfig& distortion)
    : width_px_(width_px),
      height_px_(height_px),
      pinhole_(pinhole),
      distortion_(distortion),
      argument_max_(find_argument_max()),
      radius_max_(is_radial() ? std::tan(argument_max_) : argument_max_),
      sight_(find_sight()) {}

Lens::Vec2 Lens::distort(const Vec2& xy) const {
  if (distortion_.model == Distortion::none) return xy;
  if (is_panorama()) return xy_to_angles(xy);
  const double r = xy.norm();
  if (is_radial()) return r > 0.0 ? Vec2(spread(std::atan(r)) / r * xy) : xy;
  return xy * (r > 0.0 ? spread(r) / r : 1.0) + decentred(xy);
}

std::optional<Lens::Vec2> Lens::undistort(const Vec2& distorted) const {
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

Lens::Vec2 Lens::pixel_of(const Vec3& p_camera_m) const {
  const Vec2 xy = p_camera_m.head<2>() / p_camera_m.z();
  if (!(p_camera_m.z() > 0.0) || xy.norm() > radius_max_) {
    return Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  const Vec2 d = distort(xy);
  return {pinhole_.fx_px * d.x() + pinhole_.skew_px * d.y() + pinhole_.cx_px,
          pinhole_.fy_px * d.y() + pinhole_.cy_px};
}

std::optional<Lens::Vec2> Lens::direction_at(double u_px, double v_px) const {
  const double y = (v_px - pinhole_.cy_px) / pinhole_.fy_px;
  return undistort({(u_px - pinhole_.cx_px - pinhole_.skew_px * y) / pinhole_.fx_px, y});
}

bool Lens::sees(const Vec3& p_camera_m) const {
  const Vec2 px = pixel_of(p_camera_m);
  return px.x() >= 0.0 && px.x() <= width_px_ && px.y() >= 0.0 && px.y() <= height_px_;
}

const std::vector<Eigen::Vector2f>& Lens::directions() const {
  std::call_once(made_, [&] {
    directions_.reserve(static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_));
    for (int v = 0; v < height_px_; ++v) {
      for (int u = 0; u < width_px_; ++u) {
        const Vec2 none = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
        directions_.push_back(direction_at(u + 0.5, v + 0.5).value_or(none).cast<float>());
      }
    }
  });
  return directions_;
}

double Lens::unit_m3() const {
  if (is_panorama()) {
    const double up_rad = pinhole_.cy_px / pinhole_.fy_px;
    const double down_rad = height_px_ / pinhole_.fy_px - up_rad;
    return width_px_ / pinhole_.fx_px * (std::sin(up_rad) + std::sin(down_rad)) / 3.0;
  }
  constexpr int kRings = 128;
  constexpr int kBearings = 256;
  const Vec2 corner = sight_.min().cwiseAbs().cwiseMax(sight_.max().cwiseAbs());
  const double step_rad = std::atan(std::min(radius_max_, corner.norm())) / kRings;
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

double Lens::spread(double s) const {
  const DistortionConfig& d = distortion_;
  const double s2 = s * s;
  if (is_radial()) return s * (1.0 + s2 * (d.k1 + s2 * (d.k2 + s2 * (d.k3 + s2 * d.k4))));
  return s * (1.0 + s2 * (d.k1 + s2 * (d.k2 + s2 * d.k3))) /
         (1.0 + s2 * (d.k4 + s2 * (d.k5 + s2 * d.k6)));
}

double Lens::slope(double s) const {
  const double h = 1e-6 * (1.0 + s);
  return (spread(s + h) - spread(s - h)) / (2.0 * h);
}

Lens::Vec2 Lens::xy_to_angles(const Vec2& xy) {
  return {std::atan(xy.x()), std::atan(xy.y() / std::hypot(1.0, xy.x()))};
}

Lens::Vec2 Lens::decentred(const Vec2& xy) const {
  const double r2 = xy.squaredNorm();
  const double xy2 = 2.0 * xy.x() * xy.y();
  const DistortionConfig& d = distortion_;
  return {d.p1 * xy2 + d.p2 * (r2 + 2.0 * xy.x() * xy.x()),
          d.p1 * (r2 + 2.0 * xy.y() * xy.y()) + d.p2 * xy2};
}

double Lens::find_argument_max() const {
  constexpr double kLeastSlope = 0.1;
  constexpr int kSteps = 4096;
  const bool has_model = distortion_.model != Distortion::none;  // else its keys have no effect
  const double most_rad = (has_model ? distortion_ : DistortionConfig{}).max_angle_rad;
  const double most = is_radial() ? most_rad : std::tan(most_rad);
  const bool folds = has_model && !is_panorama();
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

double Lens::argument_of(double radius) const {
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

bool Lens::refine(const Vec2& distorted, Vec2& xy) const {
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

Eigen::AlignedBox2d Lens::find_sight() const {
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

}  // namespace gnbv
