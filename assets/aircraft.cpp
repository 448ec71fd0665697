#include "assets/aircraft.hpp"

#include "assets/aircraft_parts.hpp"

namespace gnbv {
namespace aircraft {

std::vector<Material> materials() {
  using enum Pattern;
  // Sheets and joints as a camera sees them from 5 to 20 m: joints darker by a fifth on paint, so
  // that the livery stays what the eye sees first.
  std::vector<Material> list(kPaintCount);
  list[kFuselageWhite] = {
      "fuselage_white", {0.86F, 0.87F, 0.88F}, panels, {0.62F, 0.63F, 0.65F}, 1.27F};
  list[kBellyGrey] = {"belly_grey", {0.42F, 0.44F, 0.47F}, panels, {0.28F, 0.30F, 0.32F}, 0.93F};
  list[kLiveryBlue] = {
      "livery_blue", {0.016F, 0.070F, 0.235F}, panels, {0.045F, 0.140F, 0.380F}, 0.87F};
  list[kLiveryLight] = {
      "livery_light", {0.06F, 0.33F, 0.66F}, stripes, {0.62F, 0.74F, 0.86F}, 0.31F};
  list[kCheatLine] = {"cheat_line", {0.06F, 0.33F, 0.66F}, noise, {0.11F, 0.44F, 0.78F}, 0.45F};
  list[kWingGrey] = {"wing_grey", {0.50F, 0.52F, 0.55F}, panels, {0.33F, 0.35F, 0.38F}, 1.07F};
  list[kControlSurface] = {
      "control_surface", {0.36F, 0.38F, 0.41F}, panels, {0.22F, 0.24F, 0.26F}, 0.61F};
  list[kNacelleBlue] = {
      "nacelle_blue", {0.020F, 0.085F, 0.270F}, panels, {0.062F, 0.175F, 0.430F}, 0.67F};
  list[kBareMetal] = {"bare_metal", {0.62F, 0.62F, 0.63F}, noise, {0.40F, 0.40F, 0.42F}, 0.16F};
  list[kFanDark] = {"fan_dark", {0.012F, 0.012F, 0.014F}, noise, {0.040F, 0.040F, 0.044F}, 0.09F};
  list[kFanBlade] = {"fan_blade", {0.16F, 0.16F, 0.18F}, noise, {0.27F, 0.27F, 0.29F}, 0.07F};
  list[kExhaust] = {"exhaust", {0.085F, 0.080F, 0.078F}, noise, {0.190F, 0.150F, 0.120F}, 0.14F};
  list[kGlass] = {"glass", {0.012F, 0.018F, 0.028F}, noise, {0.055F, 0.075F, 0.100F}, 0.35F};
  list[kDoorGrey] = {"door_grey", {0.66F, 0.68F, 0.71F}, panels, {0.42F, 0.44F, 0.47F}, 0.43F};
  list[kFairingGrey] = {
      "fairing_grey", {0.55F, 0.57F, 0.60F}, panels, {0.38F, 0.40F, 0.43F}, 0.37F};
  return list;
}

}  // namespace aircraft

TriangleMesh make_aircraft() {
  TriangleMesh mesh;
  mesh.materials = aircraft::materials();

  append(mesh, aircraft::fuselage());
  append(mesh, aircraft::belly_fairing());
  append(mesh, aircraft::fin());
  for (const Part& part : aircraft::antennas()) append(mesh, part);

  append_both_sides(mesh, aircraft::wing());
  append_both_sides(mesh, aircraft::tailplane());
  for (const auto& parts :
       {aircraft::flap_track_fairings(), aircraft::engines(), aircraft::cabin_windows(),
        aircraft::cockpit_windows(), aircraft::doors()})
    for (const Part& part : parts) append_both_sides(mesh, part);
  return mesh;
}

}  // namespace gnbv
