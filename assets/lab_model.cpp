#include "assets/lab_model.hpp"

#include <array>
#include <cmath>

#include "assets/mesh_builder.hpp"
#include "assets/solids.hpp"

namespace gnbv {
namespace {

/// Indices into lab_model_materials().
enum Paint : std::uint16_t {
  kCarton,
  kCartonPrinted,
  kCartonWhite,
  kCartonInside,
  kCrate,
  kBoardPainted,
  kShelfWood,
  kArchBrick,
  kDrumSteel,
  kRollPaper,
  kBallFoam,
  kRodTape,
  kPaintCount
};

/// Patterns of 3 to 10 cm: tens of pixels at 1 to 3 m.
std::vector<Material> lab_model_materials() {
  using enum Pattern;
  std::vector<Material> list(kPaintCount);
  list[kCarton] = {"carton", {0.42F, 0.27F, 0.14F}, panels, {0.20F, 0.12F, 0.06F}, 0.093F};
  list[kCartonPrinted] = {
      "carton_printed", {0.50F, 0.34F, 0.19F}, checker, {0.10F, 0.22F, 0.36F}, 0.083F};
  list[kCartonWhite] = {
      "carton_white", {0.78F, 0.76F, 0.72F}, panels, {0.40F, 0.10F, 0.07F}, 0.061F};
  list[kCartonInside] = {
      "carton_inside", {0.24F, 0.15F, 0.08F}, noise, {0.40F, 0.26F, 0.14F}, 0.037F};
  list[kCrate] = {"crate", {0.12F, 0.30F, 0.16F}, panels, {0.55F, 0.60F, 0.30F}, 0.057F};
  list[kBoardPainted] = {
      "board_painted", {0.74F, 0.70F, 0.62F}, checker, {0.12F, 0.13F, 0.15F}, 0.053F};
  list[kShelfWood] = {"shelf_wood", {0.48F, 0.31F, 0.15F}, noise, {0.22F, 0.12F, 0.05F}, 0.041F};
  list[kArchBrick] = {"arch_brick", {0.46F, 0.15F, 0.09F}, bricks, {0.62F, 0.58F, 0.52F}, 0.103F};
  list[kDrumSteel] = {"drum_steel", {0.08F, 0.20F, 0.42F}, stripes, {0.66F, 0.66F, 0.62F}, 0.063F};
  list[kRollPaper] = {"roll_paper", {0.72F, 0.48F, 0.08F}, checker, {0.14F, 0.11F, 0.08F}, 0.047F};
  list[kBallFoam] = {"ball_foam", {0.66F, 0.14F, 0.10F}, checker, {0.76F, 0.72F, 0.66F}, 0.043F};
  list[kRodTape] = {"rod_tape", {0.75F, 0.62F, 0.06F}, stripes, {0.05F, 0.05F, 0.05F}, 0.039F};
  return list;
}

/// Height of all feet. Level faces keep millimetres away from the multiples of 4, 5 and 7 cm, the
/// usual voxels, where rounding would decide which layer they fall into.
constexpr double kFloor_m = 0.004;

Isometry frame(double x_m, double y_m, double z_m, double yaw_deg) {
  return T_world_body({Vec3(x_m, y_m, z_m), deg_to_rad(yaw_deg)});
}

Isometry turned(double angle_deg, const Vec3& axis) {
  return Isometry(Eigen::AngleAxisd(deg_to_rad(angle_deg), axis));
}

Isometry shifted(double x_m, double y_m, double z_m) {
  return Isometry(Eigen::Translation3d(x_m, y_m, z_m));
}

/// A gate with a round vault: `frame` at its foot, the way through along the frame's x.
Part arch(const Isometry& T_world_arch) {
  constexpr double kDepth_m = 0.291, kHalfWidth_m = 0.311, kInner_m = 0.203, kSpring_m = 0.257;
  constexpr int kSteps = 12;  // a multiple of 4 puts a ring on the outer corners
  const auto cut = [&](const Eigen::Vector2d& inner_m, const Eigen::Vector2d& outer_m) -> Ring {
    const auto at = [&](double side, const Eigen::Vector2d& p) -> Vec3 {
      return T_world_arch * Vec3(0.5 * side * kDepth_m, p.x(), p.y());
    };
    return {at(1.0, inner_m), at(1.0, outer_m), at(-1.0, outer_m), at(-1.0, inner_m)};
  };
  std::vector<Ring> rings = {cut({-kInner_m, 0.0}, {-kHalfWidth_m, 0.0})};
  for (int i = 0; i <= kSteps; ++i) {
    const double angle_rad = kPi * (1.0 - static_cast<double>(i) / kSteps);
    const Eigen::Vector2d out(std::cos(angle_rad), std::sin(angle_rad)), spring(0.0, kSpring_m);
    rings.push_back(
        cut(spring + kInner_m * out, spring + kHalfWidth_m * out / out.lpNorm<Eigen::Infinity>()));
  }
  rings.push_back(cut({kInner_m, 0.0}, {kHalfWidth_m, 0.0}));
  return loft(rings, {}, {}, uniform(kArchBrick));
}

Part ball(const Vec3& centre_m, double radius_m) {
  constexpr int kSteps = 10;
  std::vector<RevolvedPoint> profile;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle_rad = kPi * i / kSteps;
    const bool pole = i == 0 || i == kSteps;
    profile.push_back(
        {-radius_m * std::cos(angle_rad), pole ? 0.0 : radius_m * std::sin(angle_rad)});
  }
  return translated(revolve(profile, 2 * kSteps, uniform(kBallFoam)), centre_m);
}

/// The stack: a carton lying on its side (its mouth is the niche), one that hangs over its back,
/// an open one with its flaps up and a roll of paper in it.
void add_tower(TriangleMesh& mesh) {
  const Isometry T_world_niche =
      frame(-0.083, 0.0, kFloor_m, 4.0) * shifted(0.0, 0.369, 0.2045) * turned(90.0, Vec3::UnitX());
  append(mesh, open_box(T_world_niche, {0.84, 0.409, 0.62}, 0.052, 0.41, kCarton, kCartonInside));
  append(mesh, box(frame(-0.203, 0.185, 0.388, -14.0), {0.58, 0.50, 0.344}, kCartonPrinted));

  const Vec3 size_m(0.36, 0.41, 0.312);
  const Isometry T_world_top = frame(-0.166, 0.093, 0.717, 31.0);
  append(mesh, open_box(T_world_top, size_m, 0.017, 0.23, kCartonWhite, kCartonInside));
  struct Flap {
    double turn_deg, reach_m, width_m, length_m, tilt_deg;
  };
  for (const Flap& flap : {Flap{0.0, 0.5 * size_m.x(), 0.39, 0.17, 38.0},
                           Flap{90.0, 0.5 * size_m.y(), 0.34, 0.15, -21.0},
                           Flap{180.0, 0.5 * size_m.x(), 0.38, 0.17, 64.0}}) {
    const Isometry T_world_flap = T_world_top * turned(flap.turn_deg, Vec3::UnitZ()) *
                                  shifted(flap.reach_m - 0.008, 0.0, size_m.z() - 0.012) *
                                  turned(90.0 - flap.tilt_deg, Vec3::UnitY());
    append(mesh, box(T_world_flap, {0.009, flap.width_m, flap.length_m}, kCartonInside));
  }
  append(mesh, open_rod({{{-0.137, 0.061, 0.776}, 0.082},
                         {{-0.181, 0.104, 1.131}, 0.082},
                         {{-0.225, 0.147, 1.4848}, 0.082}},
                        24, 0.013, 0.27, kRollPaper, kCartonInside));
}

}  // namespace

