// What sits on the fuselage's skin: windows, doors, antennas. Thin closed bodies sunk into it.
#include <array>
#include <cmath>
#include <numbers>

#include "assets/aircraft_body.hpp"

namespace gnbv::aircraft {
namespace {

constexpr double kProud_m = 0.006;  // above the skin: more than the skin's facets sag (3 mm)
constexpr double kSunk_m = 0.03;    // below the skin

/// A place on the skin.
struct SkinPoint {
  double y_m, angle_deg;
};

Vec3 above_skin_m(const SkinPoint& at, double height_m) {
  const double angle_rad = at.angle_deg * std::numbers::pi / 180.0;
  return body_point_m(at.y_m, angle_rad) + height_m * body_normal(at.y_m, angle_rad);
}

/// A slab that follows the skin between four corners (in order around it), u x v quads.
Part pane(const std::array<SkinPoint, 4>& corners, std::size_t u, std::size_t v, Paint paint) {
  const auto at = [&](std::size_t i, std::size_t j) -> SkinPoint {
    const double s = static_cast<double>(i) / static_cast<double>(u);
    const double t = static_cast<double>(j) / static_cast<double>(v);
    const std::array<double, 4> weight = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
    SkinPoint point{0.0, 0.0};
    for (std::size_t k = 0; k < 4; ++k) {
      point.y_m += weight[k] * corners[k].y_m;
      point.angle_deg += weight[k] * corners[k].angle_deg;
    }
    return point;
  };
  std::vector<Ring> rings;
  for (std::size_t j = 0; j <= v; ++j) {
    Ring ring;
    for (std::size_t i = 0; i <= u; ++i) ring.push_back(above_skin_m(at(i, j), kProud_m));
    for (std::size_t i = u + 1; i > 0; --i) ring.push_back(above_skin_m(at(i - 1, j), -kSunk_m));
    rings.push_back(ring);
  }
  return loft(rings, {}, {}, uniform(paint));
}

struct Door {
  double y_m, width_m, sill_deg, lintel_deg;
};
// Four cabin doors and the emergency exit behind the wing.
constexpr std::array<Door, 5> kDoors = {{{-14.05, 0.53, -12.0, 27.5},
                                         {-8.02, 0.53, -12.0, 27.5},
                                         {3.31, 0.36, -4.0, 26.5},
                                         {5.66, 0.53, -12.0, 27.5},
                                         {8.02, 0.53, -12.0, 27.5}}};

constexpr std::array<Door, 2> kCargoDoors = {
    {{-10.63, 1.30, -47.0, -14.5}, {6.87, 1.25, -47.0, -14.5}}};

constexpr double kWindowPitch_m = 0.2667;  // 21 in, at half scale
constexpr double kWindowsFrom_m = -13.33, kWindowsTo_m = 7.5;
constexpr double kWindowAngle_deg = 16.0;

Part cabin_window(double y_m, double proud_m) {
  constexpr double kHalfWidth_m = 0.068, kHalfHeight_deg = 4.1;
  constexpr std::size_t kSides = 8;
  Ring ring;
  for (std::size_t k = 0; k < kSides; ++k) {
    const double turn = (static_cast<double>(k) + 0.5) * 2.0 * std::numbers::pi / double{kSides};
    ring.push_back(above_skin_m(
        {y_m + kHalfWidth_m * std::cos(turn), kWindowAngle_deg + kHalfHeight_deg * std::sin(turn)},
        proud_m));
  }
  return loft({ring}, {}, {above_skin_m({y_m, kWindowAngle_deg}, -2.0 * kSunk_m)}, uniform(kGlass));
}

Part door_pane(const Door& door) {
  const double from_m = door.y_m - 0.5 * door.width_m, to_m = door.y_m + 0.5 * door.width_m;
  return pane({{{from_m, door.sill_deg},
                {to_m, door.sill_deg},
                {to_m, door.lintel_deg},
                {from_m, door.lintel_deg}}},
              2, 6, kDoorGrey);
}

/// A blade standing on the skin on x = 0, `height_m` up (negative: down).
Part antenna(double y_m, double chord_m, double height_m) {
  const double skin_m = body_point_m(y_m, std::copysign(0.5 * std::numbers::pi, height_m)).z();
  std::vector<Ring> rings;
  for (const auto& [up, sweep, chord] :
       {std::array{-0.3, -0.15, 1.1}, std::array{0.5, 0.25, 0.75}, std::array{1.0, 0.6, 0.45}}) {
    const double y0_m = y_m + sweep * chord_m, c_m = chord * chord_m, z_m = skin_m + up * height_m;
    const double half_thickness_m = 0.09 * c_m;
    rings.push_back(mirror_ring({{0.0, y0_m, z_m},
                                 {half_thickness_m, y0_m + 0.35 * c_m, z_m},
                                 {0.6 * half_thickness_m, y0_m + 0.7 * c_m, z_m},
                                 {0.0, y0_m + c_m, z_m}}));
  }
  return loft(rings, {}, {}, uniform(kDoorGrey));
}

}  // namespace

std::vector<Part> cabin_windows() {
  std::vector<Part> parts;
  for (int i = 0; kWindowsFrom_m + i * kWindowPitch_m < kWindowsTo_m; ++i) {
    const double y_m = kWindowsFrom_m + i * kWindowPitch_m;
    bool free = true;
    for (const Door& door : kDoors)
      free = free && std::abs(y_m - door.y_m) > 0.5 * door.width_m + 0.09;
    if (free) parts.push_back(cabin_window(y_m, kProud_m));
  }
  return parts;
}

std::vector<Part> cockpit_windows() {
  return {pane({{{-16.80, 87.0}, {-16.36, 87.5}, {-16.22, 57.0}, {-16.66, 46.0}}}, 4, 5, kGlass),
          pane({{{-16.63, 43.5}, {-16.19, 54.5}, {-15.93, 44.5}, {-16.25, 28.0}}}, 4, 4, kGlass),
          pane({{{-16.20, 27.5}, {-15.89, 42.5}, {-15.62, 38.5}, {-15.72, 28.5}}}, 3, 2, kGlass)};
}

std::vector<Part> doors() {
  std::vector<Part> parts;
  for (const Door& door : kDoors) {
    parts.push_back(door_pane(door));
    parts.push_back(cabin_window(door.y_m, 2.0 * kProud_m));  // the door's own window
  }
  for (const Door& door : kCargoDoors) parts.push_back(door_pane(door));
  return parts;
}

std::vector<Part> antennas() {
  return {antenna(-13.2, 0.24, 0.21), antenna(-9.6, 0.20, 0.16),  antenna(4.3, 0.24, 0.21),
          antenna(-9.9, 0.24, -0.23), antenna(-7.3, 0.18, -0.15), antenna(6.1, 0.20, -0.17)};
}

}  // namespace gnbv::aircraft
