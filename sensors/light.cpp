#include "sensors/light.hpp"

#include <algorithm>
#include <cmath>

#include "sim/core/image.hpp"

namespace gnbv {
namespace {

const Vec3f kSun(0.70F, 0.66F, 0.58F);         // irradiance over pi, facing the sun
const Vec3f kSkyAmbient(0.22F, 0.25F, 0.30F);  // facing up
const Vec3f kGroundAmbient(0.10F, 0.09F, 0.08F);
const Vec3f kZenith(0.14F, 0.30F, 0.68F);
const Vec3f kHorizon(0.62F, 0.72F, 0.82F);
const Vec3f kHaze(0.30F, 0.29F, 0.27F);

}  // namespace

Vec3f towards_sun_world() {
  const auto elevation_rad = static_cast<float>(deg_to_rad(50.0));
  const auto azimuth_rad = static_cast<float>(deg_to_rad(-125.0));
  return {std::cos(elevation_rad) * std::cos(azimuth_rad),
          std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

Vec3f sky_colour(const Vec3f& direction_world) {
  const float height = direction_world.normalized().z();
  if (height < 0.0F) return kHaze;
  return kHorizon + std::sqrt(height) * (kZenith - kHorizon);
}

Vec3f lit_colour(const Vec3f& albedo, const Vec3f& normal_world, bool is_sunlit) {
  const float upwards = 0.5F + 0.5F * normal_world.z();
  Vec3f light = kGroundAmbient + upwards * (kSkyAmbient - kGroundAmbient);
  if (is_sunlit) light += std::max(0.0F, normal_world.dot(towards_sun_world())) * kSun;
  return albedo.cwiseProduct(light);
}

Material ground_material() {
  Material ground;
  ground.name = "ground";
  ground.pattern = Pattern::noise;
  ground.rgb = {0.34F, 0.32F, 0.29F};
  ground.rgb_2 = {0.17F, 0.17F, 0.14F};
  ground.pattern_size_m = 0.8F;
  return ground;
}

SrgbTable::SrgbTable() {
  for (int i = 0; i <= kSteps; ++i) {
    const float linear = static_cast<float>(i) / kSteps;
    levels_[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(std::lround(255.0F * linear_to_srgb(linear)));
  }
}

std::array<std::uint8_t, 3> SrgbTable::operator()(const Vec3f& linear) const {
  const auto level = [&](float channel) {
    const long step = std::lround(std::clamp(channel, 0.0F, 1.0F) * kSteps);
    return levels_[static_cast<std::size_t>(step)];
  };
  return {level(linear.x()), level(linear.y()), level(linear.z())};
}

}  // namespace gnbv
