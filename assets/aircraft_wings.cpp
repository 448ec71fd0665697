// Wing with winglet and flap-track fairings, tailplane, fin.
#include <array>
#include <cmath>
#include <numbers>

#include "assets/aircraft_parts.hpp"
#include "assets/section_curves.hpp"

namespace gnbv::aircraft {
namespace {

/// Planform row of a wing-like part; straight lines between rows.
struct WingRow {
  double x_m, leading_y_m, trailing_y_m, z_m, half_thickness_m, camber_m;
  double cant_deg;       // 0: section upright; 90: chord plane vertical, as of a fin
  double incidence_deg;  // leading edge up
};

AerofoilSection section(const WingRow& row) {
  const double cant_rad = row.cant_deg * std::numbers::pi / 180.0;
  const Vec3 up(-std::sin(cant_rad), 0.0, std::cos(cant_rad));
  const double raise_m = 0.5 * (row.trailing_y_m - row.leading_y_m) *
                         std::tan(row.incidence_deg * std::numbers::pi / 180.0);
  return {Vec3(row.x_m, row.leading_y_m, row.z_m) + raise_m * up,
          Vec3(row.x_m, row.trailing_y_m, row.z_m) - raise_m * up, up, row.half_thickness_m,
          row.camber_m};
}

struct Span {
  WingRow row;
  std::size_t steps;  // rings from the row before
};

template <std::size_t n>
std::vector<Ring> wing_rings(const std::array<Span, n>& spans, std::size_t points) {
  std::vector<Ring> rings = {aerofoil_ring(section(spans.front().row), points)};
  for (std::size_t i = 1; i < n; ++i)
    add_span(rings, section(spans[i - 1].row), section(spans[i].row), spans[i].steps, points);
  return rings;
}

/// Chord fraction of the middle of the quad at `side` of a ring of 2 n points.
double side_fraction(std::size_t side, std::size_t n) {
  const std::size_t k = side < n ? side : 2 * n - 1 - side;
  return 0.5 * (chord_fraction(k, n) + chord_fraction(k + 1, n));
}

constexpr std::size_t kWingPoints = 14;
constexpr std::array<Span, 11> kWing = {{
    {{0.62, -4.56, 1.63, 1.645, 0.41, 0.06, 0.0, 2.6}, 0},  // inside the fuselage
    {{1.42, -4.02, 1.66, 1.74, 0.375, 0.06, 0.0, 2.4}, 3},
    {{4.86, -1.77, 1.94, 2.11, 0.235, 0.045, 0.0, 1.2}, 8},  // the kink
    {{9.60, 1.33, 3.82, 2.63, 0.145, 0.030, 0.0, 0.2}, 11},
    {{14.12, 4.29, 5.61, 3.14, 0.068, 0.015, 6.3, -1.0}, 11},
    {{14.33, 4.50, 5.71, 3.185, 0.058, 0.008, 22.0, 0.0}, 1},  // the winglet turns up
    {{14.49, 4.72, 5.79, 3.285, 0.050, 0.0, 45.0, 0.0}, 1},
    {{14.60, 4.92, 5.86, 3.43, 0.044, 0.0, 62.0, 0.0}, 1},
    {{14.66, 5.05, 5.91, 3.56, 0.040, 0.0, 66.0, 0.0}, 1},
    {{14.89, 5.55, 6.11, 4.06, 0.026, 0.0, 66.0, 0.0}, 4},
    {{14.918, 5.66, 6.115, 4.12, 0.011, 0.0, 66.0, 0.0}, 1},
}};

constexpr std::size_t kTailplanePoints = 11;
constexpr std::array<Span, 4> kTailplane = {{
    {{0.12, 12.75, 15.70, 3.255, 0.150, 0.0, 0.0, 0.0}, 0},
    {{0.86, 13.25, 15.94, 3.335, 0.133, 0.0, 0.0, 0.0}, 2},
    {{5.03, 16.09, 17.28, 3.785, 0.058, 0.0, 6.2, 0.0}, 9},
    {{5.21, 16.42, 17.325, 3.805, 0.020, 0.0, 6.2, 0.0}, 1},
}};

constexpr std::size_t kFinPoints = 13;
constexpr std::array<UprightRow, 8> kFin = {{{3.42, 9.55, 15.70, 0.155, 0},
                                             {3.93, 10.95, 15.93, 0.150, 1},
                                             {4.16, 11.78, 16.03, 0.146, 1},
                                             {4.45, 12.40, 16.16, 0.141, 1},
                                             {4.85, 12.92, 16.335, 0.135, 1},
                                             {7.83, 15.84, 17.61, 0.062, 10},
                                             {8.02, 16.09, 17.675, 0.046, 1},
                                             {8.09, 16.36, 17.69, 0.016, 1}}};

/// A canoe of elliptic sections about the line from nose to tail; half sizes are of the fullest
/// one.
Part canoe(const Vec3& nose_m, const Vec3& tail_m, double half_width_m, double half_height_m) {
  constexpr std::size_t kSides = 8;
  const MonotoneCurve girth(
      {{0.0, 0.0}, {0.06, 0.42}, {0.2, 0.78}, {0.42, 1.0}, {0.65, 0.86}, {0.85, 0.48}, {1.0, 0.0}});
  std::vector<Ring> rings;
  for (const double t : {0.04, 0.13, 0.26, 0.42, 0.57, 0.72, 0.85, 0.95}) {
    const Vec3 centre_m = nose_m + t * (tail_m - nose_m);
    Ring ring;
    for (std::size_t k = 0; k < kSides; ++k) {
      const double turn = 2.0 * std::numbers::pi * static_cast<double>(k) / double{kSides};
      ring.push_back(centre_m + girth(t) * Vec3(half_width_m * std::sin(turn), 0.0,
                                                -half_height_m * std::cos(turn)));
    }
    rings.push_back(ring);
  }
  return loft(rings, {nose_m}, {tail_m}, uniform(kFairingGrey));
}

/// The wing's straight lines at x, between its rows.
WingRow wing_at(double x_m) {
  std::size_t i = 1;
  while (kWing[i].row.x_m < x_m) ++i;
  const WingRow &a = kWing[i - 1].row, &b = kWing[i].row;
  const double t = (x_m - a.x_m) / (b.x_m - a.x_m);
  WingRow row = b;
  row.x_m = x_m;
  row.leading_y_m = a.leading_y_m + t * (b.leading_y_m - a.leading_y_m);
  row.trailing_y_m = a.trailing_y_m + t * (b.trailing_y_m - a.trailing_y_m);
  row.z_m = a.z_m + t * (b.z_m - a.z_m);
  return row;
}

}  // namespace

std::vector<Ring> upright_rings(std::span<const UprightRow> rows, std::size_t points) {
  const auto cut = [](const UprightRow& row) {
    return AerofoilSection{{0.0, row.front_y_m, row.z_m},
                           {0.0, row.back_y_m, row.z_m},
                           Vec3::UnitX(),
                           row.half_thickness_m,
                           0.0};
  };
  std::vector<Ring> rings = {aerofoil_ring(cut(rows.front()), points)};
  for (std::size_t i = 1; i < rows.size(); ++i)
    add_span(rings, cut(rows[i - 1]), cut(rows[i]), rows[i].steps, points);
  return rings;
}

Part wing() {
  const std::vector<Ring> rings = wing_rings(kWing, kWingPoints);
  const auto paint = [&](std::size_t ring, std::size_t side) -> std::uint16_t {
    const double x_m = rings[ring].front().x();
    const double s = side_fraction(side, kWingPoints);
    if (x_m > 14.3) return kLiveryBlue;                               // winglet
    if (x_m > 1.4 && s < 0.04) return kBareMetal;                     // slats
    if (s > 0.74 && x_m > 1.4 && x_m < 13.3) return kControlSurface;  // flaps, ailerons
    return kWingGrey;
  };
  return loft(rings, {}, {}, paint);
}

std::vector<Part> flap_track_fairings() {
  struct Row {
    double x_m, length_m, half_width_m, half_height_m;
  };
  constexpr std::array<Row, 5> kRows = {{{3.05, 1.75, 0.12, 0.19},
                                         {5.55, 1.95, 0.13, 0.20},
                                         {7.35, 1.85, 0.12, 0.18},
                                         {8.55, 1.70, 0.11, 0.165},
                                         {10.95, 1.35, 0.085, 0.12}}};
  std::vector<Part> parts;
  for (const Row& row : kRows) {
    const WingRow at = wing_at(row.x_m);
    const double tail_y_m = at.trailing_y_m + 0.30 * row.length_m;
    parts.push_back(canoe({row.x_m, tail_y_m - row.length_m, at.z_m - 0.10},
                          {row.x_m, tail_y_m, at.z_m - 0.04 - 1.35 * row.half_height_m},
                          row.half_width_m, row.half_height_m));
  }
  return parts;
}

Part tailplane() {
  const std::vector<Ring> rings = wing_rings(kTailplane, kTailplanePoints);
  const auto paint = [&](std::size_t ring, std::size_t side) -> std::uint16_t {
    const double s = side_fraction(side, kTailplanePoints), x_m = rings[ring].front().x();
    if (s < 0.04) return kBareMetal;
    return s > 0.68 && x_m > 0.8 && x_m < 4.7 ? kControlSurface : kWingGrey;
  };
  return loft(rings, {}, {}, paint);
}

Part fin() {
  std::vector<Ring> rings = upright_rings(kFin, kFinPoints);
  for (Ring& ring : rings)
    ring = mirror_ring(std::vector<Vec3>(ring.begin(), ring.begin() + kFinPoints + 1));

  const auto paint = [&](std::size_t ring, std::size_t side) -> std::uint16_t {
    const double s = side_fraction(side, kFinPoints), z_m = rings[ring].front().z();
    return s > 0.7 && z_m > 4.1 && z_m < 7.8 ? kLiveryLight : kLiveryBlue;  // rudder
  };
  return loft(rings, {}, {}, paint);
}

}  // namespace gnbv::aircraft
