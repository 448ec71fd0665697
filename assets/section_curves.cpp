#include "assets/section_curves.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr double kChordDensity = 1.6;  // exponent; 1 would space the points evenly
constexpr double kCamberPosition = 0.4;

/// NACA Report 460, half thickness over its own maximum; the last coefficient closes the edge.
double thickness(double s) {
  return 10.0 * (0.2969 * std::sqrt(s) + s * (-0.1260 + s * (-0.3516 + s * (0.2843 - 0.1036 * s))));
}

double camber(double s) {
  const double p = kCamberPosition;
  const double distance = s < p ? p : 1.0 - p;
  return (2.0 * p * s - s * s + (s < p ? 0.0 : 1.0 - 2.0 * p)) / (distance * distance);
}

}  // namespace

MonotoneCurve::MonotoneCurve(std::vector<Station> stations) : stations_(std::move(stations)) {
  GNBV_CHECK(stations_.size() >= 2, "a curve of {} stations", stations_.size());
  std::vector<double> width, chord;
  for (std::size_t i = 0; i + 1 < stations_.size(); ++i) {
    width.push_back(stations_[i + 1].x - stations_[i].x);
    GNBV_CHECK(width.back() > 0.0, "stations not ascending at x = {}", stations_[i].x);
    chord.push_back((stations_[i + 1].y - stations_[i].y) / width.back());
  }
  slopes_.push_back(chord.front());
  for (std::size_t i = 1; i < chord.size(); ++i) {
    const double before = chord[i - 1], after = chord[i];
    if (before * after <= 0.0) {
      slopes_.push_back(0.0);
      continue;
    }
    const double w1 = 2.0 * width[i] + width[i - 1], w2 = width[i] + 2.0 * width[i - 1];
    slopes_.push_back((w1 + w2) / (w1 / before + w2 / after));
  }
  slopes_.push_back(chord.back());
}

double MonotoneCurve::operator()(double x) const {
  if (x <= stations_.front().x) return stations_.front().y;
  if (x >= stations_.back().x) return stations_.back().y;
  const auto after = std::upper_bound(stations_.begin(), stations_.end(), x,
                                      [](double value, const Station& s) { return value < s.x; });
  const auto i = static_cast<std::size_t>(after - stations_.begin()) - 1;
  const Station &a = stations_[i], &b = stations_[i + 1];
  const double h = b.x - a.x, t = (x - a.x) / h, u = 1.0 - t;
  return u * u * (1.0 + 2.0 * t) * a.y + t * t * (3.0 - 2.0 * t) * b.y +
         h * t * u * (u * slopes_[i] - t * slopes_[i + 1]);
}

double chord_fraction(std::size_t k, std::size_t n) {
  return std::pow(static_cast<double>(k) / static_cast<double>(n), kChordDensity);
}

Vec3 aerofoil_point_m(const AerofoilSection& section, double s, double side) {
  const Vec3 chord_m = section.trailing_edge_m - section.leading_edge_m;
  const double height_m =
      section.camber_m * camber(s) + side * section.half_thickness_m * thickness(s);
  return section.leading_edge_m + s * chord_m + height_m * section.up;
}

Ring aerofoil_ring(const AerofoilSection& section, std::size_t n) {
  const auto at = [&](std::size_t k, double side) {
    return aerofoil_point_m(section, chord_fraction(k, n), side);
  };
  Ring ring = {section.leading_edge_m};
  for (std::size_t k = 1; k < n; ++k) ring.push_back(at(k, 1.0));
  ring.push_back(section.trailing_edge_m);
  for (std::size_t k = n - 1; k > 0; --k) ring.push_back(at(k, -1.0));
  return ring;
}

AerofoilSection between(const AerofoilSection& a, const AerofoilSection& b, double t) {
  const auto mix = [t](const auto& from, const auto& to) -> std::decay_t<decltype(from)> {
    return (1.0 - t) * from + t * to;
  };
  AerofoilSection section;
  section.leading_edge_m = mix(a.leading_edge_m, b.leading_edge_m);
  section.trailing_edge_m = mix(a.trailing_edge_m, b.trailing_edge_m);
  section.up = mix(a.up, b.up).normalized();
  section.half_thickness_m = mix(a.half_thickness_m, b.half_thickness_m);
  section.camber_m = mix(a.camber_m, b.camber_m);
  return section;
}

void add_span(std::vector<Ring>& rings, const AerofoilSection& a, const AerofoilSection& b,
              std::size_t steps, std::size_t n) {
  for (std::size_t i = 1; i <= steps; ++i)
    rings.push_back(
        aerofoil_ring(between(a, b, static_cast<double>(i) / static_cast<double>(steps)), n));
}

}  // namespace gnbv
