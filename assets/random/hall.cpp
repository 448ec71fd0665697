// Halls: closed with a gable, open at one end (hollow), or with a sawtooth roof.
#include <algorithm>
#include <cmath>

#include "assets/random/parts.hpp"

namespace gnbv::random_parts {
namespace {

struct HallSize {
  double length_m, width_m, eaves_m;
};

HallSize draw_hall(Rng& draws, double size_m) {
  const double width_m = size_m * draws.real(0.32, 0.55);
  const double eaves_m = std::clamp(width_m * draws.real(0.35, 0.7), 1.8, 13.0);
  return {size_m, width_m, eaves_m};
}

/// Across the hall: from the foot of the left wall over the roof to the foot of the right one.
using HallLine = std::vector<Eigen::Vector2d>;  // (y, z)

HallLine gable_line(const HallSize& h, double rise_m) {
  const double y_m = 0.5 * h.width_m;
  return {{-y_m, 0.0}, {-y_m, h.eaves_m}, {0.0, h.eaves_m + rise_m}, {y_m, h.eaves_m}, {y_m, 0.0}};
}

HallLine barrel_line(const HallSize& h, double rise_m) {
  constexpr int kSteps = 10;
  const double y_m = 0.5 * h.width_m;
  HallLine line = {{-y_m, 0.0}};
  for (int i = 0; i <= kSteps; ++i) {
    const double angle_rad = kPi * (1.0 - static_cast<double>(i) / kSteps);
    line.emplace_back(y_m * std::cos(angle_rad), h.eaves_m + rise_m * std::sin(angle_rad));
  }
  line.emplace_back(y_m, 0.0);
  return line;
}

Ring ring_of(const HallLine& line, double x_m) {
  Ring ring;
  for (const Eigen::Vector2d& p : line) ring.emplace_back(x_m, p.x(), p.y());
  return ring;
}

/// Windows of both long walls, and of those the lower half is a door here and there.
Parts wall_details(Rng& draws, const HallSize& h) {
  Parts parts;
  const int bays = std::max(2, static_cast<int>(h.length_m / draws.real(3.0, 6.0)));
  const double bay_m = h.length_m / bays, sill_m = h.eaves_m * draws.real(0.3, 0.5);
  const double head_m = h.eaves_m * draws.real(0.65, 0.85);
  for (int i = 0; i < bays; ++i)
    for (const double side : {-1.0, 1.0}) {
      const double x_m = -0.5 * h.length_m + (i + 0.5) * bay_m, y_m = 0.5 * h.width_m * side;
      const bool is_door = draws.chance(0.15);
      parts += pad({x_m, 0.3 * bay_m, y_m, 0.05, is_door ? 0.02 : sill_m, head_m},
                   is_door ? kDoor : kGlass);
    }
  return parts;
}

Parts closed_hall(Rng& draws, const HallSize& h) {
  const double rise_m = h.width_m * draws.real(0.12, 0.35), over_m = draws.real(0.15, 0.6);
  const Paint wall = draws.chance(0.5) ? kCladding : kBrick;
  const double x_m = 0.5 * h.length_m, y_m = 0.5 * h.width_m;
  Parts parts = {prism(ring_of(gable_line(h, rise_m), -x_m), {h.length_m, 0.0, 0.0}, uniform(wall)),
                 block({-x_m - 0.13, x_m + 0.13, -y_m - 0.13, y_m + 0.13, 0.0, 0.25}, kConcrete)};
  const double slope = rise_m / y_m, eaves_m = h.eaves_m - slope * over_m;
  for (const double side : {-1.0, 1.0}) {
    const double out_m = side * (y_m + over_m), in_m = side * 0.04;
    const double ridge_m = h.eaves_m + rise_m - 0.04 * slope;
    const Ring sheet = {{-x_m - over_m, out_m, eaves_m + 0.02},
                        {-x_m - over_m, out_m, eaves_m + 0.2},
                        {-x_m - over_m, in_m, ridge_m + 0.2 + 0.01 * side},
                        {-x_m - over_m, in_m, ridge_m + 0.02}};
    parts += prism(sheet, {h.length_m + 2.0 * over_m, 0.0, 0.0}, uniform(kRoofing));
  }
  parts += wall_details(draws, h);
  const double gate_m = std::min(0.3 * h.width_m, 4.0);
  parts += block({x_m - 0.06, x_m + 0.07, -gate_m, gate_m, 0.03, 0.75 * h.eaves_m}, kDoor);
  const int vents = draws.whole(1, 5);
  for (int i = 0; i < vents; ++i) {
    const double vent_m = draws.real(0.6, 1.3), radius_m = draws.real(0.2, 0.45);
    parts += drum({h.length_m * ((i + 0.5) / vents - 0.5), 0.0, h.eaves_m + rise_m - 0.1}, radius_m,
                  vent_m, 10, kGalvanised);
  }
  if (draws.chance(0.6)) {  // an annex under a parapet
    const double from_m = h.length_m * draws.real(-0.45, -0.1);
    const double to_m = from_m + h.length_m * draws.real(0.2, 0.5);
    const double depth_m = h.width_m * draws.real(0.2, 0.4);
    parts += parapet_block(
        {from_m, to_m, -y_m - depth_m, -y_m + 0.09, 0.0, h.eaves_m * draws.real(0.45, 0.75)}, 0.3,
        {kPlaster, kConcrete, kRoofing});
  }
  return parts;
}

/// A shell without an end wall to +x: what is inside can be seen, and flown into.
Parts open_hall(Rng& draws, const HallSize& h) {
  const double wall_m = 0.18, x_m = 0.5 * h.length_m;
  const bool is_barrel = draws.chance(0.5);
  const double rise_m = h.width_m * (is_barrel ? draws.real(0.25, 0.5) : draws.real(0.15, 0.35));
  const auto line = [&](double inset_m) {
    const HallSize inner = {h.length_m, h.width_m - 2.0 * inset_m, h.eaves_m - 0.4 * inset_m};
    return is_barrel ? barrel_line(inner, rise_m - 0.6 * inset_m)
                     : gable_line(inner, rise_m - 0.6 * inset_m);
  };
  HallLine shell = line(0.0);
  const HallLine lining = line(wall_m), ribs = line(wall_m + 0.12);
  shell.insert(shell.end(), lining.rbegin(), lining.rend());
  Parts parts = {prism(ring_of(shell, -x_m), {h.length_m, 0.0, 0.0}, uniform(kCladding)),
                 prism(ring_of(line(0.05), -x_m + 0.06), {wall_m, 0.0, 0.0}, uniform(kBrick))};
  const int frames = std::max(3, static_cast<int>(h.length_m / draws.real(3.0, 5.0)));
  for (int i = 1; i < frames; ++i)
    parts += bent_beam(ring_of(ribs, -x_m + h.length_m * i / frames), 0.22, 0.3, kPaintedSteel);
  const int crates = draws.whole(1, 5);
  for (int i = 0; i < crates; ++i) {
    const double at_m = h.length_m * draws.real(-0.42, 0.4),
                 y_m = h.width_m * draws.real(-0.3, 0.3);
    const double side_m = std::min(draws.real(0.8, 2.6), 0.4 * h.eaves_m);
    parts += box(T_world_body({{at_m, y_m, 0.0}, draws.real(0.0, kPi)}),
                 {1.6 * side_m, side_m, side_m}, i % 2 ? kContainerRed : kWood);
  }
  const double rail_m = 0.75 * h.eaves_m, y_m = 0.5 * h.width_m - wall_m - 0.2;
  parts += block({-0.1 * h.length_m, -0.1 * h.length_m + 0.6, -y_m, y_m, rail_m, rail_m + 0.5},
                 kMachineYellow);
  return parts;
}

Parts sawtooth_hall(Rng& draws, const HallSize& h) {
  const double x_m = 0.5 * h.length_m, y_m = 0.5 * h.width_m;
  Parts parts = {pad({0.0, x_m, 0.0, y_m, 0.0, h.eaves_m}, kBrick)};
  const int teeth = std::max(2, static_cast<int>(h.length_m / draws.real(4.0, 7.0)));
  const double pitch_m = h.length_m / teeth, rise_m = pitch_m * draws.real(0.35, 0.6);
  for (int i = 0; i < teeth; ++i) {
    const double from_m = -x_m + i * pitch_m + 0.07, base_m = h.eaves_m - 0.06;
    const Ring tooth = {{from_m, -y_m + 0.11, base_m},
                        {from_m + pitch_m - 0.14, -y_m + 0.11, base_m},
                        {from_m, -y_m + 0.11, base_m + rise_m}};
    parts += prism(tooth, {0.0, h.width_m - 0.22, 0.0}, [](std::size_t, std::size_t side) {
      return side == 2 ? kGlass : kRoofing;  // light from the upright side
    });
  }
  parts += wall_details(draws, h);
  const double stack_m = h.eaves_m * draws.real(1.6, 2.6), radius_m = draws.real(0.35, 0.8);
  parts += upright(revolve_loop({{0.0, 1.3 * radius_m},
                                 {stack_m, radius_m},
                                 {stack_m, 0.72 * radius_m},
                                 {0.0, 0.95 * radius_m}},
                                14, uniform(kBrick)),
                   {x_m * draws.real(-0.8, 0.8), y_m + 1.5 * radius_m, 0.0});
  return parts;
}

}  // namespace

Parts hall(Rng& draws, double size_m) {
  return one_of(draws, draw_hall(draws, size_m), {closed_hall, open_hall, sawtooth_hall});
}

}  // namespace gnbv::random_parts
