#include "assets/aircraft.hpp"

#include "assets/aircraft_parts.hpp"

namespace gnbv {
namespace aircraft {

std::vector<Material> materials() {
  std::vector<Material> list(kPaintCount);
  list[kFuselageWhite] = {"fuselage_white", {0.86F, 0.87F, 0.88F}};
  list[kBellyGrey] = {"belly_grey", {0.42F, 0.44F, 0.47F}};
  list[kLiveryBlue] = {"livery_blue", {0.016F, 0.070F, 0.235F}};
  list[kLiveryLight] = {"livery_light", {0.06F, 0.33F, 0.66F}};
  list[kWingGrey] = {"wing_grey", {0.50F, 0.52F, 0.55F}};
  list[kControlSurface] = {"control_surface", {0.36F, 0.38F, 0.41F}};
  list[kNacelleBlue] = {"nacelle_blue", {0.020F, 0.085F, 0.270F}};
  list[kBareMetal] = {"bare_metal", {0.62F, 0.62F, 0.63F}};
  list[kFanDark] = {"fan_dark", {0.012F, 0.012F, 0.014F}};
  list[kFanBlade] = {"fan_blade", {0.16F, 0.16F, 0.18F}};
  list[kExhaust] = {"exhaust", {0.085F, 0.080F, 0.078F}};
  list[kGlass] = {"glass", {0.012F, 0.018F, 0.028F}};
  list[kDoorGrey] = {"door_grey", {0.66F, 0.68F, 0.71F}};
  list[kFairingGrey] = {"fairing_grey", {0.55F, 0.57F, 0.60F}};
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
