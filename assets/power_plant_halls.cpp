// Turbine hall with its annex, control building: brickwork.
#include "assets/power_plant_parts.hpp"
#include "assets/solids.hpp"

namespace gnbv::power_plant {
namespace {

constexpr double kRoofThickness_m = 0.09;
constexpr double kRoofSunk_m = 0.03;  // of the slab, below the top of the walls

/// Walls up to extent.z1_m under a gabled roof, ridge along x.
std::vector<Part> gabled(const BlockExtent& e, double ridge_m, double overhang_m, Paint wall,
                         Paint roof) {
  const double middle_m = 0.5 * (e.y0_m + e.y1_m), half_m = 0.5 * (e.y1_m - e.y0_m);
  const Ring walls = {{e.x0_m, e.y0_m, e.z0_m},
                      {e.x0_m, e.y1_m, e.z0_m},
                      {e.x0_m, e.y1_m, e.z1_m},
                      {e.x0_m, middle_m, ridge_m},
                      {e.x0_m, e.y0_m, e.z1_m}};
  const double reach_m = half_m + overhang_m;
  const double eaves_m = ridge_m - (ridge_m - e.z1_m) / half_m * reach_m;
  Ring slab;
  for (const double z_m : {-kRoofSunk_m, kRoofThickness_m - kRoofSunk_m}) {
    const double side = z_m < 0.0 ? 1.0 : -1.0;
    slab.emplace_back(e.x0_m - overhang_m, middle_m - side * reach_m, eaves_m + z_m);
    slab.emplace_back(e.x0_m - overhang_m, middle_m, ridge_m + z_m);
    slab.emplace_back(e.x0_m - overhang_m, middle_m + side * reach_m, eaves_m + z_m);
  }
  const double length_m = e.x1_m - e.x0_m;
  return {prism(walls, length_m * Vec3::UnitX(), uniform(wall)),
          prism(slab, (length_m + 2.0 * overhang_m) * Vec3::UnitX(), uniform(roof))};
}

/// Low range along the south of the hall, its roof falling away from the hall.
std::vector<Part> annex() {
  constexpr double kWest_m = -7.43, kEast_m = 0.83, kSouth_m = -5.43, kNorth_m = -3.77;
  constexpr double kLow_m = 1.97, kHigh_m = 2.43, kOverhang_m = 0.14, kSunk_m = 0.02;
  const double slope = (kHigh_m - kLow_m) / (kNorth_m - kSouth_m);
  const Ring walls = {{kWest_m, kSouth_m, 0.0},
                      {kWest_m, kNorth_m, 0.0},
                      {kWest_m, kNorth_m, kHigh_m},
                      {kWest_m, kSouth_m, kLow_m}};
  const auto roof_point = [&](double y_m, double up_m) -> Vec3 {
    return {kWest_m - kOverhang_m, y_m, kLow_m + slope * (y_m - kSouth_m) - kSunk_m + up_m};
  };
  const double eaves_m = kSouth_m - kOverhang_m, wall_m = kNorth_m - 0.04;
  const Ring roof = {roof_point(eaves_m, 0.0), roof_point(wall_m, 0.0),
                     roof_point(wall_m, kRoofThickness_m), roof_point(eaves_m, kRoofThickness_m)};
  std::vector<Part> parts = {
      prism(walls, (kEast_m - kWest_m) * Vec3::UnitX(), uniform(kBrickRed)),
      prism(roof, (kEast_m - kWest_m + 2.0 * kOverhang_m) * Vec3::UnitX(), uniform(kRoofing)),
      block({-0.13, 0.67, -5.98, -5.36, 0.0, 0.34}, kConcrete),   // doorstep
      block({-0.44, -0.07, -5.93, -5.33, 0.0, 0.17}, kConcrete),  // step
      block({0.06, 0.52, -5.47, -5.34, 0.28, 1.27}, kDoorBlue)};
  for (int i = 0; i < 3; ++i) {
    const double west_m = -6.91 + 2.17 * i;
    parts.push_back(block({west_m, west_m + 1.68, -5.464, -5.36, 0.92, 1.54}, kGlass));
  }
  return parts;
}

}  // namespace

std::vector<Part> turbine_hall() {
  constexpr double kSouth_m = -3.87, kNorth_m = -0.13, kWest_m = -8.23, kEast_m = 1.77;
  std::vector<Part> parts =
      gabled({kWest_m, kEast_m, kSouth_m, kNorth_m, 0.08, 4.03}, 4.66, 0.16, kBrickRed, kRoofing);
  const Ring monitor = {{-7.12, -2.63, 4.18},
                        {-7.12, -1.37, 4.18},
                        {-7.12, -1.37, 5.14},
                        {-7.12, -2.0, 5.37},
                        {-7.12, -2.63, 5.14}};
  parts.push_back(
      prism(monitor, {7.8, 0.0, 0.0}, [](std::size_t, std::size_t side) -> std::uint16_t {
        return side == 2 || side == 3 ? kRoofing : kCladdingLight;
      }));
  parts.push_back(block({-8.33, 1.87, -3.97, -0.03, 0.0, 0.42}, kConcrete));  // plinth
  parts.push_back(block({-6.93, 0.49, -2.67, -1.33, 4.61, 4.98}, kGlass));    // of the monitor
  for (int i = 0; i < 7; ++i) {
    const double x_m = -8.11 + 1.626 * i;
    parts.push_back(
        block({x_m - 0.1, x_m + 0.1, -3.98, -3.79, 0.06, 3.87}, kBrickRed));  // pilaster
    if (i < 6) parts.push_back(block({x_m + 0.29, x_m + 1.336, -3.907, -3.79, 2.72, 3.66}, kGlass));
  }
  parts.push_back(block({-7.79, 1.21, -0.21, -0.088, 2.93, 3.62}, kGlass));      // over the alley
  parts.push_back(block({-8.274, -8.12, -1.83, -0.47, 0.37, 2.04}, kDoorBlue));  // west gable
  parts.push_back(block({-8.268, -8.12, -2.92, -1.08, 2.51, 3.98}, kGlass));
  parts.push_back(block({1.68, 1.812, -2.92, -1.08, 2.28, 3.98}, kGlass));  // east gable
  add(parts, annex());
  return parts;
}

std::vector<Part> control_building() {
  const ParapetPaint buff = {kBrickBuff, kConcrete, kRoofing};
  std::vector<Part> parts = {
      parapet_block({-7.83, -3.47, -7.93, -6.63, 0.0, 1.93}, 0.16, buff),
      parapet_block({-7.31, -5.12, -7.68, -6.88, 1.69, 2.68}, 0.14, buff),
      block({-7.52, -4.63, -7.966, -7.84, 0.93, 1.49}, kGlass),
      block({-4.31, -3.86, -7.972, -7.84, 0.0, 1.13}, kDoorBlue),
      block({-4.46, -3.71, -8.04, -7.86, 1.22, 1.29}, kConcrete),  // canopy
      block({-7.08, -5.34, -7.72, -7.58, 2.03, 2.41}, kGlass),
      block({-4.77, -4.23, -7.41, -6.97, 1.71, 2.18}, kGalvanised)};  // air conditioning
  return parts;
}

}  // namespace gnbv::power_plant
