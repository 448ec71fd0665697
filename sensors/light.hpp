// What lights the scene: a sun, a blue sky, and the ground's reflection of both. Linear colours,
// scaled so that a white sheet that faces the sun comes out just below 1.
#pragma once

#include <array>
#include <cstdint>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// Unit vector from anywhere to the sun: from the south-west, 50 degrees high.
Vec3f towards_sun_world();

/// Colour of the sky in a direction: pale at the horizon, blue overhead; below the horizon, where a
/// world has no ground, the colour of far haze.
Vec3f sky_colour(const Vec3f& direction_world);

/// Light that a surface sends back: Lambert's law for the sun, where it is not in shadow, and an
/// ambient light that depends on how much of sky and ground the surface faces.
Vec3f lit_colour(const Vec3f& albedo, const Vec3f& normal_world, bool is_sunlit);

/// The ground's own look.
Material ground_material();

/// From linear to sRGB (IEC 61966-2-1), by a table: up to half a level off the exact curve.
class SrgbTable {
 public:
  SrgbTable();
  std::array<std::uint8_t, 3> operator()(const Vec3f& linear) const;

 private:
  static constexpr int kSteps = 4096;
  std::array<std::uint8_t, kSteps + 1> levels_{};
};

}  // namespace gnbv
