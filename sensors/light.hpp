// The light of the scene: a sun, a blue sky, and what the ground reflects of both. Colours are
// linear; a white sheet that faces the sun comes out just below 1.
#pragma once

#include <array>
#include <cstdint>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// Unit vector to the sun, in the south-west, 50 degrees high.
Vec3f towards_sun_world();

/// Colour of the sky in a direction: pale at the horizon, blue overhead; haze below the horizon,
/// where a world has no ground.
Vec3f sky_colour(const Vec3f& direction_world);

/// Light that a surface sends back: of the sun by Lambert's law, where it is not in shadow, and of
/// sky and ground by how much of them the surface faces.
Vec3f lit_colour(const Vec3f& albedo, const Vec3f& normal_world, bool is_sunlit);

/// The material of the ground plane.
Material ground_material();

/// linear_to_srgb() by a table: up to half a level off.
class SrgbTable {
 public:
  SrgbTable();
  std::array<std::uint8_t, 3> operator()(const Vec3f& linear) const;

 private:
  static constexpr int kSteps = 4096;
  std::array<std::uint8_t, kSteps + 1> levels_{};
};

}  // namespace gnbv
