#include "assets/power_plant.hpp"

#include "assets/power_plant_parts.hpp"

namespace gnbv {
namespace power_plant {

std::vector<Material> power_plant_materials() {
  using enum Pattern;
  std::vector<Material> list(kPaintCount);
  list[kConcrete] = {"concrete", {0.34F, 0.33F, 0.30F}, noise, {0.23F, 0.22F, 0.20F}, 0.45F};
  list[kTowerConcrete] = {
      "tower_concrete", {0.47F, 0.455F, 0.42F}, noise, {0.33F, 0.325F, 0.305F}, 0.85F};
  list[kBrickRed] = {"brick_red", {0.24F, 0.072F, 0.042F}, bricks, {0.33F, 0.30F, 0.26F}, 0.31F};
  list[kBrickBuff] = {"brick_buff", {0.42F, 0.29F, 0.155F}, bricks, {0.36F, 0.34F, 0.30F}, 0.27F};
  list[kCladdingBlue] = {
      "cladding_blue", {0.185F, 0.275F, 0.345F}, panels, {0.085F, 0.125F, 0.16F}, 0.63F};
  list[kCladdingLight] = {
      "cladding_light", {0.57F, 0.565F, 0.53F}, panels, {0.29F, 0.29F, 0.28F}, 0.52F};
  list[kRoofing] = {"roofing", {0.115F, 0.118F, 0.122F}, noise, {0.075F, 0.076F, 0.078F}, 0.5F};
  list[kGlass] = {"glass", {0.028F, 0.045F, 0.055F}, panels, {0.38F, 0.39F, 0.38F}, 0.29F};
  list[kLouvre] = {"louvre", {0.15F, 0.16F, 0.17F}, stripes, {0.042F, 0.045F, 0.048F}, 0.07F};
  list[kStackStripes] = {
      "stack_stripes", {0.47F, 0.034F, 0.026F}, stripes, {0.70F, 0.69F, 0.66F}, 0.94F};
  list[kSoot] = {"soot", {0.035F, 0.033F, 0.031F}, noise, {0.060F, 0.057F, 0.053F}, 0.4F};
  list[kGalvanised] = {"galvanised", {0.43F, 0.445F, 0.455F}, noise, {0.31F, 0.32F, 0.33F}, 0.16F};
  list[kRustyPipe] = {
      "rusty_pipe", {0.215F, 0.072F, 0.028F}, noise, {0.085F, 0.036F, 0.020F}, 0.18F};
  list[kInsulatedPipe] = {
      "insulated_pipe", {0.56F, 0.565F, 0.57F}, panels, {0.26F, 0.265F, 0.27F}, 0.41F};
  list[kGasYellow] = {"gas_yellow", {0.60F, 0.34F, 0.018F}, noise, {0.47F, 0.25F, 0.016F}, 0.24F};
  list[kTankWhite] = {"tank_white", {0.66F, 0.655F, 0.62F}, panels, {0.40F, 0.385F, 0.35F}, 0.74F};
  list[kTankGreen] = {"tank_green", {0.105F, 0.205F, 0.15F}, noise, {0.15F, 0.26F, 0.19F}, 0.35F};
  list[kTransformerGreen] = {
      "transformer_green", {0.15F, 0.185F, 0.165F}, noise, {0.105F, 0.135F, 0.12F}, 0.22F};
  list[kCeramic] = {"ceramic", {0.175F, 0.055F, 0.030F}, stripes, {0.28F, 0.12F, 0.075F}, 0.048F};
  list[kDoorBlue] = {"door_blue", {0.045F, 0.13F, 0.28F}, stripes, {0.036F, 0.105F, 0.23F}, 0.13F};
  list[kCoal] = {"coal", {0.026F, 0.025F, 0.026F}, noise, {0.062F, 0.059F, 0.056F}, 0.22F};
  return list;
}

}  // namespace power_plant

TriangleMesh make_power_plant() {
  using namespace power_plant;
  TriangleMesh mesh;
  mesh.materials = power_plant_materials();
  for (const auto& parts : {turbine_hall(), control_building(), boiler_house(), stair_tower(),
                            flue_gas_path(), cooling_tower(), chimneys(), tank_farm(), drums(),
                            pipe_rack(), transformer_yard(), coal_handling()})
    for (const Part& part : parts) append(mesh, part);
  return mesh;
}

}  // namespace gnbv
