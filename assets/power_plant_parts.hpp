// The parts of the power plant. World axes: x east, y north, z up, at quarter scale.
//
//   north   cooling tower | boiler house, stair tower | conveyor, coal
//           alley         | alley                     | precipitator, chimneys
//   south   transformers  | turbine hall, control     | pipe rack, drums, tank farm
//
// Walls, roofs and decks keep off the multiples of 5 cm, where rounding would decide which voxel
// they belong to.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/mesh_builder.hpp"

namespace gnbv::power_plant {

/// Indices into materials().
enum Paint : std::uint16_t {
  kConcrete,
  kTowerConcrete,
  kBrickRed,
  kBrickBuff,
  kCladdingBlue,
  kCladdingLight,
  kRoofing,
  kGlass,
  kLouvre,
  kStackStripes,
  kSoot,
  kGalvanised,
  kRustyPipe,
  kInsulatedPipe,
  kGasYellow,
  kTankWhite,
  kTankGreen,
  kTransformerGreen,
  kCeramic,
  kDoorBlue,
  kCoal,
  kPaintCount
};
std::vector<Material> materials();

std::vector<Part> turbine_hall();
std::vector<Part> control_building();
std::vector<Part> boiler_house();
std::vector<Part> stair_tower();
std::vector<Part> flue_gas_path();  // precipitator, auxiliary boiler and their ducts
std::vector<Part> cooling_tower();
std::vector<Part> chimneys();
std::vector<Part> tank_farm();
std::vector<Part> drums();
std::vector<Part> pipe_rack();
std::vector<Part> transformer_yard();
std::vector<Part> coal_handling();

}  // namespace gnbv::power_plant
