// Laws of what a plan says it is for: nothing that can be expected is lost or moved.
#include <gtest/gtest.h>

#include "planner/tour/gains.hpp"

namespace gnbv {
namespace {

Patch patch_at(const Vec3f& p_m, float missing, PatchSource source = PatchSource::sampled) {
  return {.target_m = p_m, .normal = Vec3f::UnitZ(), .missing = missing, .source = source};
}

TEST(TourPlan, GathersBySourceAndPlaceWhatCanBeExpected) {
  const ObservationYield yield;
  const std::vector<Patch> patches = {patch_at({0.1F, 0.1F, 0.1F}, 30.0F),
                                      patch_at({0.2F, 0.1F, 0.1F}, 10.0F),
                                      patch_at({-0.1F, 0.1F, 0.1F}, 20.0F),
                                      patch_at({0.2F, 0.2F, 0.2F}, 8.0F, PatchSource::boundary),
                                      patch_at({9.0F, 9.0F, 9.0F}, 0.0F)};
  const TourPlan plan = make_tour_plan({}, patches, yield);
  EXPECT_EQ(plan.cube_m, kLeastCube_m);
  ASSERT_EQ(plan.cubes.size(), 3U);
  const double share = yield.share(patches[0], 0);
  EXPECT_EQ(plan.cubes[0].source, PatchSource::sampled);
  EXPECT_NEAR(plan.cubes[0].p_world_m.x(), -0.1, 1e-6);  // below 0 is another cube
  EXPECT_NEAR(plan.cubes[0].expected, 20.0 * share, 1e-5);
  EXPECT_NEAR(plan.cubes[1].p_world_m.x(), (30.0 * 0.1 + 10.0 * 0.2) / 40.0, 1e-6);
  EXPECT_NEAR(plan.cubes[1].expected, 40.0 * share, 1e-5);
  EXPECT_EQ(plan.cubes[2].source, PatchSource::boundary);
  EXPECT_NEAR(plan.cubes[2].expected, 8.0 * yield.share(patches[3], 0), 1e-5);
}

TEST(TourPlan, CubesGrowUntilTheyAreFew) {
  std::vector<Patch> patches;
  double expected = 0.0;
  const ObservationYield yield;
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 100; ++j) {
      patches.push_back(
          patch_at(Vec3f(0.5F * static_cast<float>(i), 0.5F * static_cast<float>(j), 0.0F) +
                       Vec3f::Constant(0.25F),
                   4.0F));
      expected += static_cast<double>(4.0F * yield.share(patches.back(), 0));
    }
  }
  const TourPlan plan = make_tour_plan({}, patches, yield);
  EXPECT_EQ(plan.cube_m, 1.0);
  EXPECT_EQ(plan.cubes.size(), 2500U);
  double sum = 0.0;
  for (const PatchCube& cube : plan.cubes) sum += cube.expected;
  EXPECT_NEAR(sum, expected, 1e-6 * expected);
}

}  // namespace
}  // namespace gnbv
