#include "planner/view/shadow_band.hpp"

#include <gtest/gtest.h>

#include "sim/core/error.hpp"
#include "tests/planner/view/view_scene.hpp"

namespace gnbv {
namespace {

/// One pixel that looks along +x from x = 0.1 m.
FrameRays ray_to(double x_m, PixelRay kind = PixelRay::hits) {
  FrameRays rays;
  rays.origin_world_m = Vec3f(0.1F, 0.1F, 0.1F);
  rays.end_m = {{{static_cast<float>(x_m)}, {0.1F}, {0.1F}}};
  rays.kind = {kind};
  return rays;
}

TEST(ShadowBand, CountsStepsBehindTheHitUpToItsDepth) {
  Corridor corridor(12);
  ShadowBand band({.shadow_depth_m = 0.75}, corridor.grid.geometry());
  corridor.hit(3);
  band.add(ray_to(0.7), corridor.grid);  // from 0.7 m to 1.45 m: the voxel with the end is left out
  const std::vector<int> expected = {0, 0, 0, 0, 1, 2, 3, 0, 0, 0, 0, 0};
  for (VoxelIndex v = 0; v < 12; ++v) {
    EXPECT_EQ(band.steps_behind(v), expected[v]) << v;
    EXPECT_EQ(corridor.grid.is_shaded(v), expected[v] > 0) << v;
  }
  EXPECT_DOUBLE_EQ(band.steps_max(), 7.5);
}

TEST(ShadowBand, KeepsTheSmallestDistance) {
  Corridor corridor(12);
  ShadowBand band({.shadow_depth_m = 0.75}, corridor.grid.geometry());
  band.add(ray_to(0.7), corridor.grid);
  band.add(ray_to(0.9), corridor.grid);
  EXPECT_EQ(band.steps_behind(5), 1);
  EXPECT_EQ(band.steps_behind(6), 2);
  band.add(ray_to(0.5), corridor.grid);
  EXPECT_EQ(band.steps_behind(5), 1);
}

TEST(ShadowBand, HoldsOnlyWhereNothingHasBeenMeasured) {
  Corridor corridor(12);
  ShadowBand band({.shadow_depth_m = 0.75}, corridor.grid.geometry());
  corridor.miss(4);
  band.add(ray_to(0.7), corridor.grid);
  EXPECT_FALSE(corridor.grid.is_shaded(4));
  EXPECT_EQ(band.steps_behind(4), 0);
  EXPECT_TRUE(corridor.grid.is_shaded(5));
  corridor.miss(5);
  EXPECT_FALSE(corridor.grid.is_shaded(5));
}

TEST(ShadowBand, FollowsHitsAlone) {
  Corridor corridor(12);
  ShadowBand band({.shadow_depth_m = 0.75}, corridor.grid.geometry());
  band.add(ray_to(0.7, PixelRay::clears), corridor.grid);
  band.add(ray_to(0.7, PixelRay::none), corridor.grid);
  for (VoxelIndex v = 0; v < 12; ++v) EXPECT_FALSE(corridor.grid.is_shaded(v));
}

TEST(ShadowBand, RefusesDepthsThatNoByteCounts) {
  const Corridor corridor(2);
  EXPECT_THROW(ShadowBand({.shadow_depth_m = 0.0}, corridor.grid.geometry()), BadInput);
  EXPECT_THROW(ShadowBand({.shadow_depth_m = 17.0}, corridor.grid.geometry()), BadInput);
}

}  // namespace
}  // namespace gnbv
