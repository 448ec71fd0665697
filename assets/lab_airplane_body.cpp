// Fuselage with its scoop, canopy and spinner.
#include <algorithm>
#include <array>
#include <cmath>

#include "assets/lab_airplane_parts.hpp"
#include "assets/section_curves.hpp"
#include "sim/core/error.hpp"

namespace gnbv::lab_airplane {
namespace {

constexpr std::size_t kHalfSides = 16;
constexpr double kCowlFront_m = -1.803, kTail_m = 1.935;
constexpr double kCowlEnd_m = -1.13, kAntiGlareEnd_m = -0.86;

double height_fraction(std::size_t side) {  // of the middle of a side, -1 lowest, 1 highest
  const std::size_t k = side < kHalfSides ? side : 2 * kHalfSides - 1 - side;
  return -std::cos(kPi * (static_cast<double>(k) + 0.5) / double{kHalfSides});
}

/// Red below, white above, a cheat line between; the cowl is red, dull before the pilot's eyes.
Paint fuselage_paint(double y_m, double height) {
  if (y_m < kAntiGlareEnd_m && height > 0.75) return kAntiGlare;
  if (y_m < kCowlEnd_m) return kSkinRed;
  if (std::abs(height + 0.2) < 0.15) return kCheatLine;
  return height < 0.0 ? kSkinRed : kSkinWhite;
}

Part fuselage() {
  const MonotoneCurve half_width_m({{-1.803, 0.132},
                                    {-1.55, 0.168},
                                    {-1.20, 0.192},
                                    {-0.60, 0.208},
                                    {0.00, 0.205},
                                    {0.45, 0.184},
                                    {0.90, 0.142},
                                    {1.40, 0.088},
                                    {1.75, 0.050},
                                    {1.935, 0.018}});
  const MonotoneCurve top_m({{-1.803, 0.658},
                             {-1.55, 0.679},
                             {-1.00, 0.697},
                             {0.50, 0.703},
                             {1.00, 0.690},
                             {1.50, 0.662},
                             {1.935, 0.637}});
  const MonotoneCurve bottom_m({{-1.803, 0.392},
                                {-1.55, 0.352},
                                {-1.10, 0.322},
                                {-0.50, 0.304},
                                {0.20, 0.309},
                                {0.70, 0.346},
                                {1.20, 0.421},
                                {1.70, 0.521},
                                {1.935, 0.588}});
  constexpr std::size_t kRings = 48;
  std::vector<Ring> rings;
  std::vector<double> stations_m;
  for (std::size_t i = 0; i <= kRings; ++i) {
    const double y_m = kCowlFront_m + (kTail_m - kCowlFront_m) * static_cast<double>(i) / kRings;
    stations_m.push_back(y_m);
    rings.push_back(oval_ring({y_m, 0.5 * (top_m(y_m) + bottom_m(y_m)), half_width_m(y_m),
                               0.5 * (top_m(y_m) - bottom_m(y_m)), 2.4},
                              kHalfSides));
  }
  const auto paint = [&](std::size_t ring, std::size_t side) -> std::uint16_t {
    if (ring == kRings) return kSkinRed;
    return fuselage_paint(0.5 * (stations_m[ring] + stations_m[ring + 1]), height_fraction(side));
  };
  return loft(rings, {Vec3(0.0, kCowlFront_m, 0.525)}, {Vec3(0.0, kTail_m + 0.006, 0.613)}, paint);
}

/// The intake under the spinner: a lip, and a duct that ends in the dark.
Part scoop() {
  const std::vector<Ring> rings = {oval_ring({-1.22, 0.385, 0.060, 0.040, 2.6}, 10),
                                   oval_ring({-1.45, 0.366, 0.085, 0.052, 2.6}, 10),
                                   oval_ring({-1.68, 0.358, 0.094, 0.056, 2.6}, 10),
                                   oval_ring({-1.792, 0.357, 0.090, 0.052, 2.6}, 10),  // lip
                                   oval_ring({-1.804, 0.357, 0.084, 0.046, 2.6}, 10),
                                   oval_ring({-1.790, 0.357, 0.079, 0.041, 2.6}, 10),
                                   oval_ring({-1.610, 0.362, 0.074, 0.036, 2.6}, 10)};
  return loft(rings, {Vec3(0.0, -1.16, 0.40)}, {Vec3(0.0, -1.60, 0.362)},
              [](std::size_t ring, std::size_t) {
                return ring < 3 ? kSkinRed : ring < 5 ? kLeadingEdge : kDuct;
              });
}

struct Band {
  double begin_m, end_m;
};
constexpr std::array<Band, 4> kFrames = {
    {{-0.715, -0.69}, {-0.20, -0.165}, {0.285, 0.315}, {0.555, 0.575}}};
constexpr double kFairingBegin_m = 0.575;  // the canopy ends in a painted fairing

/// A tandem bubble with frames that stand out of the glass; its sill is inside the fuselage.
Part canopy() {
  constexpr double kBegin_m = -1.003, kEnd_m = 1.083;
  const MonotoneCurve half_width_m({{kBegin_m, 0.085},
                                    {-0.72, 0.142},
                                    {-0.40, 0.158},
                                    {0.10, 0.158},
                                    {0.50, 0.132},
                                    {0.80, 0.090},
                                    {kEnd_m, 0.045}});
  const MonotoneCurve top_m({{kBegin_m, 0.668},
                             {-0.86, 0.742},
                             {-0.72, 0.805},
                             {-0.45, 0.858},
                             {-0.05, 0.881},
                             {0.30, 0.862},
                             {0.60, 0.801},
                             {0.85, 0.733},
                             {kEnd_m, 0.672}});
  constexpr double kKeel_m = 0.592, kSill_m = 0.642, kProud_m = 0.006, kRamp_m = 0.004;
  constexpr std::size_t kArc = 12;
  const auto ring_at = [&](double y_m, double proud_m) {
    const double width_m = half_width_m(y_m) + proud_m, rise_m = top_m(y_m) + proud_m - kSill_m;
    std::vector<Vec3> half = {{0.0, y_m, kKeel_m}, {width_m, y_m, kKeel_m}};
    for (std::size_t k = 0; k < kArc; ++k) {
      const double angle_rad = 0.5 * kPi * static_cast<double>(k) / double{kArc};
      half.emplace_back(width_m * std::pow(std::cos(angle_rad), 0.85), y_m,
                        kSill_m + rise_m * std::pow(std::sin(angle_rad), 0.92));
    }
    half.emplace_back(0.0, y_m, kSill_m + rise_m);
    return mirror_ring(half);
  };
  std::vector<Ring> rings;
  std::vector<double> stations_m;
  const auto add = [&](double y_m, double proud_m) {
    stations_m.push_back(y_m);
    rings.push_back(ring_at(y_m, proud_m));
  };
  double from_m = kBegin_m;
  add(from_m, 0.0);
  const auto add_glass = [&](double to_m) {
    const int steps = std::max(1, static_cast<int>((to_m - from_m) / 0.06));
    for (int i = 1; i < steps; ++i) add(from_m + (to_m - from_m) * i / steps, 0.0);
  };
  for (const Band& frame : kFrames) {
    add_glass(frame.begin_m - kRamp_m);
    add(frame.begin_m - kRamp_m, 0.0);
    add(frame.begin_m, kProud_m);
    add(frame.end_m, kProud_m);
    from_m = frame.end_m + kRamp_m;
    add(from_m, 0.0);
  }
  add_glass(kEnd_m);
  add(kEnd_m, 0.0);

  const auto paint = [&](std::size_t ring, std::size_t) -> std::uint16_t {
    if (ring + 1 >= stations_m.size()) return kSkinWhite;
    const double y_m = 0.5 * (stations_m[ring] + stations_m[ring + 1]);
    for (const Band& frame : kFrames)
      if (y_m > frame.begin_m - kRamp_m && y_m < frame.end_m + kRamp_m) return kCanopyFrame;
    return y_m > kFairingBegin_m ? kSkinWhite : kGlass;
  };
  return loft(rings, {Vec3(0.0, kBegin_m, 0.63)}, {Vec3(0.0, kEnd_m, 0.63)}, paint);
}

}  // namespace

Ring oval_ring(const Oval& oval, std::size_t half_sides) {
  std::vector<Vec3> half;
  for (std::size_t k = 0; k <= half_sides; ++k) {
    const bool on_plane = k == 0 || k == half_sides;  // where the sine misses zero by a rounding
    const double turn_rad = kPi * static_cast<double>(k) / static_cast<double>(half_sides);
    const double s = std::pow(std::sin(turn_rad), 2.0 / oval.exponent), c = std::cos(turn_rad);
    half.emplace_back(on_plane ? 0.0 : oval.half_width_m * s, oval.y_m,
                      oval.z_m - oval.half_height_m *
                                     std::copysign(std::pow(std::abs(c), 2.0 / oval.exponent), c));
  }
  return mirror_ring(half);
}

Part spindle(const std::vector<RevolvedPoint>& profile, double z_m, std::size_t half_sides,
             Paint paint) {
  GNBV_CHECK(profile.size() >= 3, "a spindle of {} points", profile.size());
  std::vector<Ring> rings;
  for (std::size_t i = 1; i + 1 < profile.size(); ++i)
    rings.push_back(
        oval_ring({profile[i].y_m, z_m, profile[i].radius_m, profile[i].radius_m}, half_sides));
  return loft(rings, {Vec3(0.0, profile.front().y_m, z_m)}, {Vec3(0.0, profile.back().y_m, z_m)},
              uniform(paint));
}

std::vector<Part> body() {
  return {fuselage(), scoop(), canopy(),
          spindle({{-1.998, 0.0},
                   {-1.99, 0.025},
                   {-1.965, 0.055},
                   {-1.925, 0.085},
                   {-1.875, 0.108},
                   {-1.812, 0.120},
                   {-1.806, 0.112},
                   {-1.79, 0.090},
                   {-1.76, 0.0}},
                  kPropellerAxis_m, 12, kSpinner)};
}

}  // namespace gnbv::lab_airplane
