// Fuselage of the airliner: lines, skin and tail cone, and the fairing where the wing passes.
#include "assets/aircraft_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assets/section_curves.hpp"

namespace gnbv::aircraft {
namespace {

constexpr double kNoseTip_m = -17.68;
constexpr double kNoseEnd_m = -13.1;  // the cylinder begins
constexpr double kTailBegin_m = 5.9;  // and ends
constexpr double kTailEnd_m = 17.28;  // rim of the APU exhaust
constexpr double kExhaustDepth_m = 0.22;
constexpr double kExhaustRim_m = 0.045;  // wall of the exhaust
constexpr double kNoseTipHeight_m = 2.335;

constexpr std::size_t kNoseRings = 18, kCylinderRings = 38, kTailRings = 30;
constexpr std::size_t kHalfSides = 26;

/// Rings lean aft at the top by up to `lean_m` between four stations, so that an edge of the paint
/// along a ring slopes. |slope of the ramps| < 1 keeps the rings from crossing.
struct Lean {
  double begin_m, full_m, fade_m, end_m, lean_m;
};
constexpr Lean kBellyLean = {-15.9, -13.4, -12.9, -9.3, 1.35};  // grey begins behind the nose
constexpr Lean kTailLean = {4.9, 9.1, 11.4, 15.6, 1.55};        // as the fin's leading edge
constexpr double kBellyFrom_m = -13.3, kBellyAngle_rad = -0.62;
constexpr double kCheatLineFrom_rad = -0.06, kCheatLineTo_rad = 0.18;  // below the windows
constexpr double kLiveryFrom_m = 9.3, kLiveryLightFrom_m = 8.65;

/// Half width, top and bottom of the fuselage at a station y. Near the nose the stations run over
/// the root of the distance to the tip, which makes the tip round.
struct BodyLines {
  MonotoneCurve half_width_m, top_m, bottom_m;
};

const BodyLines& nose_lines() {
  static const BodyLines lines = [] {
    struct Row {
      double distance_m, half_width_m, top_m, bottom_m;
    };
    // The top line is steeper between 0.85 and 1.45 m: the windscreen.
    static constexpr Row kRows[] = {{0.00, 0.000, kNoseTipHeight_m, kNoseTipHeight_m},
                                    {0.06, 0.170, 2.490, 2.165},
                                    {0.20, 0.320, 2.635, 2.030},
                                    {0.45, 0.495, 2.800, 1.860},
                                    {0.85, 0.705, 3.035, 1.665},
                                    {1.15, 0.830, 3.290, 1.555},
                                    {1.45, 0.935, 3.485, 1.465},
                                    {1.90, 1.060, 3.640, 1.360},
                                    {2.60, 1.210, 3.780, 1.235},
                                    {3.50, 1.345, 3.875, 1.135},
                                    {4.58, 1.410, 3.910, 1.090}};
    std::vector<MonotoneCurve::Station> width, top, bottom;
    for (const Row& row : kRows) {
      const double root = std::sqrt(row.distance_m);
      width.push_back({root, row.half_width_m});
      top.push_back({root, row.top_m});
      bottom.push_back({root, row.bottom_m});
    }
    return BodyLines{MonotoneCurve(width), MonotoneCurve(top), MonotoneCurve(bottom)};
  }();
  return lines;
}

const BodyLines& tail_lines() {
  static const BodyLines lines{MonotoneCurve({{5.9, 1.410},
                                              {8.0, 1.400},
                                              {10.0, 1.312},
                                              {12.0, 1.112},
                                              {14.0, 0.822},
                                              {16.0, 0.462},
                                              {17.28, 0.185}}),
                               MonotoneCurve({{5.9, 3.910},
                                              {10.0, 3.910},
                                              {12.0, 3.904},
                                              {14.0, 3.890},
                                              {16.0, 3.835},
                                              {17.28, 3.735}}),
                               MonotoneCurve({{5.9, 1.090},
                                              {8.0, 1.140},
                                              {10.0, 1.400},
                                              {12.0, 1.850},
                                              {14.0, 2.430},
                                              {16.0, 3.020},
                                              {17.28, 3.375}})};
  return lines;
}

double ramp(double from, double to, double value) {
  return std::clamp((value - from) / (to - from), 0.0, 1.0);
}

double lean_m(double station_m) {
  double sum_m = 0.0;
  for (const Lean& lean : {kBellyLean, kTailLean})
    sum_m += lean.lean_m * (ramp(lean.begin_m, lean.full_m, station_m) -
                            ramp(lean.fade_m, lean.end_m, station_m));
  return sum_m;
}

/// Angle of point k of the right half: from the lowest (-90 degrees) to the highest.
double side_angle_rad(std::size_t k) {
  return std::numbers::pi * (static_cast<double>(k) / static_cast<double>(kHalfSides) - 0.5);
}

Ring body_ring(double station_m) {
  std::vector<Vec3> half;
  for (std::size_t k = 0; k <= kHalfSides; ++k) {
    const double angle_rad = side_angle_rad(k);
    const double y_m = station_m + lean_m(station_m) * std::sin(angle_rad);
    half.push_back(body_point_m(y_m, angle_rad));
    if (k == 0 || k == kHalfSides) half.back().x() = 0.0;  // the cosine misses zero by a rounding
  }
  return mirror_ring(half);
}

/// A ring inside the exhaust: `ring` drawn in towards its centre and moved forward.
Ring exhaust_ring(const Ring& ring, double shrink_m, double forward_m) {
  const Vec3 centre_m = 0.5 * (ring.front() + ring[kHalfSides]);
  Ring inner;
  for (const Vec3& p : ring) {
    const Vec3 arm_m = p - centre_m;
    inner.push_back(centre_m + arm_m * (1.0 - shrink_m / arm_m.norm()) - forward_m * Vec3::UnitY());
  }
  return inner;
}

std::vector<double> body_stations_m() {
  std::vector<double> stations_m;
  for (std::size_t i = 1; i < kNoseRings; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(kNoseRings);
    stations_m.push_back(kNoseTip_m + (kNoseEnd_m - kNoseTip_m) * std::pow(t, 1.7));
  }
  for (std::size_t i = 0; i < kCylinderRings; ++i)
    stations_m.push_back(kNoseEnd_m + (kTailBegin_m - kNoseEnd_m) * static_cast<double>(i) /
                                          static_cast<double>(kCylinderRings));
  for (std::size_t i = 0; i <= kTailRings; ++i)
    stations_m.push_back(kTailBegin_m + (kTailEnd_m - kTailBegin_m) * static_cast<double>(i) /
                                            static_cast<double>(kTailRings));
  return stations_m;
}

}  // namespace

Vec3 body_point_m(double y_m, double angle_rad) {
  const bool nose = y_m < kNoseEnd_m;
  const BodyLines& lines = nose ? nose_lines() : tail_lines();
  const double at = nose ? std::sqrt(std::max(0.0, y_m - kNoseTip_m)) : y_m;
  const double top_m = lines.top_m(at), bottom_m = lines.bottom_m(at);
  return {lines.half_width_m(at) * std::cos(angle_rad), y_m,
          0.5 * (top_m + bottom_m) + 0.5 * (top_m - bottom_m) * std::sin(angle_rad)};
}

Vec3 body_normal(double y_m, double angle_rad) {
  constexpr double kStep = 1e-4;
  const Vec3 along = body_point_m(y_m + kStep, angle_rad) - body_point_m(y_m - kStep, angle_rad);
  const Vec3 around = body_point_m(y_m, angle_rad + kStep) - body_point_m(y_m, angle_rad - kStep);
  return along.cross(around).normalized();
}

Part fuselage() {
  const std::vector<double> stations_m = body_stations_m();
  std::vector<Ring> rings;
  for (const double station_m : stations_m) rings.push_back(body_ring(station_m));
  const std::size_t rim = rings.size() - 1;
  rings.push_back(exhaust_ring(rings[rim], kExhaustRim_m, 0.0));
  rings.push_back(exhaust_ring(rings[rim], kExhaustRim_m + 0.015, kExhaustDepth_m));
  const Vec3 exhaust_end_m = 0.5 * (rings.back().front() + rings.back()[kHalfSides]);

  const auto paint = [&](std::size_t ring, std::size_t side) -> std::uint16_t {
    if (ring >= rim) return kExhaust;
    const double station_m = 0.5 * (stations_m[ring] + stations_m[ring + 1]);
    if (station_m > kLiveryFrom_m) return kLiveryBlue;
    if (station_m > kLiveryLightFrom_m) return kLiveryLight;
    const std::size_t k = side < kHalfSides ? side : 2 * kHalfSides - 1 - side;
    const double angle_rad = side_angle_rad(k + 1);
    if (angle_rad > kCheatLineFrom_rad && angle_rad < kCheatLineTo_rad) return kCheatLine;
    const bool belly = station_m > kBellyFrom_m && angle_rad < kBellyAngle_rad;
    return belly ? kBellyGrey : kFuselageWhite;
  };
  return loft(rings, {Vec3(0.0, kNoseTip_m, kNoseTipHeight_m)}, {exhaust_end_m}, paint);
}

Part belly_fairing() {
  constexpr double kBegin_m = -6.35, kEnd_m = 4.55;
  constexpr std::size_t kRings = 24, kSides = 13;
  constexpr double kCentreHeight_m = 1.62;
  const MonotoneCurve half_width_m({{0.0, 0.0},
                                    {0.10, 0.93},
                                    {0.24, 1.44},
                                    {0.40, 1.56},
                                    {0.62, 1.55},
                                    {0.80, 1.34},
                                    {0.92, 0.84},
                                    {1.0, 0.0}});
  const MonotoneCurve depth_m({{0.0, 0.30},
                               {0.10, 0.53},
                               {0.24, 0.665},
                               {0.40, 0.692},
                               {0.62, 0.690},
                               {0.80, 0.635},
                               {0.92, 0.49},
                               {1.0, 0.30}});
  std::vector<Ring> rings;
  for (std::size_t i = 1; i < kRings; ++i) {
    const double t =
        0.5 - 0.5 * std::cos(std::numbers::pi * static_cast<double>(i) / double{kRings});
    std::vector<Vec3> half;
    for (std::size_t k = 0; k <= kSides; ++k) {
      const double angle_rad =
          std::numbers::pi * (static_cast<double>(k) / static_cast<double>(kSides) - 0.5);
      // A superellipse of exponent 3: flat below, upright at the sides.
      const double c = std::cbrt(std::pow(std::abs(std::cos(angle_rad)), 2.0));
      const double s = std::sin(angle_rad);
      const double height_m =
          std::copysign(std::cbrt(s * s), s) * (s < 0.0 ? 1.0 : 0.6) * depth_m(t);
      half.emplace_back(k == 0 || k == kSides ? 0.0 : half_width_m(t) * c,
                        kBegin_m + (kEnd_m - kBegin_m) * t, kCentreHeight_m + height_m);
    }
    rings.push_back(mirror_ring(half));
  }
  return loft(rings, {Vec3(0.0, kBegin_m, kCentreHeight_m)}, {Vec3(0.0, kEnd_m, kCentreHeight_m)},
              uniform(kBellyGrey));
}

}  // namespace gnbv::aircraft
