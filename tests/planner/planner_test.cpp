// What the planner remembers, and the presets of its switches.
#include "planner/planner.hpp"

#include <gtest/gtest.h>

#include "planner/presets.hpp"

namespace gnbv {
namespace {

TEST(RememberEntropy, StartsWithTheFirstDepthReturn) {
  const CameraModel camera = make_camera_model({});
  const PlannerModel model({}, Box3(Vec3(-8, -8, 0), Vec3(8, 8, 8)), {&camera, 1}, {});
  Belief belief(model);
  History history;
  remember_entropy(belief, 10.0, history);
  EXPECT_TRUE(history.entropies_nat.empty());
  belief.has_depth_return = true;
  remember_entropy(belief, 9.0, history);
  remember_entropy(belief, 8.0, history);
  const double now_nat = belief.grid.total_entropy_nat();
  EXPECT_EQ(history.entropies_nat, (std::vector<double>{9.0, now_nat, now_nat}));
}

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
