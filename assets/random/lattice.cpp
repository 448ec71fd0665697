#include "assets/random/lattice.hpp"

#include "assets/random/solids.hpp"

namespace gnbv::random_parts {
namespace {

void fill_panel(std::vector<Part>& parts, const std::array<Vec3, 4>& corners_m, std::size_t bay,
                const Bars& bars) {
  const auto& [a0, b0, a1, b1] = corners_m;
  const bool is_crossed = bars.bracing == Bracing::crosses;
  // the two of a cross pass each other, as angles bolted back to back do
  if (is_crossed || bay % 2 == 0)
    parts.push_back(beam(a0, b1, bars.brace_m, bars.brace_m, bars.paint));
  if (is_crossed || bay % 2 == 1)
    parts.push_back(beam(b0, a1, 0.96 * bars.brace_m, 0.93 * bars.brace_m, bars.paint));
}

}  // namespace

std::vector<Part> lattice(const std::vector<Ring>& sections, const Bars& bars) {
  std::vector<Part> parts;
  const std::size_t corners = sections.front().size();
  for (std::size_t k = 0; k < corners; ++k) {
    std::vector<Vec3> chord_m;
    for (const Ring& section : sections) chord_m.push_back(section[k]);
    parts.push_back(bent_beam(chord_m, bars.chord_m, bars.chord_m, bars.paint));
  }
  for (std::size_t i = 0; i < sections.size(); ++i)
    for (std::size_t k = 0; k < corners; ++k) {
      const std::size_t next = (k + 1) % corners;
      const Ring& here = sections[i];
      parts.push_back(beam(here[k], here[next], bars.brace_m, bars.brace_m, bars.paint));
      if (i + 1 == sections.size()) continue;
      const Ring& beyond = sections[i + 1];
      fill_panel(parts, {here[k], here[next], beyond[k], beyond[next]}, i, bars);
    }
  return parts;
}

std::vector<Part> ladder(const std::vector<Vec3>& chord_a, const std::vector<Vec3>& chord_b,
                         const Bars& bars) {
  std::vector<Part> parts = {bent_beam(chord_a, bars.chord_m, bars.chord_m, bars.paint),
                             bent_beam(chord_b, bars.chord_m, bars.chord_m, bars.paint)};
  for (std::size_t i = 0; i < chord_a.size(); ++i) {
    if ((chord_a[i] - chord_b[i]).norm() > 2.0 * bars.chord_m)
      parts.push_back(beam(chord_a[i], chord_b[i], bars.brace_m, bars.brace_m, bars.paint));
    if (i + 1 < chord_a.size())
      fill_panel(parts, {chord_a[i], chord_b[i], chord_a[i + 1], chord_b[i + 1]}, i, bars);
  }
  return parts;
}

Ring square(double x_m, double y_m, double z_m, double width_m) {
  const double h_m = 0.5 * width_m;
  return {{x_m - h_m, y_m - h_m, z_m},
          {x_m + h_m, y_m - h_m, z_m},
          {x_m + h_m, y_m + h_m, z_m},
          {x_m - h_m, y_m + h_m, z_m}};
}

Ring upright_rectangle(double x_m, double width_m, double z0_m, double z1_m) {
  const double h_m = 0.5 * width_m;
  return {{x_m, -h_m, z0_m}, {x_m, h_m, z0_m}, {x_m, h_m, z1_m}, {x_m, -h_m, z1_m}};
}

Part drum(const Vec3& foot_m, double radius_m, double height_m, std::size_t sides, Paint paint) {
  return upright(revolve({{0.0, 0.0}, {0.0, radius_m}, {height_m, radius_m}, {height_m, 0.0}},
                         sides, uniform(paint)),
                 foot_m);
}

}  // namespace gnbv::random_parts
