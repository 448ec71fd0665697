#include <gtest/gtest.h>

#include "sim/core/rng.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {
namespace {

constexpr std::array<Pattern, 6> kPatterns = {Pattern::plain,  Pattern::noise,   Pattern::panels,
                                              Pattern::bricks, Pattern::stripes, Pattern::checker};
const Vec3f kUp = Vec3f::UnitZ();
const Vec3f kEast = Vec3f::UnitX();

Material patterned(Pattern pattern, float size_m) {
  Material material;
  material.pattern = pattern;
  material.rgb = {0.9F, 0.5F, 0.1F};
  material.rgb_2 = {0.1F, 0.2F, 0.3F};
  material.pattern_size_m = size_m;
  return material;
}

/// Uniform in the cube [-extent, extent]^3.
Vec3f random_place(std::uint64_t index, double extent_m) {
  const auto coordinate = [&](std::uint64_t axis) {
    return static_cast<float>(extent_m * (2.0 * uniform01({1, Stream::bench, index, axis}) - 1.0));
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

TEST(Texture, IsAColourEverywhereAndAlwaysTheSame) {
  for (const Pattern pattern : kPatterns) {
    Material material = patterned(pattern, 0.7F);
    material.rgb = {1.0F, 1.0F, 0.0F};
    for (std::uint64_t i = 0; i < 3000; ++i) {
      const Vec3f p_m = random_place(i, 500.0);
      const Vec3f normal = random_place(i + 10000, 1.0).normalized();
      const std::array<float, 3> colour = albedo(material, p_m, normal);
      for (const float channel : colour) {
        ASSERT_GE(channel, 0.0F);
        ASSERT_LE(channel, 1.0F);
      }
      ASSERT_EQ(colour, albedo(material, p_m, normal));
      ASSERT_TRUE(pattern != Pattern::plain || colour == material.rgb);
    }
  }
}

/// Lengths of the runs of equal answers along a line, the first and last left out.
template <typename Answer>
std::vector<double> runs_m(const Answer& answer, double length_m, double step_m) {
  std::vector<double> runs;
  double began_m = 0.0;
  for (double s = step_m; s < length_m; s += step_m) {
    if (answer(s) == answer(s - step_m)) continue;
    runs.push_back(s - began_m);
    began_m = s;
  }
  if (!runs.empty()) runs.erase(runs.begin());
  return runs;
}

TEST(Texture, StripesAreBandsInZAndCheckerIsCubesWithoutBordersAtRoundCoordinates) {
  const Material stripes = patterned(Pattern::stripes, 0.4F);
  for (const auto& [material, axis] :
       {std::pair(stripes, 2), std::pair(patterned(Pattern::checker, 0.4F), 0),
        std::pair(patterned(Pattern::checker, 0.4F), 1),
        std::pair(patterned(Pattern::checker, 0.4F), 2)}) {
    const auto along = [&, axis = axis, &material = material](double s) {
      Vec3f p_m(0.05F, 0.05F, 0.05F);
      p_m[axis] = static_cast<float>(s - 4.0);
      return albedo(material, p_m, kUp) == material.rgb;
    };
    const auto runs = runs_m(along, 8.0, 1e-3);
    ASSERT_GE(runs.size(), 18U);
    for (const double run_m : runs) EXPECT_NEAR(run_m, 0.4, 2e-3);  // two steps
  }
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Vec3f p_m = random_place(i, 5.0);
    EXPECT_EQ(albedo(stripes, p_m, kUp), albedo(stripes, {0, 9, p_m.z()}, kEast));
  }
  for (const Pattern pattern : {Pattern::stripes, Pattern::checker}) {
    for (const float size_m : {0.5F, 1.0F, 2.0F}) {
      const Material material = patterned(pattern, size_m);
      for (int twice = -10; twice <= 10; ++twice) {
        const float z_m = 0.5F * static_cast<float>(twice);
        EXPECT_EQ(albedo(material, {0.1F, 0.1F, z_m - 1e-3F}, kUp),
                  albedo(material, {0.1F, 0.1F, z_m + 1e-3F}, kUp));
      }
    }
  }
}

TEST(Texture, PanelsAreSheetsOfTheirOwnLightnessBetweenJoints) {
  const Material material = patterned(Pattern::panels, 1.5F);
  for (const Vec3f& normal : {kUp, kEast, Vec3f(-Vec3f::UnitY())}) {
    const int axis = normal == kUp ? 0 : 2;
    const auto is_joint = [&](double s) {
      Vec3f p_m(0.7F, 0.7F, 0.7F);
      p_m[axis] = static_cast<float>(s - 9.0);
      return albedo(material, p_m, normal) == material.rgb_2;
    };
    const auto runs = runs_m(is_joint, 18.0, 1e-3);
    ASSERT_GE(runs.size(), 20U);
    for (std::size_t i = 0; i + 1 < runs.size(); ++i) {
      EXPECT_NEAR(runs[i] + runs[i + 1], 1.5, 3e-3);  // a sheet and a joint
    }
  }
  // one lightness over a sheet, another over the next, about the material's own
  const auto sheet = [&](double x) {
    return albedo(material, {static_cast<float>(x), 0.7F, 0.0F}, kUp);
  };
  EXPECT_EQ(sheet(0.2), sheet(1.3));
  double sum = 0.0;
  for (int i = 0; i < 400; ++i) {
    EXPECT_NE(sheet(1.5 * i + 0.7), sheet(1.5 * i + 2.2));
    EXPECT_NEAR(sheet(1.5 * i + 0.7)[1], 0.5, 0.031);
    sum += sheet(1.5 * i + 0.7)[1];
  }
  EXPECT_NEAR(sum / 400, 0.5, 0.004);  // four of 0.06 / sqrt(12) / sqrt(400)
}

TEST(Texture, BricksAreLaidInRunningBond) {
  const Material material = patterned(Pattern::bricks, 0.3F);
  const auto is_mortar = [&](double y, double z) {
    return albedo(material, {0.0F, static_cast<float>(y), static_cast<float>(z)}, kEast) ==
           material.rgb_2;
  };
  // courses of a third of the length
  for (std::size_t i = 0;
       const double run_m : runs_m([&](double z) { return is_mortar(0.1, z); }, 2.0, 2e-4)) {
    EXPECT_NEAR(run_m, i++ % 2 == 0 ? 0.085 : 0.015, 5e-4);
  }
  // upright joints half a brick on in the next course
  for (int brick = -5; brick < 5; ++brick) {
    const double joint_m = 0.3 * brick + 0.007;
    EXPECT_TRUE(is_mortar(joint_m, 0.05));
    EXPECT_FALSE(is_mortar(joint_m, 0.15));
    EXPECT_TRUE(is_mortar(joint_m + 0.15, 0.15));
    EXPECT_FALSE(is_mortar(joint_m + 0.15, 0.05));
  }
}

TEST(Texture, NoiseIsContinuousAndVaries) {
  const Material material = patterned(Pattern::noise, 1.0F);
  float low = 1.0F;
  float high = 0.0F;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const Vec3f p_m = random_place(i, 40.0);
    const float here = albedo(material, p_m, kUp)[0];
    const float beside = albedo(material, p_m + Vec3f(1e-3F, 0, 0), kUp)[0];
    // slopes: 1.5 of a smooth step, times 8/15, 8/15, ... of each octave (half as high, twice as
    // steep), times 0.8 between the colours: 2.6 per metre
    EXPECT_NEAR(here, beside, 2.6e-3 + 1e-4);
    low = std::min(low, here);
    high = std::max(high, here);
  }
  EXPECT_LT(low, 0.35F);
  EXPECT_GT(high, 0.65F);
}

}  // namespace
}  // namespace gnbv
