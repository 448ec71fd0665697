#include "assets/lab_airplane.hpp"

#include "assets/lab_airplane_parts.hpp"

namespace gnbv {
namespace lab_airplane {

/// Patterns of 2 to 10 cm: tens of pixels at 1 to 3 m.
std::vector<Material> lab_airplane_materials() {
  using enum Pattern;
  std::vector<Material> list(kPaintCount);
  list[kSkinWhite] = {"skin_white", {0.82F, 0.82F, 0.80F}, panels, {0.34F, 0.35F, 0.37F}, 0.097F};
  list[kSkinRed] = {"skin_red", {0.48F, 0.035F, 0.030F}, panels, {0.80F, 0.40F, 0.32F}, 0.083F};
  list[kCheatLine] = {"cheat_line", {0.018F, 0.05F, 0.21F}, stripes, {0.78F, 0.66F, 0.22F}, 0.013F};
  list[kAntiGlare] = {"anti_glare", {0.035F, 0.038F, 0.042F}, noise, {0.12F, 0.12F, 0.13F}, 0.043F};
  list[kWingSkin] = {"wing_skin", {0.74F, 0.74F, 0.73F}, panels, {0.24F, 0.25F, 0.27F}, 0.103F};
  list[kLeadingEdge] = {
      "leading_edge", {0.50F, 0.040F, 0.032F}, noise, {0.26F, 0.020F, 0.018F}, 0.037F};
  list[kControlSurface] = {
      "control_surface", {0.62F, 0.45F, 0.06F}, panels, {0.16F, 0.12F, 0.03F}, 0.047F};
  list[kTailStripes] = {
      "tail_stripes", {0.018F, 0.05F, 0.21F}, stripes, {0.80F, 0.79F, 0.76F}, 0.043F};
  list[kGlass] = {"glass", {0.016F, 0.026F, 0.036F}, noise, {0.13F, 0.18F, 0.22F}, 0.067F};
  list[kCanopyFrame] = {
      "canopy_frame", {0.40F, 0.41F, 0.42F}, checker, {0.20F, 0.20F, 0.21F}, 0.017F};
  list[kSpinner] = {"spinner", {0.60F, 0.60F, 0.61F}, stripes, {0.48F, 0.035F, 0.030F}, 0.029F};
  list[kBlade] = {"blade", {0.030F, 0.030F, 0.034F}, stripes, {0.74F, 0.58F, 0.05F}, 0.041F};
  list[kExhaust] = {"exhaust", {0.28F, 0.20F, 0.14F}, noise, {0.10F, 0.08F, 0.07F}, 0.023F};
  list[kDuct] = {"duct", {0.016F, 0.016F, 0.018F}, noise, {0.060F, 0.058F, 0.056F}, 0.027F};
  list[kStrut] = {"strut", {0.55F, 0.56F, 0.58F}, stripes, {0.20F, 0.21F, 0.22F}, 0.019F};
  list[kTyre] = {"tyre", {0.020F, 0.020F, 0.020F}, noise, {0.075F, 0.075F, 0.075F}, 0.017F};
  list[kWheelPant] = {"wheel_pant", {0.80F, 0.80F, 0.78F}, stripes, {0.48F, 0.035F, 0.03F}, 0.021F};
  list[kTank] = {"tank", {0.70F, 0.70F, 0.68F}, checker, {0.018F, 0.05F, 0.21F}, 0.037F};
  return list;
}

namespace {

/// The nose from -y to +x: (x, y) becomes (-y, x), exactly; zeros stay +0.
Part quarter_turned(Part part) {
  for (Vec3& p : part.points_m) p = Vec3(0.0 - p.y(), p.x(), p.z());
  return part;
}

}  // namespace
}  // namespace lab_airplane

TriangleMesh make_lab_airplane() {
  using namespace lab_airplane;
  TriangleMesh mesh;
  mesh.materials = lab_airplane_materials();
  for (const auto& parts : {body(), centre_fins()})
    for (const Part& part : parts) append(mesh, quarter_turned(part));
  for (const auto& parts : {wings(), propeller_blades(), landing_gear(), fittings()}) {
    for (const Part& part : parts) {
      append(mesh, quarter_turned(part));
      append(mesh, quarter_turned(mirrored_x(part)));
    }
  }
  return mesh;
}

}  // namespace gnbv
