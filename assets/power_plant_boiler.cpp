// Boiler house, its stair tower, and where the flue gas goes: precipitator, auxiliary boiler.
#include "assets/power_plant_parts.hpp"
#include "assets/solids.hpp"

namespace gnbv::power_plant {
namespace {

/// A level rectangle across x, for ducts that change their section on the way east.
Ring cut(double x_m, const Vec3& middle_m, double width_m, double height_m) {
  const double y_m = 0.5 * width_m, z_m = 0.5 * height_m;
  return {{x_m, middle_m.y() - y_m, middle_m.z() - z_m},
          {x_m, middle_m.y() + y_m, middle_m.z() - z_m},
          {x_m, middle_m.y() + y_m, middle_m.z() + z_m},
          {x_m, middle_m.y() - y_m, middle_m.z() + z_m}};
}

/// A pyramid upside down, its mouth `x_m` by `y_m` wide at `mouth_m`.
Part hopper(const Vec3& mouth_m, double x_m, double y_m, double height_m) {
  constexpr double kOutlet = 0.16;
  const auto rectangle = [&](double scale, double down_m) -> Ring {
    const double x = 0.5 * scale * x_m, y = 0.5 * scale * y_m, z = mouth_m.z() - down_m;
    return {{mouth_m.x() - x, mouth_m.y() - y, z},
            {mouth_m.x() + x, mouth_m.y() - y, z},
            {mouth_m.x() + x, mouth_m.y() + y, z},
            {mouth_m.x() - x, mouth_m.y() + y, z}};
  };
  return loft({rectangle(kOutlet, height_m), rectangle(1.0, 0.0)}, {}, {}, uniform(kGalvanised));
}

std::vector<Part> precipitator() {
  const Vec3 middle_m(0.0, 3.06, 3.41);
  std::vector<Part> parts = {
      block({3.97, 6.93, 1.64, 4.48, 1.88, 4.73}, kCladdingLight),
      loft({cut(3.21, middle_m, 0.92, 0.92), cut(4.06, middle_m, 2.44, 2.32)}, {}, {},
           uniform(kInsulatedPipe)),
      loft({cut(6.84, middle_m, 2.44, 2.32), cut(7.63, middle_m, 0.86, 0.86)}, {}, {},
           uniform(kInsulatedPipe)),
      // from the boiler house down to the inlet, from the outlet into the chimney
      bent_beam({{2.04, 3.06, 5.66}, {2.61, 3.06, 5.66}, {3.02, 3.06, 3.41}, {3.29, 3.06, 3.41}},
                0.93, 0.94, kInsulatedPipe),
      beam({7.54, 3.06, 3.41}, {8.83, 3.12, 3.41}, 0.87, 0.86, kInsulatedPipe)};
  for (const double x_m : {4.13, 6.77})
    for (const double y_m : {1.78, 4.33})
      parts.push_back(
          block({x_m - 0.09, x_m + 0.09, y_m - 0.09, y_m + 0.09, 0.0, 1.96}, kGalvanised));
  for (const double x_m : {4.73, 6.17})
    for (const double y_m : {2.37, 3.75})
      parts.push_back(hopper({x_m, y_m, 1.93}, 1.31, 1.27, 1.04));
  for (const double x_m : {4.77, 6.13})  // rectifiers
    parts.push_back(block({x_m - 0.26, x_m + 0.26, 2.68, 3.42, 4.61, 5.07}, kTransformerGreen));
  add(parts, railing({{4.03, 4.42, 4.73},
                      {4.03, 1.70, 4.73},
                      {6.87, 1.70, 4.73},
                      {6.87, 4.42, 4.73},
                      {4.03, 4.42, 4.73}},
                     0.27, kGasYellow));
  return parts;
}

std::vector<Part> auxiliary_boiler() {
  return {parapet_block({5.18, 7.92, -1.07, 0.57, 0.0, 2.43}, 0.12,
                        {kCladdingBlue, kGalvanised, kRoofing}),
          block({5.67, 7.08, -0.73, 0.28, 2.22, 3.32}, kCladdingLight),
          block({5.44, 6.27, -1.112, -0.97, 0.07, 1.34}, kDoorBlue),
          block({6.63, 7.66, -1.108, -0.97, 0.93, 1.82}, kLouvre),
          bent_beam(
              {{7.78, -0.26, 1.86}, {8.37, -0.26, 1.86}, {8.83, -0.26, 2.57}, {9.47, -0.26, 2.57}},
              0.47, 0.53, kInsulatedPipe)};
}

}  // namespace

std::vector<Part> boiler_house() {
  std::vector<Part> parts = {
      parapet_block({-4.17, 2.13, 1.27, 5.43, 0.07, 7.23}, 0.17,
                    {kCladdingBlue, kGalvanised, kRoofing}),
      parapet_block({-3.37, 1.33, 1.93, 4.87, 6.91, 9.12}, 0.16,
                    {kCladdingLight, kGalvanised, kRoofing}),
      parapet_block({-2.63, -0.37, 2.46, 4.37, 8.83, 9.88}, 0.12,
                    {kCladdingBlue, kGalvanised, kRoofing}),
      parapet_block({-1.27, 1.93, 5.28, 6.97, 0.0, 8.08}, 0.16,  // coal bunkers
                    {kCladdingLight, kGalvanised, kRoofing}),
      block({-4.27, 2.23, 1.17, 5.53, 0.0, 0.58}, kConcrete),  // plinth
      block({-3.72, 1.63, 1.228, 1.36, 5.57, 6.14}, kGlass),   // south, above the turbine hall
      block({-3.72, 1.63, 1.223, 1.36, 6.42, 6.83}, kLouvre),
      block({-4.209, -4.07, 2.93, 3.77, 0.73, 4.86}, kGlass),
      block({2.03, 2.172, 1.57, 2.33, 0.63, 4.82}, kGlass),  // east
      block({2.03, 2.168, 3.92, 5.12, 5.07, 6.61}, kLouvre),
      block({-2.86, 0.84, 1.887, 2.03, 8.03, 8.62}, kLouvre),
      block({-3.414, -3.28, 2.31, 4.47, 8.03, 8.62}, kLouvre),
      block({-0.83, 1.49, 6.88, 7.014, 0.0, 1.97}, kDoorBlue),  // bunkers: truck gate
      block({-0.92, 1.58, 6.88, 7.008, 6.93, 7.52}, kGlass)};
  const std::vector<RevolvedPoint> vent = {{0.0, 0.0}, {0.0, 0.09}, {0.53, 0.19}, {0.63, 0.0}};
  for (const Vec3& foot_m : {Vec3(0.42, 2.57, 8.88), Vec3(0.42, 4.13, 8.88)})
    parts.push_back(upright(revolve(vent, 8, uniform(kGalvanised)), foot_m));
  // safety valves blow off above the roof
  for (const double y_m : {3.07, 3.66})
    parts.push_back(bent_pipe({{-0.47, y_m, 9.33}, {0.04, y_m, 9.33}, {0.04, y_m, 10.47}}, 0.075, 6,
                              kInsulatedPipe));
  return parts;
}

std::vector<Part> stair_tower() {
  constexpr double kWall_m = 5.37, kOuter_m = 6.57, kThickness_m = 0.07;
  constexpr double kWest_m = -3.48, kEast_m = -1.96;  // between the landings
  constexpr double kOuterLane_m = 6.28, kInnerLane_m = 5.77, kRise_m = 1.42, kFoot_m = 0.12;
  std::vector<Part> parts = {block({-4.21, -3.19, 5.96, 6.71, 0.0, 0.13}, kConcrete)};
  for (int i = 0; i < 3; ++i) {
    const bool is_east = i % 2 == 0;  // where the flight leads
    const double lane_m = is_east ? kOuterLane_m : kInnerLane_m;
    const double from_m = kFoot_m + kRise_m * i, to_m = from_m + kRise_m;
    const double lower_x_m = is_east ? kWest_m : kEast_m, upper_x_m = is_east ? kEast_m : kWest_m;
    add(parts, stairs({{lower_x_m, lane_m, from_m}, {upper_x_m, lane_m, to_m}, 0.44, 5},
                      kGalvanised, kGasYellow));
    const double west_m = is_east ? kEast_m - 0.06 : -4.12,
                 east_m = is_east ? -1.22 : kWest_m + 0.06;
    parts.push_back(
        block({west_m, east_m, kWall_m, kOuter_m, to_m - kThickness_m, to_m}, kGalvanised));
    if (is_east)
      add(parts, railing({{lower_x_m, kOuter_m - 0.06, from_m + 0.03},
                          {upper_x_m, kOuter_m - 0.06, to_m + 0.03},
                          {-1.38, kOuter_m - 0.06, to_m}},
                         0.28, kGasYellow));
    else
      add(parts, railing({{kWest_m + 0.02, kOuter_m - 0.06, to_m},
                          {-4.06, kOuter_m - 0.06, to_m},
                          {-4.06, kWall_m + 0.13, to_m}},
                         0.28, kGasYellow));
  }
  for (const double x_m : {-4.08, -1.41})
    parts.push_back(block({x_m - 0.05, x_m + 0.05, 6.54, 6.66, 0.0, 4.79}, kGalvanised));
  parts.push_back(block({-1.83, -1.41, 5.33, 5.474, 4.32, 5.27}, kDoorBlue));
  return parts;
}

std::vector<Part> flue_gas_path() {
  std::vector<Part> parts = precipitator();
  add(parts, auxiliary_boiler());
  return parts;
}

}  // namespace gnbv::power_plant
