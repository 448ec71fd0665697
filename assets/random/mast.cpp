// Masts of lattice: standing free with aerials, held by guys, or carrying power lines.
#include <algorithm>
#include <cmath>

#include "assets/random/parts.hpp"

namespace gnbv::random_parts {
namespace {

/// Sections from foot to head whose bays grow with the width of the mast.
std::vector<Ring> mast_sections(int legs, double height_m, double foot_m, double head_m,
                                double bay_per_width) {
  std::vector<Ring> sections;
  double z_m = 0.0;
  while (true) {
    const double radius_m = foot_m + (head_m - foot_m) * z_m / height_m;
    sections.push_back(polygon(legs, radius_m, z_m));
    if (z_m >= height_m) return sections;
    const double bay_m = std::max(0.6, bay_per_width * 1.5 * radius_m);
    z_m = z_m + 1.5 * bay_m > height_m ? height_m : z_m + bay_m;
  }
}

/// Dishes, panels and poles between `from_m` and `to_m` above the ground, at `radius_m`.
Parts aerials(Rng& draws, double from_m, double to_m, double radius_m) {
  Parts parts;
  const int count = draws.whole(3, 8);
  for (int i = 0; i < count; ++i) {
    const double turn_rad = draws.real(0.0, 2.0 * kPi), z_m = draws.real(from_m, to_m);
    const Isometry T_world_arm =
        T_world_body({{0.0, 0.0, z_m}, turn_rad}) * Eigen::Translation3d(radius_m, 0.0, 0.0);
    if (draws.chance(0.5)) {
      const double dish_m = draws.real(0.3, 0.9);
      Part dish = lying_along_x(
          revolve({{0.0, 0.0}, {0.0, 0.5 * dish_m}, {0.25 * dish_m, dish_m}, {0.45 * dish_m, 0.0}},
                  14, uniform(kWhite)),
          {0.1, 0.0, 0.0});
      for (Vec3& p : dish.points_m) p = T_world_arm * p;
      parts += std::move(dish);
    } else {
      parts += box(T_world_arm * Eigen::Translation3d(0.25, 0.0, -0.6), {0.14, 0.3, 1.6}, kWhite);
    }
    parts += beam(T_world_arm * Vec3(-radius_m, 0.0, 0.02), T_world_arm * Vec3(0.25, 0, 0.02), 0.08,
                  0.08, kGalvanised);
  }
  return parts;
}

Parts free_mast(Rng& draws, double height_m) {
  const int legs = draws.whole(3, 4);
  const double foot_m = height_m / draws.real(10.0, 15.0), head_m = foot_m * draws.real(0.15, 0.3);
  const double lattice_m = height_m * draws.real(0.86, 0.94);
  const Bars bars = {.chord_m = 0.10 + 0.0035 * height_m,
                     .brace_m = 0.06 + 0.0012 * height_m,
                     .bracing = draws.chance(0.5) ? Bracing::crosses : Bracing::zigzag,
                     .paint = draws.chance(0.4) ? kMastStripes : kGalvanised};
  Parts parts = lattice(mast_sections(legs, lattice_m, foot_m, head_m, draws.real(0.8, 1.3)), bars);
  for (const Vec3& foot : polygon(legs, foot_m, 0.0))
    parts += pad({foot.x(), 0.5, foot.y(), 0.5, 0.0, 0.4}, kConcrete);
  const double deck_m = lattice_m * draws.real(0.7, 0.97), reach_m = head_m + draws.real(0.7, 1.4);
  parts += drum({0.0, 0.0, deck_m}, reach_m, 0.12, 8, kGalvanised);
  parts += bent_pipe({{0, 0, lattice_m - 0.3}, {0, 0, height_m}}, 0.09, 8, kMastStripes);
  parts += aerials(draws, 0.6 * lattice_m, lattice_m, head_m + 0.3);
  parts += block({-0.3 * foot_m, 0.3 * foot_m + 1.2, -0.9, 0.8, 0.0, 2.1}, kPlaster);
  return parts;
}

Parts guyed_mast(Rng& draws, double height_m) {
  const double radius_m = std::max(0.28, height_m / draws.real(70.0, 100.0));
  const Bars bars = {.chord_m = 0.09, .brace_m = 0.05, .paint = kMastStripes};
  Parts parts = lattice(mast_sections(3, height_m, radius_m, radius_m, 1.6), bars);
  parts += drum({0.0, 0.0, 0.0}, 2.2 * radius_m, 0.35, 12, kConcrete);
  const double anchor_m = height_m * draws.real(0.3, 0.42);
  const int levels = height_m > 25.0 ? 3 : 2;
  for (const Vec3& anchor : polygon(3, anchor_m, 0.0)) {
    parts += pad({anchor.x(), 0.6, anchor.y(), 0.6, 0.0, 0.5}, kConcrete);
    for (int i = 1; i <= levels; ++i) {
      const double z_m = height_m * (i / (levels + 0.4));
      const Vec3 head = Vec3(0, 0, z_m) + anchor * (radius_m / anchor_m);
      parts +=
          bent_pipe({anchor * (1.0 + 0.006 * i) + Vec3(0, 0, 0.45), head}, 0.03, 5, kGalvanised);
    }
  }
  parts += aerials(draws, 0.5 * height_m, 0.97 * height_m, radius_m + 0.2);
  return parts;
}

/// A suspension tower: waist below the arms, arms of two or three phases a side.
Parts pylon(Rng& draws, double height_m) {
  const double foot_m = height_m * draws.real(0.1, 0.14), waist_m = foot_m * draws.real(0.25, 0.4);
  const double waist_z_m = height_m * draws.real(0.55, 0.68);
  const Bars bars = {.chord_m = 0.10 + 0.003 * height_m,
                     .brace_m = 0.06 + 0.001 * height_m,
                     .bracing = Bracing::crosses,
                     .paint = draws.chance(0.5) ? kPaintedSteel : kGalvanised};
  std::vector<Ring> sections = mast_sections(4, waist_z_m, foot_m, waist_m, 1.0);
  const int upper = draws.whole(4, 6);
  for (int i = 1; i <= upper; ++i) {
    const double share = static_cast<double>(i) / upper;
    sections.push_back(
        polygon(4, waist_m * (1.0 - 0.75 * share), waist_z_m + (height_m - waist_z_m) * share));
  }
  Parts parts = lattice(sections, bars);
  for (const Vec3& foot : polygon(4, foot_m, 0.0)) parts += drum(foot, 0.55, 0.35, 10, kConcrete);
  const int arms = draws.whole(2, 3);
  const double longest_m = height_m * draws.real(0.16, 0.24);
  for (int i = 0; i < arms; ++i) {
    const double z_m = waist_z_m + (height_m - waist_z_m) * (i + 0.35) / arms;
    const double reach_m = longest_m * (i == 1 ? 1.0 : 0.8), root_m = 0.5 * waist_m;
    for (const double side : {-1.0, 1.0}) {
      const Vec3 tip(0.0, side * reach_m, z_m);
      for (const double x_m : {-root_m, root_m}) {
        parts += beam({x_m, side * 0.3 * root_m, z_m}, tip, 0.11, 0.11, bars.paint);
        parts += beam({x_m, side * 0.3 * root_m, z_m + 0.3 * reach_m}, tip, 0.09, 0.09, bars.paint);
      }
      parts += bent_pipe({tip, tip - Vec3(0.0, 0.0, 0.045 * height_m)}, 0.11, 8, kBronze);
    }
  }
  return parts;
}

}  // namespace

Parts mast(Rng& draws, double size_m) {
  return one_of(draws, size_m, {free_mast, guyed_mast, pylon});
}

}  // namespace gnbv::random_parts
