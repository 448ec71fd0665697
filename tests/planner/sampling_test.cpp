// Profiling waypoints, AGVS candidates and termination: all pure functions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "planner/profiling.hpp"
#include "planner/termination.hpp"
#include "planner/view_sampling.hpp"

namespace gnbv {
namespace {

const Box3 kBox(Vec3(-20, -20, 0.7), Vec3(20, 20, 20));

double length_m(const std::vector<ProfileLeg>& legs) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < legs.size(); ++i) {
    sum_m += (legs[i].goal.p_world_m - legs[i - 1].goal.p_world_m).norm();
  }
  return sum_m;
}

TEST(BoundingBoxProfile, HasThePapersLength) {
  // released_code.md: 8 x 19.3 + 7 x sqrt(20^2 + 19.3^2) = 349 m without the approach
  const auto legs = bounding_box_profile(kBox, {Vec3(0, -20, 5), 0});
  ASSERT_EQ(legs.size(), 16U);
  EXPECT_NEAR(length_m(legs), 8 * 19.3 + 7 * std::hypot(20.0, 19.3), 1e-9);
}

TEST(BoundingBoxProfile, StartsAtTheNearestStationAndVisitsAllEight) {
  for (const Vec3& start : {Vec3(0, -20, 5), Vec3(19, 18, 3), Vec3(-20, 3, 1)}) {
    const auto legs = bounding_box_profile(kBox, {start, 0});
    std::set<std::tuple<double, double>> stations;
    double nearest_m = 1e9;
    for (const ProfileLeg& leg : legs) {
      stations.insert({leg.goal.p_world_m.x(), leg.goal.p_world_m.y()});
      nearest_m = std::min(nearest_m, (leg.goal.p_world_m - start).head<2>().norm());
    }
    EXPECT_EQ(stations.size(), 8U);
    EXPECT_EQ((legs[0].goal.p_world_m - start).head<2>().norm(), nearest_m);
  }
}

TEST(BoundingBoxProfile, DescendsFromTopToBottomFacingTheCentre) {
  const auto legs = bounding_box_profile(kBox, {Vec3(3, -20, 5), 0});
  for (std::size_t i = 0; i < legs.size(); i += 2) {
    EXPECT_FALSE(legs[i].is_scan);
    EXPECT_TRUE(legs[i + 1].is_scan);
    EXPECT_EQ(legs[i].goal.p_world_m.z(), 20.0);
    EXPECT_EQ(legs[i + 1].goal.p_world_m.z(), 0.7);
    const Vec3 forward = T_world_body(legs[i].goal).linear().col(0);
    const Vec3 to_center = (kBox.center() - legs[i].goal.p_world_m).cwiseProduct(Vec3(1, 1, 0));
    EXPECT_NEAR(forward.dot(to_center.normalized()), 1.0, 1e-12);
  }
}

TEST(Agvs, OffersTheGridOfThePaperWithoutTheCurrentPose) {
  const ViewPose current{Vec3(1, 2, 3), 0.3};
  const AgvsConfig config;
  const auto views = sample_agvs(config, current, 1.0);
  EXPECT_EQ(views.size(), 80U);  // 3 x 3 x 3 positions, 3 yaws, less the current pose
  for (const ViewPose& view : views) {
    const Vec3 offset = view.p_world_m - current.p_world_m;
    EXPECT_LE(offset.norm(), std::sqrt(3.0) + 1e-12);
    EXPECT_FALSE(offset.norm() < 1e-9 && view.yaw_rad == current.yaw_rad);
  }
}

TEST(Agvs, ScalesItsStepAndOffersRotationsOnlyAtScaleOne) {
  AgvsConfig config;
  const ViewPose current{Vec3(0, 0, 5), 0};
  EXPECT_EQ(sample_agvs(config, current, 1.5).size(), 78U);
  double farthest_m = 0.0;
  for (const ViewPose& view : sample_agvs(config, current, 1.5)) {
    farthest_m = std::max(farthest_m, (view.p_world_m - current.p_world_m).norm());
  }
  EXPECT_NEAR(farthest_m, 1.5 * std::sqrt(3.0), 1e-12);
  config.rotation_only = false;
  EXPECT_EQ(sample_agvs(config, current, 1.0).size(), 78U);
}

