// Bridges along x between two abutments: on girders, in a truss, under an arch, on stays.
#include <algorithm>
#include <cmath>

#include "assets/random/parts.hpp"

namespace gnbv::random_parts {
namespace {

struct Deck {
  double length_m, width_m, z_m;  // its upper face
  double half_m() const { return 0.5 * length_m; }
  double side_m() const { return 0.5 * width_m; }
};

Deck draw_deck(Rng& draws, double size_m) {
  const double width_m = std::max(1.6, size_m * draws.real(0.12, 0.22));
  const double z_m = std::max(2.0, size_m * draws.real(0.12, 0.3));
  return {size_m, width_m, z_m};
}

/// Roadway, kerbs, railings, and the abutments that its ends rest on.
Parts roadway(const Deck& d) {
  const double x_m = d.half_m(), y_m = d.side_m(), thickness_m = 0.18 + 0.006 * d.length_m;
  Parts parts = {pad({0.0, x_m, 0.0, y_m, d.z_m - thickness_m, d.z_m}, kConcrete),
                 block({-x_m + 0.04, x_m - 0.03, -0.7 * y_m, 0.7 * y_m, d.z_m - 0.05, d.z_m + 0.05},
                       kAsphalt)};
  const double rail_m = std::min(1.1, 0.4 * d.width_m);
  for (const double side : {-1.0, 1.0}) {
    parts +=
        railing({{-x_m + 0.1, side * (y_m - 0.09), d.z_m}, {x_m - 0.1, side * (y_m - 0.09), d.z_m}},
                rail_m, kPaintedSteel);
    const double bank_m = 0.06 * d.length_m + 0.5, at_m = side * (x_m - 0.5 * bank_m);
    const Ring section = {{at_m - 0.62 * bank_m, -1.1 * y_m, 0.0},
                          {at_m + 0.6 * bank_m, -1.1 * y_m, 0.0},
                          {at_m + 0.43 * bank_m, -1.1 * y_m, d.z_m - thickness_m + 0.03},
                          {at_m - 0.41 * bank_m, -1.1 * y_m, d.z_m - thickness_m + 0.03}};
    parts += prism(section, {0.0, 2.2 * y_m, 0.0}, uniform(kBrick));
  }
  return parts;
}

Parts girder_bridge(Rng& draws, const Deck& d) {
  Parts parts = roadway(d);
  const int girders = draws.whole(2, 4), piers = draws.whole(1, 3);
  const double depth_m = d.length_m / (piers + 1) * draws.real(0.05, 0.08);
  const double under_m = d.z_m - 0.18 - 0.006 * d.length_m;
  for (int i = 0; i < girders; ++i) {
    const double y_m = d.width_m * 0.8 * ((i + 0.5) / girders - 0.5);
    parts += block({-d.half_m() + 0.3, d.half_m() - 0.35, y_m - 0.05 * d.width_m,
                    y_m + 0.05 * d.width_m, under_m - depth_m, under_m + 0.04},
                   kPaintedSteel);
  }
  const bool is_wall = draws.chance(0.4);
  for (int i = 1; i <= piers; ++i) {
    const double x_m = d.length_m * (static_cast<double>(i) / (piers + 1) - 0.5);
    const double head_m = under_m - depth_m + 0.03, thick_m = 0.02 * d.length_m + 0.25;
    parts += pad({x_m, 0.6 * thick_m, 0.0, 0.9 * d.side_m(), head_m - thick_m, head_m}, kConcrete);
    if (is_wall) {
      parts +=
          pad({x_m, 0.4 * thick_m, 0.0, 0.7 * d.side_m(), 0.0, head_m - 0.9 * thick_m}, kConcrete);
      continue;
    }
    for (const double side : {-0.6, 0.6})
      parts += drum({x_m, side * d.side_m(), 0.0}, 0.42 * thick_m, head_m - 0.9 * thick_m, 14,
                    kConcrete);
  }
  return parts;
}

/// The roadway within two Warren trusses, tied above.
Parts truss_bridge(Rng& draws, const Deck& d) {
  Parts parts = roadway(d);
  const int bays = 2 * draws.whole(3, 6);
  const double height_m = std::max(0.7 * d.width_m, d.length_m * draws.real(0.1, 0.16));
  const double y_m = d.side_m() + 0.2 + 0.003 * d.length_m, bay_m = d.length_m / bays;
  const Bars bars = {.chord_m = 0.16 + 0.005 * d.length_m,
                     .brace_m = 0.1 + 0.003 * d.length_m,
                     .paint = kPaintedSteel};
  const bool is_bowed = draws.chance(0.5);
  std::vector<Vec3> top[2];
  for (const int side : {0, 1}) {
    std::vector<Vec3> bottom;
    for (int i = 1; i < bays; ++i) {
      const double x_m = -d.half_m() + i * bay_m, along = 2.0 * x_m / d.length_m;
      const double rise_m = height_m * (is_bowed ? 1.1 - 0.6 * along * along : 1.0);
      bottom.emplace_back(x_m, side == 0 ? -y_m : y_m, d.z_m - 0.25);
      top[side].emplace_back(x_m, side == 0 ? -y_m : y_m, d.z_m - 0.25 + rise_m);
    }
    parts += ladder(bottom, top[side], bars);
    for (const double end : {-1.0, 1.0}) {  // the slanting end posts, and the chord's last bay
      const Vec3 bearing(end * (d.half_m() - 0.1 * bay_m), bottom.front().y(), d.z_m - 0.27);
      const Vec3& head = end < 0.0 ? top[side].front() : top[side].back();
      parts += beam(bearing, head, 1.02 * bars.chord_m, 0.98 * bars.chord_m, bars.paint);
      parts += beam(bearing, end < 0.0 ? bottom.front() : bottom.back(), 0.95 * bars.chord_m,
                    0.9 * bars.chord_m, bars.paint);
    }
  }
  for (std::size_t i = 0; i < top[0].size(); ++i)
    parts += beam(top[0][i] + Vec3(0, 0, 0.02), top[1][i] + Vec3(0, 0, 0.02), bars.brace_m,
                  bars.brace_m, bars.paint);
  for (std::size_t i = 0; i + 1 < top[0].size(); ++i)
    parts += beam(top[i % 2][i], top[1 - i % 2][i + 1], 0.8 * bars.brace_m, 0.8 * bars.brace_m,
                  bars.paint);
  return parts;
}

/// The roadway hangs from two arches that its ends tie together.
Parts arch_bridge(Rng& draws, const Deck& d) {
  constexpr int kSteps = 14;
  Parts parts = roadway(d);
  const double rise_m = d.length_m * draws.real(0.16, 0.24), rib_m = 0.2 + 0.01 * d.length_m;
  const double y_m = d.side_m() + 0.6 * rib_m, tilt = draws.real(0.0, 0.2);
  const auto on_arch = [&](double along, double side) -> Vec3 {
    const double up_m = rise_m * (1.0 - along * along);
    return {along * (d.half_m() - 0.02 * d.length_m), side * (y_m - tilt * up_m),
            d.z_m - 0.2 + up_m};
  };
  for (const double side : {-1.0, 1.0}) {
    const auto at = [&](int i) { return on_arch(2.0 * i / kSteps - 1.0, side); };
    parts += bent_beam(stepped(kSteps, at), rib_m, 1.3 * rib_m, kWhite);
    for (int i = 2; i <= kSteps - 2; ++i) {
      const Vec3 head = at(i);
      parts += bent_pipe({{head.x(), side * (y_m - 0.3 * rib_m), d.z_m - 0.3}, head}, 0.05, 6,
                         kGalvanised);
    }
    parts += beam(on_arch(-0.99, side) - Vec3(0, 0, 0.1), on_arch(0.99, side) - Vec3(0, 0, 0.1),
                  0.8 * rib_m, rib_m, kWhite);
  }
  for (int i = 5; i <= kSteps - 5; ++i)
    parts += beam(on_arch(2.0 * i / kSteps - 1.0, -1.0), on_arch(2.0 * i / kSteps - 1.0, 1.0),
                  0.5 * rib_m, 0.5 * rib_m, kWhite);
  return parts;
}

/// One or two towers of two legs each, and fans of cables.
Parts cable_bridge(Rng& draws, const Deck& d) {
  Parts parts = roadway(d);
  const bool has_two = draws.chance(0.5);
  const double height_m = d.length_m * (has_two ? draws.real(0.18, 0.25) : draws.real(0.3, 0.42));
  const int stays = draws.whole(4, 7);
  const double leg_m = 0.25 + 0.018 * d.length_m, y_m = d.side_m() + 0.55 * leg_m;
  for (const double at :
       has_two ? std::vector{-0.28, 0.28} : std::vector{draws.real(-0.15, 0.15)}) {
    const double x_m = at * d.length_m, top_m = d.z_m + height_m;
    for (const double side : {-1.0, 1.0}) {
      parts +=
          post({x_m, side * 1.15 * y_m, 0.0}, {x_m, side * 0.8 * y_m, top_m}, leg_m, kConcrete);
      for (const double way : {-1.0, 1.0})
        for (int i = 1; i <= stays; ++i) {
          const double end_m = way > 0.0 ? d.half_m() : -d.half_m();
          const double room_m = has_two && at * way < 0.0 ? -x_m : end_m - x_m;
          const Vec3 foot(x_m + 0.94 * room_m * i / stays, side * (d.side_m() - 0.12), d.z_m - 0.1);
          const Vec3 head(x_m, side * 0.82 * y_m, top_m - 0.06 * height_m * (stays + 1 - i));
          parts += bent_pipe({foot, head}, 0.025 + 0.0006 * d.length_m, 6, kWhite);
        }
    }
    for (const double z_m : {d.z_m - 0.9 * leg_m, top_m - 0.3 * height_m})
      parts +=
          pad({x_m, 0.4 * leg_m, 0.0, 1.1 * y_m, z_m - 0.5 * leg_m, z_m + 0.4 * leg_m}, kConcrete);
  }
  return parts;
}

}  // namespace

Parts bridge(Rng& draws, double size_m) {
  return one_of(draws, draw_deck(draws, size_m),
                {girder_bridge, truss_bridge, arch_bridge, cable_bridge});
}

}  // namespace gnbv::random_parts
