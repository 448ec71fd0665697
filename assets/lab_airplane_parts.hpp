// The parts of the laboratory's airplane, drawn along y: x to port, y aft, z up, as the airliner.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/mesh_builder.hpp"

namespace gnbv::lab_airplane {

/// Indices into materials().
enum Paint : std::uint16_t {
  kSkinWhite,
  kSkinRed,
  kCheatLine,
  kAntiGlare,
  kWingSkin,
  kLeadingEdge,
  kControlSurface,
  kTailStripes,
  kGlass,
  kCanopyFrame,
  kSpinner,
  kBlade,
  kExhaust,
  kDuct,
  kStrut,
  kTyre,
  kWheelPant,
  kTank,
  kPaintCount
};
std::vector<Material> materials();

constexpr double kPropellerAxis_m = 0.531;  // height

/// A ring across the y axis that is its own mirror image: a superellipse about (0, y, z), lowest
/// point first; exponent 2 is an ellipse, larger ones are boxier.
struct Oval {
  double y_m, z_m, half_width_m, half_height_m, exponent = 2.0;
};
Ring oval_ring(const Oval& oval, std::size_t half_sides);

/// Body of revolution about the line through (0, 0, z) along y, its own mirror image.
Part spindle(const std::vector<RevolvedPoint>& profile, double z_m, std::size_t half_sides,
             Paint paint);

// On the plane x = 0, each its own mirror image.
std::vector<Part> body();         // fuselage, scoop, canopy, spinner
std::vector<Part> centre_fins();  // fin, rudder, strakes above and below, antennas

// On the side x > 0; the other side is the mirror image.
std::vector<Part> wings();  // wing, flap, aileron, tailplane, elevator
std::vector<Part> propeller_blades();
std::vector<Part> landing_gear();  // the main leg and half of the nose wheels
std::vector<Part> fittings();      // exhaust, tank on its pylon, pitot tube, braces, lights

}  // namespace gnbv::lab_airplane
