#include "tools/render/vehicle_item.hpp"

#include <algorithm>

namespace gnbv {
namespace {

constexpr int kDiscSides = 28;
const Rgb kFrame = srgb(0x23282f);
const Rgb kRear = srgb(0x4a5360);

SurfaceItem disc(const Isometry& T_world_disc, double radius_m, const Rgb& colour) {
  SurfaceItem item;
  item.mesh.vertices_m.push_back(T_world_disc.translation().cast<float>());
  for (std::uint32_t i = 0; i < kDiscSides; ++i) {
    const double angle = 2.0 * kPi * i / kDiscSides;
    item.mesh.vertices_m.push_back(
        (T_world_disc * Vec3(radius_m * std::cos(angle), radius_m * std::sin(angle), 0.0))
            .cast<float>());
    item.mesh.faces.push_back({0, 1 + i, 1 + (i + 1) % kDiscSides});
  }
  item.vertex_colours.assign(item.mesh.vertices_m.size(), colour);
  return item;
}

}  // namespace

const Rgb kFrontRotors = srgb(0xe8731a);

double rotor_span_m(const AirframeParameters& airframe) {
  double span_m = 0.0;
  for (const RotorMount& a : airframe.rotors) {
    for (const RotorMount& b : airframe.rotors) {
      span_m = std::max(span_m, (a.p_body_m - b.p_body_m).norm());
    }
  }
  return span_m;
}

void add_vehicle(const AirframeParameters& airframe, const Isometry& T_world_body, double scale,
                 RenderScene& scene) {
  const double span_m = scale * rotor_span_m(airframe);
  const auto tube_m = static_cast<float>(0.03 * span_m);
  const Vec3f centre = T_world_body.translation().cast<float>();
  scene.balls.push_back({centre, static_cast<float>(0.14 * span_m), kFrame, true});
  for (const RotorMount& rotor : airframe.rotors) {
    const Vec3 hub = scale * rotor.p_body_m;
    const Rgb& colour = rotor.p_body_m.x() > 0.0 ? kFrontRotors : kRear;
    scene.tubes.push_back({{centre, (T_world_body * hub).cast<float>()}, {kFrame}, tube_m, true});
    Isometry T_world_disc = T_world_body;
    T_world_disc.translation() = T_world_body * (hub + Vec3(0.0, 0.0, 0.06 * span_m));
    scene.surfaces.push_back(disc(T_world_disc, 0.21 * span_m, colour));
  }
}

}  // namespace gnbv
