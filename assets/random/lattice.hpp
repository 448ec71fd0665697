// Bars in the shape of towers and girders, and other details that several kinds share.
#pragma once

#include <vector>

#include "assets/random/mesh_builder.hpp"
#include "assets/random/paints.hpp"

namespace gnbv::random_parts {

/// How the panels between two chords are filled.
enum class Bracing { zigzag, crosses };

struct Bars {
  double chord_m = 0.12, brace_m = 0.07;  // widths
  Bracing bracing = Bracing::zigzag;
  Paint paint = kGalvanised;
};

/// A chord through the k-th points of all sections for each k; rungs around every section, and
/// diagonals on every side between neighbouring sections. Sections are rings of one size.
std::vector<Part> lattice(const std::vector<Ring>& sections, const Bars& bars);

/// The same of two chords only, in a plane or on a curved surface.
std::vector<Part> ladder(const std::vector<Vec3>& chord_a, const std::vector<Vec3>& chord_b,
                         const Bars& bars);

/// A level square ring, side `width_m`, about (x, y).
Ring square(double x_m, double y_m, double z_m, double width_m);

/// A ring across x at `x_m`: `width_m` along y, from z0_m to z1_m.
Ring upright_rectangle(double x_m, double width_m, double z0_m, double z1_m);

/// A standing cylinder.
Part drum(const Vec3& foot_m, double radius_m, double height_m, std::size_t sides, Paint paint);

}  // namespace gnbv::random_parts
