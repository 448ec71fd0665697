#include "sim/flight/smooth_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/rng.hpp"
#include "sim/flight/guidance.hpp"
#include "sim/flight/vehicle_config.hpp"

namespace gnbv {
namespace {

const VehicleConfig kVehicle;
const GuidanceConfig kGuidance;

std::vector<PassedPose> random_poses(int seed, int count) {
  Rng rng(static_cast<std::uint64_t>(seed), Stream::bench, 0);
  std::vector<PassedPose> poses;
  Vec3 p_m(0, 0, 5);
  for (int i = 0; i < count; ++i) {
    p_m += 3.0 * Vec3(rng.uniform() - 0.5, rng.uniform() - 0.5, rng.uniform() - 0.5);
    poses.push_back({{p_m, 2.0 * kPi * rng.uniform()}});
  }
  return poses;
}

std::vector<Reference> way_past(std::span<const PassedPose> poses) {
  return smooth_path({.p_world_m = Vec3(0, 0, 5)}, poses, kGuidance.path_speed_m_s, kGuidance,
                     kVehicle);
}

TEST(SmoothPath, KeepsItsLimitsAndIsSmooth) {
  const RestToRest::Limits turn = turn_limits(kGuidance, kVehicle);
  for (int seed = 1; seed <= 50; ++seed) {
    const auto path = way_past(random_poses(seed, 8));
    ASSERT_FALSE(path.empty());
    Reference before = {.p_world_m = Vec3(0, 0, 5)};
    for (const Reference& now : path) {
      const Vec3 mean_v = 0.5 * (before.v_world_m_s + now.v_world_m_s);
      EXPECT_LE((now.p_world_m - before.p_world_m - kReference_s * mean_v).norm(), 1e-12);
      const Vec3 mean_a = 0.5 * (before.a_world_m_s2 + now.a_world_m_s2);
      EXPECT_LE((now.v_world_m_s - before.v_world_m_s - kReference_s * mean_a).norm(), 1e-12);
      EXPECT_LE((now.a_world_m_s2 - before.a_world_m_s2).norm(),
                kGuidance.jerk_m_s3 * kReference_s + 1e-9);
      EXPECT_LE(now.a_world_m_s2.norm(), kGuidance.acceleration_m_s2 + 1e-9);
      EXPECT_LE(now.v_world_m_s.norm(), 1.02 * kGuidance.path_speed_m_s);
      EXPECT_LE(std::abs(now.yaw_rate_rad_s), 1.02 * turn.speed);
      EXPECT_LE(std::abs(now.yaw_acceleration_rad_s2), turn.acceleration + 1e-9);
      before = now;
    }
  }
}

TEST(SmoothPath, PassesEachPoseInOrderAndRestsAtTheLast) {
  for (int seed = 1; seed <= 50; ++seed) {
    const auto poses = random_poses(seed, 8);
    const auto path = way_past(poses);
    std::size_t passed = 0;
    for (const Reference& now : path) {
      ASSERT_LE(now.passed, passed + 1);
      if (now.passed > passed && now.passed < poses.size()) {
        const ViewPose& pose = poses[passed].pose;
        EXPECT_LE((now.p_world_m - pose.p_world_m).norm(), kGuidance.pass_distance_m);
        EXPECT_LE(std::abs(wrap_angle_rad(now.yaw_rad - pose.yaw_rad)), kGuidance.pass_yaw_rad);
      }
      passed = now.passed;
    }
    ASSERT_EQ(passed, poses.size());
    EXPECT_LE((path.back().p_world_m - poses.back().pose.p_world_m).norm(), 0.05);
    EXPECT_LE(path.back().v_world_m_s.norm(), 0.05);
  }
}

/// A point that is only on the way slows nobody down.
TEST(SmoothPath, IsAsFastAsARestToRestOnAStraightWayWhateverLiesOnIt) {
  const RestToRest legs(
      20.0, {kGuidance.path_speed_m_s, kGuidance.acceleration_m_s2, kGuidance.jerk_m_s3});
  std::vector<PassedPose> poses;
  for (int i = 1; i <= 10; ++i) poses.push_back({{Vec3(2.0 * i, 0, 5), 0.0}, i % 2 == 0});
  const double seconds = kReference_s * static_cast<double>(way_past(poses).size());
  EXPECT_LE(seconds, legs.duration_s() + 1.5);
  EXPECT_GE(seconds, legs.duration_s() - 0.5);
}

}  // namespace
}  // namespace gnbv
