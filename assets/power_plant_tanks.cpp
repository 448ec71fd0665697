// Tanks, drums, and the pipes between them and the houses.
#include <cmath>

#include "assets/power_plant_parts.hpp"
#include "assets/solids.hpp"

namespace gnbv::power_plant {
namespace {

/// A tank on a flat bottom under a dome.
Part domed_tank(const Vec3& foot_m, double radius_m, double wall_m, double dome_m,
                std::size_t sides, Paint wall, Paint roof) {
  const std::vector<RevolvedPoint> profile = {{0.0, 0.0},
                                              {0.0, radius_m},
                                              {wall_m, radius_m},
                                              {wall_m + 0.68 * dome_m, 0.62 * radius_m},
                                              {wall_m + dome_m, 0.0}};
  return upright(revolve(profile, sides,
                         [&](std::size_t segment, std::size_t) -> std::uint16_t {
                           return segment < 2 ? wall : roof;
                         }),
                 foot_m);
}

/// Treads that climb around a tank from its foot to its roof, on an outer stringer.
std::vector<Part> spiral_stairs(const Vec3& foot_m, double radius_m, double to_m) {
  constexpr int kTreads = 8;
  constexpr double kWidth_m = 0.36, kFrom_rad = -2.6, kTurn_rad = 2.1;
  const auto at = [&](double t, double out_m, double up_m) -> Vec3 {
    const double angle_rad = kFrom_rad + kTurn_rad * t;
    return foot_m + Vec3((radius_m + out_m) * std::cos(angle_rad),
                         (radius_m + out_m) * std::sin(angle_rad), 0.13 + (to_m - 0.13) * t + up_m);
  };
  std::vector<Part> parts;
  for (int k = 0; k < kTreads; ++k) {
    const double t = (k + 0.5) / kTreads;
    parts.push_back(beam(at(t, -0.06, 0.0), at(t, kWidth_m, 0.0), 0.33, 0.036, kGalvanised));
  }
  std::vector<Vec3> line_m;
  for (int k = 0; k <= 5; ++k) line_m.push_back(at(k / 5.0, kWidth_m, 0.0));
  parts.push_back(bent_beam(line_m, 0.04, 0.12, kGasYellow));
  for (Vec3& p : line_m) p.z() += 0.04;
  add(parts, railing(line_m, 0.27, kGasYellow));
  return parts;
}

/// A lying vessel on two saddles, axis along x.
std::vector<Part> drum(const Vec3& middle_m, double length_m, double radius_m, Paint paint) {
  const double straight_m = 0.5 * length_m - 0.5 * radius_m, end_m = 0.5 * length_m;
  const std::vector<RevolvedPoint> profile = {
      {-end_m, 0.0},          {-end_m + 0.16 * radius_m, 0.62 * radius_m}, {-straight_m, radius_m},
      {straight_m, radius_m}, {end_m - 0.16 * radius_m, 0.62 * radius_m},  {end_m, 0.0}};
  std::vector<Part> parts = {lying_along_x(revolve(profile, 10, uniform(paint)), middle_m)};
  for (const double sign : {-1.0, 1.0}) {
    const double x_m = middle_m.x() + sign * 0.58 * straight_m;
    const double foot_m = 0.62 * radius_m, head_m = 0.86 * radius_m;
    parts.push_back(prism({{x_m - 0.09, middle_m.y() - foot_m, 0.0},
                           {x_m - 0.09, middle_m.y() + foot_m, 0.0},
                           {x_m - 0.09, middle_m.y() + head_m, middle_m.z() - 0.32 * radius_m},
                           {x_m - 0.09, middle_m.y() - head_m, middle_m.z() - 0.32 * radius_m}},
                          {0.18, 0.0, 0.0}, uniform(kConcrete)));
  }
  return parts;
}

/// Retaining wall around the oil tanks.
Part bund() {
  constexpr double kWest_m = 4.27, kEast_m = 12.39, kSouth_m = -8.09, kNorth_m = -4.13;
  const auto corner = [](double x_m, double y_m, double in_x, double in_y) -> Ring {
    constexpr double kThickness_m = 0.16, kHeight_m = 0.58;
    const double x1_m = x_m + in_x * kThickness_m, y1_m = y_m + in_y * kThickness_m;
    return {{x_m, y_m, 0.0}, {x1_m, y1_m, 0.0}, {x1_m, y1_m, kHeight_m}, {x_m, y_m, kHeight_m}};
  };
  return loft_loop({corner(kWest_m, kSouth_m, 1.0, 1.0), corner(kEast_m, kSouth_m, -1.0, 1.0),
                    corner(kEast_m, kNorth_m, -1.0, -1.0), corner(kWest_m, kNorth_m, 1.0, -1.0)},
                   uniform(kConcrete));
}

}  // namespace

std::vector<Part> tank_farm() {
  const Vec3 large_m(10.13, -6.02, 0.0), high_m(6.08, -6.13, 0.0);
  std::vector<Part> parts = {
      bund(),
      domed_tank(large_m, 1.66, 3.12, 0.62, 14, kTankWhite, kTankWhite),
      domed_tank(high_m, 1.38, 4.27, 0.48, 13, kTankGreen, kTankWhite),
      domed_tank({2.88, -7.02, 0.0}, 0.78, 2.26, 0.39, 11, kTankWhite, kTankGreen),
      domed_tank({-0.67, -7.01, 0.0}, 0.87, 1.87, 0.34, 12, kTankWhite, kTankWhite),
      bent_pipe(
          {{6.08, -6.62, 0.36}, {6.08, -7.62, 0.36}, {8.92, -7.62, 0.36}, {9.52, -6.87, 0.36}},
          0.11, 6, kRustyPipe)};
  add(parts, spiral_stairs(large_m, 1.66, 3.19));
  return parts;
}

std::vector<Part> drums() {
  std::vector<Part> parts = drum({6.43, -3.32, 0.92}, 3.46, 0.43, kTankWhite);
  add(parts, drum({6.79, -2.13, 0.84}, 2.64, 0.39, kGasYellow));
  return parts;
}

std::vector<Part> pipe_rack() {
  constexpr double kWest_m = 2.91, kEast_m = 3.79, kLow_m = 1.83, kHigh_m = 2.62, kBar_m = 0.11;
  std::vector<Part> parts;
  for (const double y_m : {-5.71, -3.57, -1.43, 0.98}) {
    for (const double x_m : {kWest_m, kEast_m})
      parts.push_back(
          beam({x_m, y_m, 0.0}, {x_m, y_m, kHigh_m + 0.16}, kBar_m, kBar_m, kGalvanised));
    for (const double z_m : {kLow_m, kHigh_m})
      parts.push_back(
          beam({kWest_m - 0.09, y_m, z_m}, {kEast_m + 0.09, y_m, z_m}, 0.09, 0.13, kGalvanised));
  }
  // across the alley between turbine hall and boiler house
  for (const double x_m : {0.87, -2.06})
    parts.push_back(beam({x_m, -0.22, kLow_m}, {x_m, 1.36, kLow_m}, 0.09, 0.13, kGalvanised));

  // what the tanks send to the houses: x, y and z from south to north, then west
  const double low_m = kLow_m + 0.06, high_m = kHigh_m + 0.06;
  parts.push_back(bent_pipe({{2.88, -6.63, low_m + 0.12},
                             {3.12, -5.93, low_m + 0.12},
                             {3.12, 0.31, low_m + 0.12},
                             {-2.58, 0.31, low_m + 0.12},
                             {-2.58, -0.23, low_m + 0.12}},
                            0.13, 6, kRustyPipe));
  parts.push_back(bent_pipe(eased({{4.97, -5.92, low_m + 0.15},
                                   {3.52, -5.92, low_m + 0.15},
                                   {3.52, 0.78, low_m + 0.15},
                                   {-3.47, 0.78, low_m + 0.15},
                                   {-3.47, 1.41, low_m + 0.15}},
                                  0.2),
                            0.16, 6, kInsulatedPipe));
  parts.push_back(bent_pipe({{6.93, -2.13, 1.14},
                             {6.93, -2.13, high_m + 0.07},
                             {3.07, -2.13, high_m + 0.07},
                             {3.07, 0.46, high_m + 0.07},
                             {1.07, 0.46, high_m + 0.07},
                             {1.07, -0.22, high_m + 0.07}},
                            0.07, 5, kGasYellow));
  parts.push_back(bent_pipe({{4.94, -5.53, high_m + 0.1},
                             {3.56, -5.53, high_m + 0.1},
                             {3.56, 1.62, high_m + 0.1},
                             {3.56, 1.62, 4.37},
                             {1.98, 1.62, 4.37}},
                            0.1, 6, kTankGreen));
  return parts;
}

}  // namespace gnbv::power_plant
