#include "assets/random/paints.hpp"

#include <optional>

namespace gnbv::random_parts {

std::vector<Material> materials() {
  using enum Pattern;
  std::vector<Material> list(kPaintCount);
  list[kConcrete] = {"concrete", {0.36F, 0.35F, 0.32F}, noise, {0.24F, 0.23F, 0.21F}, 0.6F};
  list[kAsphalt] = {"asphalt", {0.07F, 0.07F, 0.075F}, noise, {0.12F, 0.12F, 0.12F}, 0.3F};
  list[kBrick] = {"brick", {0.28F, 0.09F, 0.05F}, bricks, {0.36F, 0.33F, 0.29F}, 0.28F};
  list[kPlaster] = {"plaster", {0.66F, 0.58F, 0.42F}, noise, {0.50F, 0.43F, 0.31F}, 0.7F};
  list[kCladding] = {"cladding", {0.22F, 0.33F, 0.41F}, panels, {0.10F, 0.15F, 0.19F}, 0.9F};
  list[kRoofing] = {"roofing", {0.14F, 0.145F, 0.15F}, panels, {0.08F, 0.08F, 0.085F}, 0.8F};
  list[kTiles] = {"tiles", {0.38F, 0.12F, 0.06F}, stripes, {0.24F, 0.07F, 0.035F}, 0.22F};
  list[kGlass] = {"glass", {0.03F, 0.05F, 0.065F}, panels, {0.40F, 0.41F, 0.40F}, 0.6F};
  list[kDoor] = {"door", {0.05F, 0.15F, 0.30F}, stripes, {0.035F, 0.10F, 0.21F}, 0.25F};
  list[kGalvanised] = {"galvanised", {0.45F, 0.46F, 0.47F}, noise, {0.31F, 0.32F, 0.33F}, 0.25F};
  list[kPaintedSteel] = {
      "painted_steel", {0.08F, 0.20F, 0.14F}, noise, {0.13F, 0.29F, 0.21F}, 0.35F};
  list[kMastStripes] = {
      "mast_stripes", {0.52F, 0.045F, 0.03F}, stripes, {0.72F, 0.71F, 0.68F}, 2.9F};
  list[kWood] = {"wood", {0.33F, 0.20F, 0.09F}, noise, {0.21F, 0.12F, 0.05F}, 0.2F};
  list[kAntifouling] = {
      "antifouling", {0.32F, 0.045F, 0.03F}, noise, {0.22F, 0.035F, 0.025F}, 0.6F};
  list[kTopside] = {"topside", {0.03F, 0.055F, 0.12F}, panels, {0.06F, 0.10F, 0.19F}, 1.3F};
  list[kWhite] = {"white", {0.72F, 0.71F, 0.68F}, panels, {0.48F, 0.47F, 0.44F}, 1.1F};
  list[kContainerRed] = {
      "container_red", {0.42F, 0.08F, 0.04F}, panels, {0.26F, 0.05F, 0.025F}, 0.3F};
  list[kContainerBlue] = {
      "container_blue", {0.05F, 0.14F, 0.36F}, panels, {0.03F, 0.08F, 0.22F}, 0.3F};
  list[kMachineYellow] = {
      "machine_yellow", {0.64F, 0.38F, 0.02F}, noise, {0.48F, 0.27F, 0.016F}, 0.3F};
  list[kBronze] = {"bronze", {0.40F, 0.24F, 0.08F}, noise, {0.28F, 0.16F, 0.05F}, 0.15F};
  return list;
}

void keep_used_materials(TriangleMesh& mesh) {
  std::vector<std::optional<std::uint16_t>> number(mesh.materials.size());
  std::vector<bool> is_used(mesh.materials.size(), false);
  for (const std::uint16_t m : mesh.face_material) is_used[m] = true;
  std::vector<Material> kept;
  for (std::size_t m = 0; m < mesh.materials.size(); ++m) {
    if (!is_used[m]) continue;
    number[m] = static_cast<std::uint16_t>(kept.size());
    kept.push_back(mesh.materials[m]);
  }
  for (std::uint16_t& m : mesh.face_material) m = *number[m];
  mesh.materials = std::move(kept);
}

}  // namespace gnbv::random_parts
