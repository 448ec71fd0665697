// The parts of the airliner. World axes: x to port, y aft, z up, at half scale.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "assets/mesh_builder.hpp"

namespace gnbv::aircraft {

/// Indices into materials().
enum Paint : std::uint16_t {
  kFuselageWhite,
  kBellyGrey,
  kLiveryBlue,
  kLiveryLight,
  kCheatLine,
  kWingGrey,
  kControlSurface,
  kNacelleBlue,
  kBareMetal,
  kFanDark,
  kFanBlade,
  kExhaust,
  kGlass,
  kDoorGrey,
  kFairingGrey,
  kPaintCount
};
std::vector<Material> materials();

/// A horizontal cut of a part that stands upright on the plane x = 0.
struct UprightRow {
  double z_m, front_y_m, back_y_m, half_thickness_m;
  std::size_t steps;  // rings up to it from the row below
};
/// Its rings of 2 `points` points.
std::vector<Ring> upright_rings(std::span<const UprightRow> rows, std::size_t points);

// On the plane x = 0, each its own mirror image.
Part fuselage();
Part belly_fairing();
Part fin();
std::vector<Part> antennas();

// On the side x > 0; the other side is the mirror image.
Part wing();
Part tailplane();
std::vector<Part> flap_track_fairings();
std::vector<Part> engines();  // cowls, cores, fan blades and pylons of the inner and outer one
std::vector<Part> cabin_windows();
std::vector<Part> cockpit_windows();
std::vector<Part> doors();

}  // namespace gnbv::aircraft
