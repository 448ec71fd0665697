// The presets of the planner's switches.
#include "planner/config.hpp"

#include <gtest/gtest.h>

namespace gnbv {
namespace {

TEST(Presets, DifferInTheirSwitchesAndInNothingElse) {
  PlannerConfig config;
  config.utility.alpha = 7.0;
  config.map.resolution_m = 0.3;
  config.preset = "released";
  set_preset_switches(config);
  EXPECT_EQ(config.fvs.frontier.max_extent_m, 0.0);
  EXPECT_EQ(config.fvs.views_per_layer, 8);
  EXPECT_EQ(config.utility.hit_voxel, HitVoxel::excluded);
  EXPECT_EQ(config.utility.alpha, 7.0);
  EXPECT_EQ(config.map.resolution_m, 0.3);
  config.preset = "paper";
  set_preset_switches(config);
  EXPECT_EQ(config.fvs.frontier.max_extent_m, 2.0);
  EXPECT_EQ(config.fvs.views_per_layer, 4);
  EXPECT_EQ(config.utility.hit_voxel, HitVoxel::counted);
}

}  // namespace
}  // namespace gnbv
