// Transformer yard in the south-west, coal and ash handling in the east.
#include <cmath>
#include <utility>

#include "assets/power_plant_parts.hpp"
#include "assets/solids.hpp"

namespace gnbv::power_plant {
namespace {

/// Tank with radiators, bushings and conservator; its bus duct leads east through the wall.
std::vector<Part> transformer(double y_m, double wall_x_m) {
  constexpr double kWest_m = -11.38, kEast_m = -9.97, kTop_m = 1.57;
  std::vector<Part> parts = {
      block({-11.79, -9.58, y_m - 0.94, y_m + 0.94, 0.0, 0.23}, kConcrete),
      block({kWest_m, kEast_m, y_m - 0.44, y_m + 0.44, 0.17, kTop_m}, kTransformerGreen),
      beam({-10.21, y_m, 1.41}, {wall_x_m + 0.09, y_m, 1.41}, 0.31, 0.26, kInsulatedPipe)};
  for (int i = 0; i < 3; ++i) {
    const double x_m = -11.13 + 0.45 * i;
    parts.push_back(
        block({x_m - 0.09, x_m + 0.09, y_m - 0.71, y_m + 0.71, 0.43, 1.38}, kTransformerGreen));
  }
  const std::vector<RevolvedPoint> bushing = {{0.0, 0.0}, {0.0, 0.095}, {0.61, 0.045}, {0.64, 0.0}};
  for (const double x_m : {-11.16, -10.83, -10.5})
    parts.push_back(
        upright(revolve(bushing, 4, uniform(kCeramic)), {x_m, y_m - 0.14, kTop_m - 0.05}));
  const std::vector<RevolvedPoint> conservator = {
      {0.0, 0.0}, {0.04, 0.16}, {0.93, 0.16}, {0.97, 0.0}};
  parts.push_back(
      lying_along_x(revolve(conservator, 6, uniform(kGalvanised)), {-11.22, y_m + 0.26, 1.69}));
  return parts;
}

/// Where the lines leave: two towers of two legs, a beam, three strings of insulators.
std::vector<Part> line_gantry() {
  constexpr double kX_m = -11.93, kTop_m = 4.13;
  std::vector<Part> parts;
  for (const double y_m : {-7.13, -0.77}) {
    for (const auto& [lean_m, width_m] : {std::pair{-0.42, 0.12}, {0.42, 0.13}})
      parts.push_back(post({kX_m + lean_m, y_m, 0.0}, {kX_m, y_m, kTop_m + 2.5 * width_m}, width_m,
                           kGalvanised));
  }
  parts.push_back(beam({kX_m, -7.27, kTop_m}, {kX_m, -0.63, kTop_m}, 0.17, 0.17, kGalvanised));
  for (const double y_m : {-5.78, -3.93, -2.09})
    parts.push_back(
        bent_pipe({{kX_m, y_m, kTop_m - 0.84}, {kX_m, y_m, kTop_m - 0.04}}, 0.07, 4, kCeramic));
  return parts;
}

/// A heap as it is tipped: irregular, its ridge along x.
Part coal_heap() {
  constexpr std::size_t kSides = 12;
  const Vec3 middle_m(7.77, 6.46, 0.0);
  const auto ring = [&](double scale, double z_m) {
    Ring points;
    for (std::size_t k = 0; k < kSides; ++k) {
      const double a = 2.0 * kPi * static_cast<double>(k) / double{kSides};
      const double wobble =
          1.0 + 0.07 * std::sin(3.0 * a + 1.0) + 0.05 * std::sin(5.0 * a + 4.0 * scale);
      points.push_back(middle_m + Vec3((2.1 * scale + 0.2) * wobble * std::cos(a),
                                       1.42 * scale * wobble * std::sin(a),
                                       z_m * (1.0 + 0.12 * std::sin(2.0 * a + 0.5))));
    }
    return points;
  };
  return loft({ring(1.0, 0.0), ring(0.62, 0.72), ring(0.29, 1.17)}, {middle_m},
              {middle_m + Vec3(0.06, 0.03, 1.38)}, uniform(kCoal));
}

std::vector<Part> ash_silo(const Vec3& foot_m) {
  constexpr double kRadius_m = 0.79, kLeg_m = 0.56;
  const std::vector<RevolvedPoint> profile = {
      {0.68, 0.0}, {0.68, 0.12}, {1.38, kRadius_m}, {4.07, kRadius_m}, {4.52, 0.0}};
  std::vector<Part> parts = {upright(revolve(profile, 11,
                                             [](std::size_t segment, std::size_t) -> std::uint16_t {
                                               return segment == 2 ? kCladdingBlue : kGalvanised;
                                             }),
                                     foot_m)};
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      parts.push_back(bent_pipe(
          {foot_m + Vec3(x * kLeg_m, y * kLeg_m, 0.0), foot_m + Vec3(x * kLeg_m, y * kLeg_m, 1.67)},
          0.09, 3, kConcrete));
  return parts;
}

/// Inclined gallery from the transfer house up to the bunkers, on trestles.
std::vector<Part> conveyor() {
  const Vec3 low_m(11.04, 6.31, 1.77), high_m(1.47, 6.31, 6.87);
  const Vec3 along_m = high_m - low_m;
  const auto upright_cut = [](const Vec3& at_m, double half_width_m, double from_m, double to_m,
                              double peak_m) -> Ring {
    return {at_m + Vec3(0.0, -half_width_m, from_m), at_m + Vec3(0.0, half_width_m, from_m),
            at_m + Vec3(0.0, half_width_m, to_m), at_m + Vec3(0.0, 0.0, peak_m),
            at_m + Vec3(0.0, -half_width_m, to_m)};
  };
  std::vector<Part> parts = {prism(upright_cut(low_m, 0.42, -0.37, 0.36, 0.52), along_m,
                                   [](std::size_t, std::size_t side) -> std::uint16_t {
                                     return side == 2 || side == 3 ? kGalvanised : kCladdingLight;
                                   }),
                             prism(upright_cut(low_m + 0.13 * along_m, 0.455, -0.02, 0.22, 0.26),
                                   0.73 * along_m, uniform(kGlass))};
  for (const double t : {0.27, 0.66}) {
    const Vec3 head_m = low_m + t * along_m + Vec3(0.0, 0.0, -0.28);
    for (const double sign : {-1.0, 1.0})
      parts.push_back(post({head_m.x(), head_m.y() + sign * (0.33 + 0.11 * head_m.z()), 0.0},
                           {head_m.x(), head_m.y() + sign * 0.31, head_m.z()}, 0.15, kGalvanised));
    const double brace_m = 0.46 * head_m.z(), reach_m = 0.36 + 0.06 * head_m.z();
    parts.push_back(beam({head_m.x(), head_m.y() - reach_m, brace_m},
                         {head_m.x(), head_m.y() + reach_m, brace_m}, 0.1, 0.1, kGalvanised));
  }
  return parts;
}

}  // namespace

std::vector<Part> transformer_yard() {
  std::vector<Part> parts = transformer(-2.23, -8.23);
  add(parts, transformer(-5.07, -7.43));
  parts.push_back(block({-11.63, -9.37, -3.76, -3.57, 0.0, 2.42}, kConcrete));  // fire wall
  add(parts, line_gantry());
  return parts;
}

std::vector<Part> coal_handling() {
  std::vector<Part> parts = {
      coal_heap(),
      parapet_block({10.58, 12.23, 5.43, 7.19, 0.0, 2.57}, 0.13, {kBrickBuff, kConcrete, kRoofing}),
      block({11.03, 11.79, 5.388, 5.52, 0.0, 1.27}, kDoorBlue),
      block({12.14, 12.272, 5.92, 6.71, 1.27, 1.93}, kGlass)};
  add(parts, conveyor());
  add(parts, ash_silo({11.42, -2.41, 0.0}));
  add(parts, ash_silo({11.42, -0.38, 0.0}));
  // ash comes over from the precipitator
  parts.push_back(
      bent_pipe({{6.17, 2.37, 0.97}, {7.42, 1.08, 0.97}, {11.42, 1.08, 0.97}, {11.42, -0.38, 0.97}},
                0.08, 4, kRustyPipe));
  return parts;
}

}  // namespace gnbv::power_plant
