// Cranes: a tower crane, and a gantry crane on rails.
#include <algorithm>
#include <cmath>

#include "assets/random/parts.hpp"

namespace gnbv::random_parts {
namespace {

/// Square sections upwards.
std::vector<Ring> shaft(double width_m, double from_m, double to_m) {
  const int bays = std::max(3, static_cast<int>((to_m - from_m) / (1.1 * width_m)));
  return stepped(
      bays, [&](int i) { return square(0.0, 0.0, from_m + (to_m - from_m) * i / bays, width_m); });
}

/// Triangles along x: two chords below, one above.
std::vector<Ring> jib(double from_m, double to_m, double z_m, double width_m) {
  const int bays = std::max(4, static_cast<int>(std::abs(to_m - from_m) / (1.2 * width_m)));
  return stepped(bays, [&](int i) -> Ring {
    const double x_m = from_m + (to_m - from_m) * i / bays;
    return {{x_m, -0.5 * width_m, z_m}, {x_m, 0.5 * width_m, z_m}, {x_m, 0.0, z_m + 0.9 * width_m}};
  });
}

Parts tower_crane(Rng& draws, double size_m) {
  const double height_m = size_m * draws.real(0.6, 0.95), jib_m = size_m * draws.real(0.55, 0.75);
  const double counter_m = jib_m * draws.real(0.28, 0.36), width_m = 0.45 + 0.022 * size_m;
  const double slew_m = 0.82 * height_m, apex_m = height_m;
  const Bars bars = {.chord_m = 0.08 + 0.0025 * size_m, .brace_m = 0.06, .paint = kMachineYellow};
  Parts parts = lattice(shaft(width_m, 0.3, slew_m), bars);
  const double base_m = std::max(1.6 * width_m, 0.06 * size_m);
  parts += pad({0.0, base_m, 0.0, base_m, 0.0, 0.55}, kConcrete);
  parts += drum({0, 0, slew_m - 0.1}, 0.75 * width_m, 0.45, 16, kGalvanised);
  const double z_m = slew_m + 0.5;
  parts += lattice(jib(0.35 * width_m, jib_m, z_m, 0.8 * width_m), bars);
  parts += lattice(jib(-0.35 * width_m, -counter_m, z_m, 0.75 * width_m), bars);
  parts += block({-0.98 * counter_m, -0.72 * counter_m, -0.34 * width_m, 0.34 * width_m,
                  z_m - 1.1 * width_m, z_m + 0.6 * width_m},
                 kConcrete);
  // the head and its ties
  for (const double x : {-0.3, 0.3})
    for (const double y : {-0.4, 0.4})
      parts += beam({x * width_m, y * width_m, z_m - 0.2}, {0.1 * x, 0.1 * y, apex_m},
                    1.3 * bars.chord_m, 1.2 * bars.chord_m, kMachineYellow);
  for (const double end_m : {0.45 * jib_m, 0.8 * jib_m, -0.85 * counter_m})
    parts += bent_pipe({{0.0, 0.0, apex_m - 0.1}, {end_m, 0.0, z_m + 0.7 * width_m}}, 0.04, 6,
                       kGalvanised);
  parts += box(T_world_body({{0.6 * width_m, -0.95 * width_m, z_m - 0.2}, 0.0}),
               {1.1 * width_m, 0.9 * width_m, std::max(1.3, 1.1 * width_m)}, kGlass);
  const double trolley_m = jib_m * draws.real(0.3, 0.9), hook_m = slew_m * draws.real(0.2, 0.8);
  parts += pad({trolley_m, 0.4, 0.0, 0.4 * width_m, z_m - 0.35, z_m - 0.02}, kGalvanised);
  parts +=
      bent_pipe({{trolley_m, 0.02, hook_m}, {trolley_m, 0.02, z_m - 0.2}}, 0.04, 6, kGalvanised);
  parts +=
      box(T_world_body({{trolley_m, 0.0, hook_m - 0.5}, 0.4}), {0.4, 0.3, 0.6}, kMachineYellow);
  if (draws.chance(0.5))  // a load on the hook
    parts += box(T_world_body({{trolley_m, 0.0, hook_m - 1.1}, draws.real(0.0, kPi)}),
                 {0.08 * size_m, 0.9, 0.65}, kWood);
  return parts;
}

/// What stands between the legs.
Parts stacked_containers(Rng& draws, double span_m, double girder_m, double half_m) {
  Parts parts;
  const int stacked = draws.whole(0, 4);
  for (int i = 0; i < stacked; ++i) {
    const double x_m = span_m * (0.8 * (i + 0.5) / stacked - 0.4),
                 z_m = girder_m * draws.whole(1, 2);
    parts += block(
        {x_m - 0.08 * span_m, x_m + 0.08 * span_m, -0.35 * half_m, 0.3 * half_m, 0.0, 1.3 * z_m},
        i % 2 == 0 ? kContainerBlue : kContainerRed);
  }
  return parts;
}

/// Two pairs of legs, two girders that reach over, a trolley, something to lift below.
Parts gantry_crane(Rng& draws, double size_m) {
  const double reach_m = 0.5 * size_m, span_m = size_m * draws.real(0.6, 0.75);
  const double height_m = size_m * draws.real(0.4, 0.65), gauge_m = size_m * draws.real(0.22, 0.32);
  const double girder_m = 0.35 + 0.028 * size_m, leg_m = 0.25 + 0.016 * size_m;
  const Paint steel = draws.chance(0.5) ? kMachineYellow : kContainerBlue;
  Parts parts;
  const double under_m = height_m - girder_m, half_m = 0.5 * gauge_m;
  for (const double y_m : {-0.4 * half_m, 0.4 * half_m})
    parts += pad({0.0, reach_m, y_m, 0.3 * girder_m, under_m, height_m}, steel);
  for (const double side : {-1.0, 1.0}) {
    const double x_m = 0.5 * side * span_m;
    for (const double end : {-1.0, 1.0})
      parts +=
          post({x_m, end * half_m, 0.5}, {x_m, end * 0.4 * half_m, under_m + 0.1}, leg_m, steel);
    const double sill_m = std::max(0.9, 0.12 * height_m);
    parts += beam({x_m, -half_m, sill_m}, {x_m, half_m, sill_m}, 0.8 * leg_m, 0.9 * leg_m, steel);
    parts += beam({x_m, -0.48 * half_m, 0.85 * under_m}, {x_m, 0.48 * half_m, 0.85 * under_m},
                  0.7 * leg_m, 0.75 * leg_m, steel);
    for (const double end : {-1.0, 1.0})
      parts += pad({x_m, 0.7 * leg_m, end * half_m, 1.1 * leg_m, 0.12, 0.62}, kGalvanised);
    parts += pad({x_m, 0.12, 0.0, 0.7 * gauge_m, 0.0, 0.16}, kPaintedSteel);
  }
  const double at_m = span_m * draws.real(-0.4, 0.4);
  parts +=
      pad({at_m, girder_m, 0.0, 0.62 * half_m, height_m - 0.03, height_m + 0.9 * girder_m}, kWhite);
  parts += block({at_m + 0.9 * girder_m, at_m + 2.1 * girder_m, -0.25 * half_m, 0.3 * half_m,
                  under_m - 1.1 * girder_m, under_m - 0.1},
                 kGlass);
  parts += beam({at_m + 1.5 * girder_m, 0.0, under_m - 0.3},
                {at_m + 0.5 * girder_m, 0.1, height_m + 0.2}, 0.2, 0.2, kGalvanised);
  const double load_m = under_m * draws.real(0.35, 0.7);
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      parts += bent_pipe({{at_m + 0.6 * x * girder_m, 0.25 * y * half_m, load_m},
                          {at_m + 0.6 * x * girder_m, 0.25 * y * half_m, height_m + 0.1}},
                         0.03, 5, kGalvanised);
  parts += pad({at_m, 1.6 * girder_m, 0.0, 0.4 * half_m, load_m - 1.2 * girder_m, load_m + 0.06},
               kContainerRed);
  parts += stacked_containers(draws, span_m, girder_m, half_m);
  return parts;
}

}  // namespace

Parts crane(Rng& draws, double size_m) {
  return draws.chance(0.6) ? tower_crane(draws, size_m) : gantry_crane(draws, size_m);
}

}  // namespace gnbv::random_parts
