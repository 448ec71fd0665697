#include "assets/smoke.hpp"

#include <cmath>

#include "assets/mesh_builder.hpp"

namespace gnbv {
namespace {

enum Paint : std::uint16_t { kPlaster, kRoof, kAnnex };

Ring circle(double x_m, double y_m, double z_m, double radius_m) {
  constexpr int kSides = 24;
  Ring ring;
  for (int i = 0; i < kSides; ++i) {
    const double angle_rad = 2.0 * kPi * i / kSides;
    ring.emplace_back(x_m + radius_m * std::cos(angle_rad), y_m + radius_m * std::sin(angle_rad),
                      z_m);
  }
  return ring;
}

/// Rectangle whose side at x1 may stand higher than the one at x0.
Ring rectangle(double x0_m, double x1_m, double y0_m, double y1_m, double z0_m, double z1_m) {
  return {{x0_m, y0_m, z0_m}, {x1_m, y0_m, z1_m}, {x1_m, y1_m, z1_m}, {x0_m, y1_m, z0_m}};
}

}  // namespace

TriangleMesh make_smoke_structure() {
  TriangleMesh mesh;
  mesh.materials = {
      {"plaster", {0.80F, 0.77F, 0.70F}, Pattern::bricks, {0.48F, 0.44F, 0.38F}, 0.13F},
      {"roof", {0.55F, 0.20F, 0.14F}, Pattern::stripes, {0.33F, 0.11F, 0.08F}, 0.047F},
      {"annex", {0.45F, 0.52F, 0.58F}, Pattern::panels, {0.17F, 0.20F, 0.24F}, 0.17F}};
  // off the multiples of 5 cm, where rounding would decide which voxel a wall belongs to
  const std::vector<Ring> tower = {circle(-0.42, 0.12, 0.012, 0.46),
                                   circle(-0.42, 0.12, 0.61, 0.44), circle(-0.42, 0.12, 1.13, 0.44),
                                   circle(-0.42, 0.12, 1.17, 0.52)};
  append(mesh, loft(tower, {Vec3(-0.42, 0.12, 0.012)}, {Vec3(-0.42, 0.12, 1.62)},
                    [](std::size_t ring, std::size_t) { return ring >= 2 ? kRoof : kPlaster; }));
  const std::vector<Ring> annex = {rectangle(-0.31, 1.03, -0.63, 0.47, 0.012, 0.012),
                                   rectangle(-0.31, 1.03, -0.63, 0.47, 0.87, 0.56)};
  append(mesh,
         loft(annex, {Vec3(0.36, -0.08, 0.012)}, {Vec3(0.36, -0.08, 0.715)}, uniform(kAnnex)));
  return mesh;
}

}  // namespace gnbv
