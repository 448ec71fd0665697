// Cooling tower and chimneys: thin shells of revolution, open at the top.
#include <cmath>

#include "assets/power_plant_parts.hpp"
#include "assets/solids.hpp"

namespace gnbv::power_plant {
namespace {

constexpr std::size_t kTowerSides = 18;
const Vec3 kTowerFoot_m(-8.93, 4.58, 0.0);

/// Outer radius of the tower's shell, a hyperboloid of one sheet.
double tower_radius_m(double z_m) {
  constexpr double kThroat_m = 1.94, kThroatHeight_m = 6.42, kSlope_m = 4.41;
  return kThroat_m * std::hypot(1.0, (z_m - kThroatHeight_m) / kSlope_m);
}

Part tower_shell() {
  constexpr double kFrom_m = 0.87, kTo_m = 8.46, kTop_m = 8.67, kRim_m = 0.09, kThickness_m = 0.15;
  std::vector<RevolvedPoint> profile;
  for (const double z_m : {kFrom_m, 2.62, 4.57, 6.51, kTo_m})
    profile.push_back({z_m, tower_radius_m(z_m)});
  profile.push_back({kTo_m + 0.04, tower_radius_m(kTo_m) + kRim_m});
  profile.push_back({kTop_m, tower_radius_m(kTop_m) + kRim_m});
  for (const double z_m : {kTop_m, 6.51, 4.57, 2.62, kFrom_m})
    profile.push_back({z_m, tower_radius_m(z_m) - kThickness_m});
  return revolve_loop(profile, kTowerSides, uniform(kTowerConcrete));
}

/// Slanting legs in pairs between basin and shell.
std::vector<Part> tower_legs() {
  constexpr int kPairs = 9;
  constexpr double kFootRadius_m = 3.375, kFootHeight_m = 0.38, kHeadHeight_m = 0.94;
  const double head_radius_m = tower_radius_m(kHeadHeight_m) - 0.075;
  const auto on_circle = [](double radius_m, double turns, double z_m) -> Vec3 {
    const double angle_rad = 2.0 * kPi * turns;
    return {radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), z_m};
  };
  std::vector<Part> parts;
  for (int i = 0; i < kPairs; ++i)
    for (const double lean : {-0.32, 0.32})
      parts.push_back(
          translated(bent_pipe({on_circle(kFootRadius_m, (i + 0.25 * lean) / kPairs, kFootHeight_m),
                                on_circle(head_radius_m, (i + lean) / kPairs, kHeadHeight_m)},
                               0.085, 3, kConcrete),
                     kTowerFoot_m));
  return parts;
}

/// A walkway with a railing around a chimney of radius `chimney_m`.
std::vector<Part> gallery(const Vec3& foot_m, double z_m, double chimney_m) {
  constexpr std::size_t kSides = 8;
  constexpr double kWidth_m = 0.38, kRailing_m = 0.27;
  const double inner_m = chimney_m - 0.09, outer_m = chimney_m + kWidth_m;
  const std::vector<RevolvedPoint> deck = {
      {z_m - 0.17, inner_m}, {z_m + 0.07, outer_m}, {z_m + 0.07, inner_m}};
  std::vector<Part> parts = {upright(revolve_loop(deck, kSides, uniform(kGalvanised)), foot_m)};
  std::vector<Vec3> line_m;
  for (std::size_t k = 0; k <= kSides; ++k) {
    const double angle_rad = 2.0 * kPi * static_cast<double>(k % kSides) / double{kSides};
    line_m.push_back(foot_m + Vec3((outer_m - 0.045) * std::cos(angle_rad),
                                   (outer_m - 0.045) * std::sin(angle_rad), z_m + 0.07));
  }
  add(parts, railing(line_m, kRailing_m, kGasYellow));
  return parts;
}

}  // namespace

std::vector<Part> cooling_tower() {
  const std::vector<RevolvedPoint> basin = {{0.0, 0.0}, {0.0, 3.47}, {0.46, 3.47}, {0.41, 0.0}};
  const std::vector<RevolvedPoint> fill = {{1.07, 0.0}, {1.07, 2.96}, {1.33, 2.91}, {1.33, 0.0}};
  std::vector<Part> parts = {
      upright(tower_shell(), kTowerFoot_m),
      upright(revolve(basin, kTowerSides, uniform(kConcrete)), kTowerFoot_m),
      upright(revolve(fill, kTowerSides / 2, uniform(kLouvre)), kTowerFoot_m)};
  add(parts, tower_legs());
  return parts;
}

std::vector<Part> chimneys() {
  // The tall one of concrete, striped above the roofs.
  const Vec3 tall_m(9.27, 3.13, 0.0);
  const std::vector<RevolvedPoint> tall = {{0.0, 0.88},    {4.71, 0.705}, {11.62, 0.49},
                                           {11.71, 0.575}, {11.97, 0.56}, {11.97, 0.43},
                                           {0.0, 0.64}};
  std::vector<Part> parts = {
      upright(revolve_loop(tall, 13,
                           [](std::size_t segment, std::size_t) -> std::uint16_t {
                             if (segment == 0) return kTowerConcrete;
                             if (segment <= 2) return kStackStripes;
                             return segment <= 4 ? kConcrete : kSoot;
                           }),
              tall_m)};
  add(parts, gallery(tall_m, 8.36, 0.59));

  // The auxiliary boiler's of steel.
  const std::vector<RevolvedPoint> steel = {{0.0, 0.56},  {1.37, 0.37}, {9.33, 0.34}, {9.41, 0.41},
                                            {9.69, 0.39}, {9.69, 0.31}, {0.0, 0.33}};
  parts.push_back(upright(revolve_loop(steel, 10,
                                       [](std::size_t segment, std::size_t) -> std::uint16_t {
                                         if (segment == 0) return kConcrete;
                                         return segment <= 4 ? kInsulatedPipe : kSoot;
                                       }),
                          {9.58, -0.26, 0.0}));
  return parts;
}

}  // namespace gnbv::power_plant
