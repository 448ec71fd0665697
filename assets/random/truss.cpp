// Bare frames: a space frame on columns, a row of portals, a gantry with signs.
#include <algorithm>
#include <cmath>

#include "assets/random/parts.hpp"

namespace gnbv::random_parts {
namespace {

/// Two layers of bars, the lower half a field aside, joined by pyramids: a stadium's roof.
struct SpaceFrame {
  int fields_x, fields_y;
  double field_m, depth_m, z_m;  // of the upper layer
  Vec3 upper(int i, int k) const {
    return {(i - 0.5 * fields_x) * field_m, (k - 0.5 * fields_y) * field_m, z_m};
  }
  Vec3 lower(int i, int k) const {
    return upper(i, k) + Vec3(0.5 * field_m, 0.5 * field_m, -depth_m);
  }
};

Parts bars_of(const SpaceFrame& f, double bar_m) {
  Parts parts;
  const int x = f.fields_x, y = f.fields_y;
  // of three sizes: where equal bars cross, their ends would share edges
  const auto bar = [&](const Vec3& from_m, const Vec3& to_m, double share = 0.5) {
    parts += bent_pipe({from_m, to_m}, share * bar_m, 6, kWhite);
  };
  for (int i = 0; i <= x; ++i) bar(f.upper(i, 0), f.upper(i, y));
  for (int k = 0; k <= y; ++k) bar(f.upper(0, k), f.upper(x, k), 0.48);
  for (int i = 0; i < x; ++i) bar(f.lower(i, 0), f.lower(i, y - 1));
  for (int k = 0; k < y; ++k) bar(f.lower(0, k), f.lower(x - 1, k), 0.48);
  for (int i = 0; i < x; ++i)
    for (int k = 0; k < y; ++k)
      for (const int a : {0, 1})
        for (const int b : {0, 1}) bar(f.lower(i, k), f.upper(i + a, k + b), 0.4);
  return parts;
}

Parts space_frame(Rng& draws, double size_m) {
  const int fields = draws.whole(5, 9);
  SpaceFrame f{.fields_x = fields,
               .fields_y = std::max(3, static_cast<int>(fields * draws.real(0.4, 0.8))),
               .field_m = size_m / fields,
               .depth_m = 0.0,
               .z_m = size_m * draws.real(0.2, 0.4)};
  f.depth_m = f.field_m * draws.real(0.55, 0.8);
  const double bar_m = 0.06 + 0.004 * size_m;
  Parts parts = bars_of(f, bar_m);
  const int inset = f.fields_y > 4 ? 1 : 0;
  for (const int i : {inset, f.fields_x - 1 - inset})
    for (const int k : {inset, f.fields_y - 1 - inset}) {
      const Vec3 head = f.lower(i, k);
      const Vec3 foot(head.x(), head.y(), 0.0);
      parts += drum(foot, 1.6 * bar_m, head.z(), 12, kPaintedSteel);
      parts += drum(foot, 4.0 * bar_m, 0.3, 12, kConcrete);
    }
  if (draws.chance(0.5)) {  // partly covered
    const Vec3 from = f.upper(0, 0), to = f.upper(draws.whole(2, f.fields_x - 1), f.fields_y);
    parts += block({from.x() - 0.2, to.x() + 0.2, from.y() - 0.2, to.y() + 0.2, f.z_m + 0.4 * bar_m,
                    f.z_m + 0.4 * bar_m + 0.08},
                   kRoofing);
  }
  return parts;
}

/// A hall that is a skeleton only: columns, roof trusses, purlins, some cladding.
Parts portals(Rng& draws, double size_m) {
  const int frames = draws.whole(3, 7), bays = 2 * draws.whole(3, 5);
  const double span_m = size_m * draws.real(0.35, 0.6), eaves_m = span_m * draws.real(0.35, 0.6);
  const double rise_m = span_m * draws.real(0.12, 0.25), depth_m = span_m * draws.real(0.05, 0.08);
  const Bars bars = {.chord_m = 0.12 + 0.002 * size_m,
                     .brace_m = 0.07 + 0.001 * size_m,
                     .paint = draws.chance(0.5) ? kPaintedSteel : kGalvanised};
  Parts parts;
  for (int i = 0; i < frames; ++i) {
    const double x_m = size_m * (static_cast<double>(i) / (frames - 1) - 0.5);
    std::vector<Vec3> upper, lower;
    for (int k = 0; k <= bays; ++k) {
      const double across = 2.0 * k / bays - 1.0, roof_m = rise_m * (1.0 - std::abs(across));
      upper.emplace_back(x_m, 0.5 * span_m * across, eaves_m + depth_m + roof_m);
      lower.emplace_back(x_m, 0.5 * span_m * across, eaves_m + 0.5 * roof_m);
    }
    parts += ladder(lower, upper, bars);
    for (const double side : {-1.0, 1.0}) {
      const Vec3 foot(x_m, 0.5 * side * span_m, 0.0);
      parts +=
          post(foot, foot + Vec3(0, 0, eaves_m + 1.2 * depth_m), 2.2 * bars.chord_m, bars.paint);
      parts += pad({x_m, 0.5, foot.y(), 0.45, 0.0, 0.2}, kConcrete);
    }
  }
  const double purlin_m = 0.5 * size_m + 0.4;
  for (int k = 0; k <= bays; ++k) {
    const double across = 2.0 * k / bays - 1.0;
    const double z_m = eaves_m + depth_m + rise_m * (1.0 - std::abs(across)) + 0.5 * bars.chord_m;
    parts += beam({-purlin_m, 0.5 * span_m * across, z_m}, {purlin_m, 0.5 * span_m * across, z_m},
                  0.1, 0.16, kWood);
  }
  if (draws.chance(0.6)) {  // one wall is clad, up to a height
    const double y_m = 0.5 * span_m + 1.1 * bars.chord_m;
    parts += block({-0.5 * size_m, size_m * draws.real(-0.1, 0.5), y_m, y_m + 0.1, 0.5,
                    eaves_m * draws.real(0.5, 1.0)},
                   kCladding);
  }
  return parts;
}

/// A box girder over a road on two legs, with signs.
Parts gantry(Rng& draws, double size_m) {
  const double clear_m = std::max(2.4, size_m * draws.real(0.22, 0.4));
  const double side_m = std::max(0.6, size_m * draws.real(0.06, 0.09));
  const int bays = std::max(5, static_cast<int>(size_m / (1.2 * side_m)));
  const auto sections = stepped(bays, [&](int i) -> Ring {  // upright, across x
    const double x_m = size_m * (static_cast<double>(i) / bays - 0.5);
    const double y_m = 0.5 * side_m, top_m = clear_m + 1.15 * side_m;
    return {{x_m, -y_m, clear_m}, {x_m, y_m, clear_m}, {x_m, y_m, top_m}, {x_m, -y_m, top_m}};
  });
  const Bars bars = {.chord_m = 0.1 + 0.002 * size_m, .brace_m = 0.06, .paint = kGalvanised};
  Parts parts = lattice(sections, bars);
  for (const double side : {-1.0, 1.0}) {
    const double x_m = side * (0.5 * size_m - 0.6 * side_m);
    const int levels = std::max(3, static_cast<int>(clear_m / side_m));
    const auto leg = stepped(levels, [&](int i) {
      return square(x_m, 0.0, 0.05 + (clear_m + side_m) * i / levels, 0.86 * side_m);
    });
    parts += lattice(leg, bars);
    parts += pad({x_m, 0.9 * side_m, 0.0, side_m, 0.0, 0.45}, kConcrete);
  }
  const int signs = draws.whole(2, 4);
  for (int i = 0; i < signs; ++i) {
    const double x_m = size_m * 0.8 * ((i + 0.5) / signs - 0.5), half_m = 0.28 * size_m / signs;
    const double low_m = clear_m + side_m * draws.real(-0.5, 0.1);
    const double y_m = (i % 2 == 0 ? -0.5 : 0.5) * (side_m + 2.2 * bars.chord_m);
    parts += pad({x_m, half_m, y_m, 0.05, low_m, low_m + side_m * draws.real(1.3, 2.2)},
                 i % 2 == 0 ? kContainerBlue : kPaintedSteel);
  }
  return parts;
}

}  // namespace

Parts truss(Rng& draws, double size_m) {
  return one_of(draws, size_m, {space_frame, portals, gantry});
}

}  // namespace gnbv::random_parts