TEST(Agvs, TurnsWithTheBody) {
  // the same candidates, seen from the body, whatever the heading
  const AgvsConfig config;
  const auto at_zero = sample_agvs(config, {Vec3::Zero(), 0.0}, 1.0);
  const auto turned = sample_agvs(config, {Vec3::Zero(), 1.1}, 1.0);
  const Eigen::AngleAxisd back(-1.1, Vec3::UnitZ());
  ASSERT_EQ(at_zero.size(), turned.size());
  for (std::size_t i = 0; i < turned.size(); ++i) {
    EXPECT_LT((back * turned[i].p_world_m - at_zero[i].p_world_m).norm(), 1e-12);
    EXPECT_NEAR(wrap_angle_rad(turned[i].yaw_rad - 1.1 - at_zero[i].yaw_rad), 0.0, 1e-12);
  }
}

TEST(Agvs, ScaleGrowsWhenUtilityIsLowAndUpToItsLimit) {
  const AgvsConfig config;
  const Progress low{.utilities = {0.5, 0.05, 0.02, 0.09}, .entropies_nat = {}, .view_voxels = 1};
  const Progress high{.utilities = {0.01, 0.02, 0.3}, .entropies_nat = {}, .view_voxels = 1};
  const Progress few{.utilities = {0.0, 0.0}, .entropies_nat = {}, .view_voxels = 1};
  EXPECT_EQ(next_agvs_scale(config, 1.0, low), 1.5);
  EXPECT_EQ(next_agvs_scale(config, 6.0, low), 7.5);
  EXPECT_EQ(next_agvs_scale(config, 6.0, high), 1.0);
  EXPECT_EQ(next_agvs_scale(config, 1.0, few), 1.0);
}

TEST(Agvs, ScaleGrowsWhenEntropyStandsStill) {
  AgvsConfig config;
  config.entropy_threshold_nat = 0.001;
  config.entropy_window = 3;
  // of 1000 voxels: still below 1 nat a view, up or down
  const std::vector<double> still = {900, 500, 499.5, 500.2, 500.1};
  const std::vector<double> moving = {500, 499.5, 498, 498.1};
  const auto scale = [&](const std::vector<double>& entropies_nat) {
    return next_agvs_scale(config, 1.0,
                           {.utilities = {}, .entropies_nat = entropies_nat, .view_voxels = 1000});
  };
  EXPECT_EQ(scale(still), 1.5);
  EXPECT_EQ(scale(moving), 1.0);
  EXPECT_EQ(scale({500, 500, 500}), 1.0);  // no full window yet
  config.entropy_threshold_nat = 0.0;
  EXPECT_EQ(scale(still), 1.0);
}

TEST(EntropyTermination, NeedsEveryViewOfTheWindowToBeQuiet) {
  TerminationConfig config;
  config.entropy_window = 3;
  config.entropy_change_percent = 0.001;
  const std::vector<double> quiet = {2e6, 1e6, 1e6 - 5, 1e6 - 9, 1e6 - 10};
  const std::vector<double> one_loud = {1e6, 1e6 - 5, 1e6 - 25, 1e6 - 26};
  EXPECT_TRUE(entropy_has_settled(config, quiet));
  EXPECT_FALSE(entropy_has_settled(config, one_loud));  // 20 nat are 0.002 %
}

TEST(EntropyTermination, WaitsForAFullWindowAndCanBeSwitchedOff) {
  TerminationConfig config;
  config.entropy_window = 3;
  EXPECT_FALSE(entropy_has_settled(config, std::vector<double>{1e6, 1e6, 1e6}));
  EXPECT_TRUE(entropy_has_settled(config, std::vector<double>{1e6, 1e6, 1e6, 1e6}));
  config.entropy_change_percent = 0.0;
  EXPECT_FALSE(entropy_has_settled(config, std::vector<double>{1e6, 1e6, 1e6, 1e6}));
}

}  // namespace
}  // namespace gnbv
