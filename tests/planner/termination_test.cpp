// The rules of belief that end a mission.
#include "planner/core/termination.hpp"

#include <gtest/gtest.h>

#include "planner/core/history.hpp"

namespace gnbv {
namespace {

/// Views half a metre apart, each of which makes so many voxels occupied and adds so many points.
std::vector<MapProgress> walk(const std::vector<std::size_t>& voxels,
                              const std::vector<std::size_t>& points) {
  std::vector<MapProgress> progress = {{.occupied_voxels = 100, .cloud_points = 1000}};
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    progress.push_back({.occupied_voxels = progress.back().occupied_voxels + voxels[i],
                        .cloud_points = progress.back().cloud_points + points[i],
                        .straight_m = progress.back().straight_m + 0.5});
  }
  return progress;
}

TEST(GainIsLow, BelowTheThresholdOverTheWholeWindowAndNotBefore) {
  TerminationConfig config;
  config.new_voxels_window = 3;
  // 9 voxels in the last 1.5 m: 6 a metre
  const auto progress = walk({90, 6, 0, 3}, {0, 0, 0, 0});
  EXPECT_FALSE(gain_is_low(config, progress));  // off by default
  config.min_new_voxels_per_m = 6.0;
  EXPECT_FALSE(gain_is_low(config, progress));
  config.min_new_voxels_per_m = 6.001;
  EXPECT_TRUE(gain_is_low(config, progress));
  EXPECT_FALSE(gain_is_low(config, std::span(progress).first(4)));  // 96 voxels in it
  EXPECT_FALSE(gain_is_low(config, std::span(progress).last(3)));   // two views are no window
  config.new_voxels_window = 4;                                     // 99 voxels in 2 m
  EXPECT_FALSE(gain_is_low(config, progress));
}

TEST(GainIsLow, OfViewsThatOnlyTurnIsUnknownAndOfLostVoxelsNegative) {
  TerminationConfig config;
  config.new_voxels_window = 1;
  config.min_new_voxels_per_m = 1e-6;
  EXPECT_FALSE(gain_is_low(config, std::vector<MapProgress>{{100, 0, 2.0}, {100, 0, 2.0}}));
  EXPECT_TRUE(gain_is_low(config, std::vector<MapProgress>{{100, 0, 2.0}, {99, 0, 3.0}}));
}

TEST(PointsHaveDriedUp, AfterSoManyViewsInARowThatAddNone) {
  TerminationConfig config;
  const auto progress = walk({0, 0, 0, 0}, {7, 1, 0, 0});
  EXPECT_FALSE(points_have_dried_up(config, progress));  // off by default
  config.max_views_without_new_points = 2;
  EXPECT_TRUE(points_have_dried_up(config, progress));
  EXPECT_FALSE(points_have_dried_up(config, std::span(progress).first(4)));
  EXPECT_FALSE(points_have_dried_up(config, std::span(progress).last(2)));
  config.max_views_without_new_points = 3;
  EXPECT_FALSE(points_have_dried_up(config, progress));
}

TEST(IsTooFar, ALegThatPassesTheLimitNotOneThatEndsOnIt) {
  TerminationConfig config;
  EXPECT_FALSE(is_too_far(config, 1e6, 1e6));  // off by default
  config.max_distance_m = 10.0;
  EXPECT_FALSE(is_too_far(config, 7.5, 2.5));
  EXPECT_TRUE(is_too_far(config, 7.5, 2.5000001));
}

TEST(BelievedEnd, TheFirstRuleNamesTheEnd) {
  TerminationConfig config;
  config.entropy_window = 1;
  config.new_voxels_window = 1;
  config.min_new_voxels_per_m = 1.0;
  config.max_views_without_new_points = 1;
  const std::vector<double> settled = {5.0, 5.0}, going = {5.0, 4.0};
  const auto nothing = walk({0}, {0}), points = walk({0}, {1}), voxels = walk({1}, {0});
  EXPECT_EQ(believed_end(config, {}, settled, nothing, {}), Termination::entropy_change);
  EXPECT_EQ(believed_end(config, {}, going, nothing, {}), Termination::low_gain);
  EXPECT_EQ(believed_end(config, {}, going, points, {}), Termination::low_gain);
  EXPECT_EQ(believed_end(config, {}, going, voxels, {}), Termination::no_new_points);
  EXPECT_EQ(believed_end(config, {}, going, walk({1}, {1}), {}), std::nullopt);
}

TEST(BelievedEnd, APlannerMaySwitchRulesOff) {
  TerminationConfig config;
  config.entropy_window = 1;
  config.max_views_without_new_points = 1;
  config.repeated_moves = 2;
  const std::vector<double> settled = {5.0, 5.0};
  const auto nothing = walk({0}, {0});
  const Vec3 here = Vec3::Zero(), there = Vec3::UnitX();
  const std::vector<Vec3> repeated_m = {here, there, here, there};
  EndRules rules;
  const auto end = [&] { return believed_end(config, rules, settled, nothing, repeated_m); };
  EXPECT_EQ(end(), Termination::entropy_change);
  rules.entropy = false;
  EXPECT_EQ(end(), Termination::no_new_points);
  rules.gain = false;
  EXPECT_EQ(end(), Termination::repeated_motion);
  rules.repetition = false;
  EXPECT_EQ(end(), std::nullopt);
}

}  // namespace
}  // namespace gnbv
