// What random structures are made of.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv::random_parts {

/// Indices into materials().
enum Paint : std::uint16_t {
  kConcrete,
  kAsphalt,
  kBrick,
  kPlaster,
  kCladding,
  kRoofing,
  kTiles,
  kGlass,
  kDoor,
  kGalvanised,
  kPaintedSteel,
  kMastStripes,
  kWood,
  kAntifouling,
  kTopside,
  kWhite,
  kContainerRed,
  kContainerBlue,
  kMachineYellow,
  kBronze,
  kPaintCount
};
std::vector<Material> materials();

/// Leaves out the materials that no face has.
void keep_used_materials(TriangleMesh& mesh);

}  // namespace gnbv::random_parts
