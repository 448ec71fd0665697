// Propeller, landing gear and what hangs on the laboratory's airplane.
#include <array>
#include <cmath>

#include "assets/lab_airplane_parts.hpp"
#include "assets/section_curves.hpp"
#include "assets/solids.hpp"

namespace gnbv::lab_airplane {
namespace {

/// A drop of elliptic sections along y, fullest at two fifths.
Part drop(const Vec3& nose_m, double length_m, double half_width_m, double half_height_m,
          Paint paint) {
  const MonotoneCurve girth(
      {{0.0, 0.0}, {0.08, 0.50}, {0.22, 0.86}, {0.4, 1.0}, {0.62, 0.87}, {0.84, 0.47}, {1.0, 0.0}});
  constexpr std::size_t kSides = 16;
  std::vector<Ring> rings;
  for (const double t : {0.015, 0.06, 0.14, 0.26, 0.40, 0.55, 0.70, 0.84, 0.95}) {
    Ring ring;
    for (std::size_t k = 0; k < kSides; ++k) {
      const double turn_rad = 2.0 * kPi * static_cast<double>(k) / double{kSides};
      ring.emplace_back(nose_m + Vec3(girth(t) * half_width_m * std::sin(turn_rad), t * length_m,
                                      -girth(t) * half_height_m * std::cos(turn_rad)));
    }
    rings.push_back(ring);
  }
  return loft(rings, {nose_m}, {nose_m + length_m * Vec3::UnitY()}, uniform(paint));
}

Part straight_rod(const Vec3& from_m, const Vec3& to_m, double radius_m, Paint paint) {
  return rod({{from_m, radius_m}, {to_m, radius_m}}, 8, paint);
}

/// Tyre on its hub, standing on the ground, its axle along x.
std::vector<Part> wheel(const Vec3& axle_m, double radius_m, double half_width_m) {
  const double shoulder_m = 0.86 * radius_m, rim_m = 0.55 * radius_m;
  const auto across = [&](Part part) {  // the builder revolves about y
    for (Vec3& p : part.points_m) p = Vec3(0.0 - p.y(), p.x(), p.z()) + axle_m;
    return part;
  };
  return {across(revolve_loop({{-0.75 * half_width_m, rim_m},
                               {-half_width_m, 0.72 * radius_m},
                               {-0.8 * half_width_m, shoulder_m},
                               {-0.35 * half_width_m, radius_m},
                               {0.35 * half_width_m, radius_m},
                               {0.8 * half_width_m, shoulder_m},
                               {half_width_m, 0.72 * radius_m},
                               {0.75 * half_width_m, rim_m}},
                              24, uniform(kTyre))),
          across(revolve({{-0.45 * half_width_m, 0.0},
                          {-0.6 * half_width_m, 0.65 * rim_m},
                          {-0.5 * half_width_m, 1.06 * rim_m},
                          {0.5 * half_width_m, 1.06 * rim_m},
                          {0.6 * half_width_m, 0.65 * rim_m},
                          {0.45 * half_width_m, 0.0}},
                         16, uniform(kSpinner)))};
}

Part propeller_blade(double turn_rad) {
  struct Station {
    double radius_m, chord_m, half_thickness_m, stagger_deg;  // 0: chord along the axis
  };
  constexpr std::array<Station, 7> kStations = {{{0.070, 0.038, 0.0120, 28.0},
                                                 {0.130, 0.046, 0.0100, 38.0},
                                                 {0.200, 0.070, 0.0085, 48.0},
                                                 {0.280, 0.080, 0.0070, 57.0},
                                                 {0.350, 0.076, 0.0058, 63.0},
                                                 {0.400, 0.062, 0.0048, 67.0},
                                                 {0.424, 0.036, 0.0032, 69.0}}};
  constexpr double kPlane_m = -1.868;
  const Vec3 out(std::sin(turn_rad), 0.0, std::cos(turn_rad));
  const Vec3 round(std::cos(turn_rad), 0.0, -std::sin(turn_rad));
  std::vector<Ring> rings;
  for (const Station& station : kStations) {
    const double stagger_rad = deg_to_rad(station.stagger_deg);
    const Vec3 along = std::cos(stagger_rad) * Vec3::UnitY() + std::sin(stagger_rad) * round;
    const Vec3 middle_m = Vec3(0.0, kPlane_m, kPropellerAxis_m) + station.radius_m * out;
    rings.push_back(aerofoil_ring(
        {middle_m - 0.4 * station.chord_m * along, middle_m + 0.6 * station.chord_m * along,
         along.cross(out), station.half_thickness_m, 0.0},
        5));
  }
  return loft(rings, {}, {}, uniform(kBlade));
}

}  // namespace

/// Four in an X: a symmetric propeller has blades of opposite hand on its two sides, which no
/// flying one has.
std::vector<Part> propeller_blades() {
  return {propeller_blade(deg_to_rad(45.0)), propeller_blade(deg_to_rad(135.0))};
}

std::vector<Part> landing_gear() {
  constexpr double kMainRadius_m = 0.078, kNoseRadius_m = 0.064, kClearance_m = 0.003;
  const Vec3 main_m(0.512, -0.168, kMainRadius_m + kClearance_m);
  const Vec3 nose_m(0.041, -1.372, kNoseRadius_m + kClearance_m);
  std::vector<Part> parts = {
      drop(main_m + Vec3(0.0, -0.128, 0.022), 0.325, 0.047, 0.069, kWheelPant),
      rod({{{0.448, -0.205, 0.381}, 0.016}, {{0.478, -0.19, 0.24}, 0.014}, {main_m, 0.012}}, 10,
          kStrut),
      straight_rod({0.176, -0.232, 0.349}, {0.482, -0.185, 0.218}, 0.008, kStrut),
      straight_rod({0.452, -0.03, 0.386}, {0.488, -0.158, 0.19}, 0.007, kStrut),
      // the nose leg is a fork of two tubes
      rod({{{0.017, -1.292, 0.361}, 0.012},
           {{0.017, -1.362, 0.12}, 0.011},
           {{0.017, -1.372, 0.055}, 0.011}},
          10, kStrut),
      straight_rod({0.012, -1.372, nose_m.z()}, {0.057, -1.372, nose_m.z()}, 0.008, kStrut),
      straight_rod({0.026, -1.135, 0.345}, {0.019, -1.346, 0.178}, 0.006, kStrut)};
  add(parts, wheel(main_m, kMainRadius_m, 0.026));
  add(parts, wheel(nose_m, kNoseRadius_m, 0.015));
  // doors of the nose leg's bay, hanging
  Isometry T_world_door = Isometry::Identity();
  T_world_door.translate(Vec3(0.088, -1.27, 0.352));
  T_world_door.rotate(Eigen::AngleAxisd(deg_to_rad(168.0), Vec3::UnitY()));
  parts.push_back(box(T_world_door, {0.006, 0.23, 0.108}, kSkinRed));
  return parts;
}

std::vector<Part> fittings() {
  const Vec3 tank_nose_m(0.781, -0.642, 0.301);
  constexpr std::size_t kPylonPoints = 6;
  const auto pylon_cut = [&](double z_m, double front_m, double back_m) {
    return aerofoil_ring({{tank_nose_m.x(), front_m, z_m},
                          {tank_nose_m.x(), back_m, z_m},
                          Vec3::UnitX(),
                          0.011,
                          0.0},
                         kPylonPoints);
  };
  return {open_rod({{{0.115, -1.580, 0.506}, 0.030},
                    {{0.172, -1.535, 0.500}, 0.030},
                    {{0.208, -1.455, 0.488}, 0.029},
                    {{0.222, -1.300, 0.474}, 0.028}},
                   14, 0.004, 0.10, kExhaust, kDuct),
          drop(tank_nose_m, 0.63, 0.052, 0.052, kTank),
          loft({pylon_cut(0.325, -0.45, -0.17), pylon_cut(0.368, -0.43, -0.14),
                pylon_cut(0.404, -0.40, -0.10)},
               {}, {}, uniform(kWingSkin)),
          rod({{{1.215, -0.35, 0.436}, 0.006},
               {{1.215, -0.52, 0.434}, 0.005},
               {{1.215, -0.615, 0.434}, 0.003}},
              8, kStrut),
          straight_rod({0.045, 1.655, 0.522}, {0.338, 1.633, 0.620}, 0.006, kStrut),
          straight_rod({0.024, 1.690, 0.792}, {0.338, 1.660, 0.625}, 0.004, kStrut),
          drop({1.479, -0.292, 0.460}, 0.085, 0.016, 0.013, kGlass)};
}

}  // namespace gnbv::lab_airplane