TriangleMesh make_lab_model() {
  TriangleMesh mesh;
  mesh.materials = lab_model_materials();
  add_tower(mesh);
  append(mesh, box(frame(-0.367, -0.137, 0.391, 24.0), {0.19, 0.15, 0.207}, kCrate));
  // the shelf reaches out over the gate, a ball at its end, and the board leans against it
  append(mesh, box(frame(0.115, 0.028, 0.721, -22.0) * turned(1.5, Vec3::UnitX()),
                   {0.77, 0.24, 0.028}, kShelfWood));
  append(mesh, ball({0.376, -0.071, 0.829}, 0.093));
  append(mesh, box(frame(0.185, -0.462, 0.016, 3.0) * turned(-26.0, Vec3::UnitX()),
                   {0.27, 0.031, 1.06}, kBoardPainted));
  append(mesh, arch(frame(0.4705, 0.033, kFloor_m, 6.0)));
  append(mesh, rod({{{0.525, 0.227, 0.556}, 0.014}, {{0.02, 0.186, 0.951}, 0.014}}, 10, kRodTape));
  append(mesh, open_rod({{{-0.548, -0.398, kFloor_m}, 0.1}, {{-0.548, -0.398, 0.523}, 0.1}}, 24,
                        0.009, 0.183, kDrumSteel, kCartonInside));
  return mesh;
}

}  // namespace gnbv
