// A ship in dry dock: a lofted hull on keel blocks, superstructure, funnel, masts, cargo gear.
#include <algorithm>
#include <cmath>

#include "assets/random/parts.hpp"

namespace gnbv::random_parts {
namespace {

struct HullLines {
  double length_m, beam_m, depth_m, keel_m;  // keel_m: of the keel above the ground
  double fullness, sheer_m, rake_m;

  /// Half breadth at the deck; `along` from -1, the stern, to 1, the bow.
  double half_breadth_m(double along) const {
    const double entrance = std::pow(std::max(0.0, (along - 0.15) / 0.85), 2.0 + 2.0 * fullness);
    const double run = std::pow(std::max(0.0, (-along - 0.6) / 0.4), 2.0);
    return 0.5 * beam_m * std::max(0.025, 1.0 - entrance - 0.35 * run);
  }
  double deck_m(double along) const {
    return keel_m + depth_m + sheer_m * along * along * (along > 0.0 ? 1.0 : 0.35);
  }
  double x_m(double along) const { return 0.5 * length_m * along; }
};

HullLines draw_hull(Rng& draws, double size_m) {
  HullLines h{};
  h.length_m = 0.96 * size_m;
  h.beam_m = size_m * draws.real(0.16, 0.26);
  h.depth_m = h.beam_m * draws.real(0.5, 0.75);
  h.keel_m = std::max(0.7, 0.03 * size_m);
  h.fullness = draws.real(0.0, 1.0);
  h.sheer_m = h.depth_m * draws.real(0.1, 0.35);
  h.rake_m = size_m * draws.real(0.02, 0.06);
  return h;
}

/// From the keel up one side, over the deck and down the other.
Ring hull_section(const HullLines& h, double along) {
  constexpr int kSteps = 7;
  const double half_m = h.half_breadth_m(along), deck_m = h.deck_m(along);
  // flat floor amidships, V at the bow; the stern rises above its screw
  const double v = std::clamp((along - 0.1) / 0.9, 0.0, 1.0);
  const double roundness = 0.25 + 0.65 * v;
  const double rise_m = 0.55 * h.depth_m * std::pow(std::max(0.0, (-along - 0.55) / 0.45), 1.5);
  std::vector<Eigen::Vector2d> side;  // (y, z) from the keel to the deck's edge
  for (int i = 0; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    const double y_m = half_m * std::max(0.06, std::pow(share, roundness));
    side.emplace_back(y_m, h.keel_m + rise_m + (deck_m - h.keel_m - rise_m) * std::pow(share, 1.6));
  }
  Ring ring;
  const auto at = [&](const Eigen::Vector2d& p, double sign) -> Vec3 {
    const double height = (p.y() - h.keel_m) / h.depth_m;
    return {h.x_m(along) + h.rake_m * height * std::max(0.0, along), sign * p.x(), p.y()};
  };
  for (const Eigen::Vector2d& p : side) ring.push_back(at(p, 1.0));
  for (auto p = side.rbegin(); p != side.rend(); ++p) ring.push_back(at(*p, -1.0));
  return ring;
}

Part hull_body(const HullLines& h) {
  constexpr int kStations = 22;
  const auto rings =
      stepped(kStations, [&](int i) { return hull_section(h, 2.0 * i / kStations - 1.0); });
  return loft(rings, {}, {}, [](std::size_t, std::size_t side) -> std::uint16_t {
    if (side == 7) return kWood;  // between the deck's edges
    const std::size_t strake = std::min(side, 14 - side);
    return strake < 4 || side == 15 ? kAntifouling : kTopside;
  });
}

/// The blocks below the keel and shores against the sides.
Parts dock(const HullLines& h) {
  Parts parts;
  const int blocks = std::max(5, static_cast<int>(h.length_m / 2.5));
  const double w = 0.012 * h.length_m + 0.15;
  for (int i = 0; i < blocks; ++i) {
    const double x_m = h.length_m * (0.72 * (i + 0.5) / blocks - 0.29);
    parts += pad({x_m, w, 0.0, 2.0 * w, 0.0, h.keel_m + 0.08}, kWood);
  }
  for (int i = 0; i < 4; ++i)
    for (const double side : {-1.0, 1.0}) {
      const double along = -0.4 + 0.25 * i, y_m = h.half_breadth_m(along);
      parts +=
          beam({h.x_m(along), side * (y_m + 0.45 * h.depth_m), 0.05},
               {h.x_m(along), side * 0.97 * y_m, h.keel_m + 0.55 * h.depth_m}, 1.1 * w, w, kWood);
    }
  return parts;
}

Parts screw_and_rudder(const HullLines& h) {
  const double radius_m = 0.2 * h.depth_m, x_m = h.x_m(-0.9), z_m = h.keel_m + 0.26 * h.depth_m;
  Parts parts = {bent_pipe({{x_m - 0.12 * h.depth_m, 0, z_m}, {h.x_m(-0.6), 0, z_m}},
                           0.05 * h.depth_m, 8, kBronze),
                 block({h.x_m(-0.995), x_m - 0.16 * h.depth_m, -0.03 * h.depth_m, 0.03 * h.depth_m,
                        h.keel_m + 0.02, h.keel_m + 0.75 * h.depth_m},
                       kAntifouling)};
  for (int i = 0; i < 4; ++i) {
    Isometry T_world_blade = Isometry::Identity();
    T_world_blade.translate(Vec3(x_m - 0.04 * h.depth_m, 0.0, z_m));
    T_world_blade.rotate(Eigen::AngleAxisd(0.5 * kPi * i + 0.3, Vec3::UnitX()));
    T_world_blade.rotate(Eigen::AngleAxisd(0.5, Vec3::UnitZ()));
    parts += box(T_world_blade, {0.03 * h.depth_m, 0.5 * radius_m, radius_m}, kBronze);
  }
  return parts;
}

/// Decks stacked from `from` to `to` along the ship, a bridge on top, the funnel behind it.
Parts superstructure(Rng& draws, const HullLines& h, double from, double to) {
  Parts parts;
  const int decks = std::clamp(static_cast<int>(h.length_m / 9.0) + draws.whole(0, 1), 1, 5);
  const double deck_m = std::clamp(0.28 * h.depth_m, 0.9, 2.6);
  double x0_m = h.x_m(from), x1_m = h.x_m(to), z_m = h.deck_m(0.5 * (from + to)) - 0.25;
  double y_m = 0.86 * std::min(h.half_breadth_m(from), h.half_breadth_m(to));
  const double width_m = x1_m - x0_m;
  for (int i = 0; i < decks; ++i) {
    const double top_m = z_m + deck_m + (i == 0 ? 0.25 : 0.03);
    parts += block({x0_m, x1_m, -y_m, y_m, z_m, top_m}, kWhite);
    parts += block({x0_m + 0.08 * width_m, x1_m + 0.04, -y_m - 0.03, y_m + 0.03,
                    top_m - 0.55 * deck_m, top_m - 0.3 * deck_m},
                   kGlass);
    parts += block({x0_m - 0.15, x1_m + 0.12, -1.05 * y_m - 0.06, 1.05 * y_m + 0.06, top_m - 0.06,
                    top_m + 0.05},
                   kWhite);
    z_m = top_m + 0.02;
    x0_m += 0.06 * width_m;
    x1_m -= 0.05 * width_m;
    y_m *= i + 2 == decks ? 1.0 : 0.93;
  }
  const double r = 0.16 * h.beam_m, funnel_m = x0_m + 1.3 * r;
  parts += loft({square(funnel_m, 0, z_m - 0.1, 2.0 * r),
                 square(funnel_m - 0.4 * r, 0, z_m + 3.0 * r, 1.6 * r),
                 square(funnel_m - 0.4 * r, 0, z_m + 3.0 * r, 1.2 * r),
                 square(funnel_m - 0.3 * r, 0, z_m + 2.0 * r, 1.2 * r)},
                {}, {}, uniform(kMachineYellow));
  const double mast_m = x1_m - 0.25 * (x1_m - x0_m);
  parts += bent_pipe({{mast_m, 0, z_m - 0.1}, {mast_m, 0, z_m + 0.55 * h.beam_m}}, 0.09, 8, kWhite);
  parts += beam({mast_m, -0.22 * h.beam_m, z_m + 0.4 * h.beam_m},
                {mast_m, 0.22 * h.beam_m, z_m + 0.4 * h.beam_m}, 0.1, 0.14, kWhite);
  return parts;
}

/// Hatches, containers and derricks on the deck from `from` to `to`.
Parts cargo(Rng& draws, const HullLines& h, double from, double to) {
  Parts parts;
  const int holds = draws.whole(1, 3);
  const bool has_containers = draws.chance(0.5);
  for (int i = 0; i < holds; ++i) {
    const double a = from + (to - from) * (i + 0.12) / holds,
                 b = from + (to - from) * (i + 0.8) / holds;
    const double y_m = 0.62 * std::min(h.half_breadth_m(a), h.half_breadth_m(b));
    const double z_m = std::min(h.deck_m(a), h.deck_m(b)) - 0.4;
    parts += block({h.x_m(a), h.x_m(b), -y_m, y_m, z_m, z_m + 0.95}, kPaintedSteel);
    if (has_containers)
      for (int k = 0; k < 3; ++k) {
        const double c0_m = -y_m + 2.0 * y_m * k / 3.0 + 0.03;
        parts += block({h.x_m(a) + 0.1, h.x_m(b) - 0.1, c0_m, c0_m + 0.62 * y_m, z_m + 0.9,
                        z_m + 0.9 + 0.35 * h.depth_m * draws.whole(1, 3)},
                       k % 2 == 0 ? kContainerRed : kContainerBlue);
      }
    const double foot_m = h.x_m(b) + 0.05 * h.length_m / holds;
    const Vec3 head(foot_m, 0.0, z_m + 0.8 * h.beam_m);
    parts += bent_pipe({{foot_m, 0.0, z_m}, head}, 0.02 * h.beam_m + 0.05, 10, kMachineYellow);
    const double tip_z_m = z_m + h.beam_m * draws.real(0.7, 1.0);
    const Vec3 tip(h.x_m(a), draws.real(-0.6, 0.6) * y_m, tip_z_m);
    parts += beam({foot_m - 0.1, 0.0, z_m + 0.5 * h.beam_m}, tip, 0.14, 0.18, kMachineYellow);
    parts += bent_pipe({head - Vec3(0, 0, 0.1), tip}, 0.03, 5, kGalvanised);
  }
  return parts;
}

Parts bulwark_rails(const HullLines& h) {
  Parts parts;
  for (const double side : {-1.0, 1.0}) {
    const auto line = stepped(8, [&](int i) -> Vec3 {
      const double along = -0.95 + 1.7 * i / 8.0;
      return {h.x_m(along), side * 0.96 * h.half_breadth_m(along), h.deck_m(along) - 0.02};
    });
    parts += railing(line, std::min(1.0, 0.3 * h.depth_m), kWhite);
  }
  return parts;
}

}  // namespace

Parts hull(Rng& draws, double size_m) {
  const HullLines h = draw_hull(draws, size_m);
  Parts parts = {hull_body(h)};
  parts += dock(h);
  parts += screw_and_rudder(h);
  const bool is_aft = draws.chance(0.7);
  const double from = is_aft ? -0.85 : -0.25, to = from + draws.real(0.25, 0.4);
  parts += superstructure(draws, h, from, to);
  parts += cargo(draws, h, to + 0.05, 0.62);
  parts += bulwark_rails(h);
  return parts;
}

}  // namespace gnbv::random_parts
