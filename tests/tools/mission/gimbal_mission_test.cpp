// Missions of a vehicle whose camera hangs on a gimbal.
#include <gtest/gtest.h>

#include <set>

#include "tests/support/flown.hpp"
#include "tests/support/watch.hpp"

namespace gnbv {
namespace {

constexpr const char* kGimbal = "cameras.0.pitch_deg={min: 0, max: 60, step: 30}";

std::vector<ViewPose> around(double pitch_rad) {
  return {{Vec3(3.2, 0, 2), kPi, pitch_rad},
          {Vec3(0, 3.2, 2.5), -0.5 * kPi, pitch_rad},
          {Vec3(-3.2, 0, 2), 0.0, pitch_rad}};
}

Scenario route(const std::vector<ViewPose>& views, const std::string& pitch) {
  Scenario scenario = smoke({"planner.utility.name=route", pitch, "cameras.0.rate_hz=2",
                             "planner.validity.allow_unknown=true"});
  scenario.planner.routes.views = views;
  return scenario;
}

/// The oracle: a gimbal that rests at 20 degrees and is never asked for another pitch is a camera
/// fixed there, frame by frame, at the views and between them.
TEST(GimbalMission, ThatNeverTurnsIsThatOfAFixedCamera) {
  const Flown gimbal(
      route(around(deg_to_rad(20.0)), "cameras.0.pitch_deg={min: 20, max: 50, step: 10}"));
  const Flown fixed(route(around(0.0), "cameras.0.pitch_deg=20"));
  ASSERT_EQ(gimbal.result.views.size(), 4U);
  ASSERT_EQ(fixed.result.views.size(), 4U);
  const auto cloud = gimbal.result.belief.cloud.points_world_m();
  const auto expected = fixed.result.belief.cloud.points_world_m();
  EXPECT_EQ(std::vector(cloud.begin(), cloud.end()), std::vector(expected.begin(), expected.end()));
  const auto map = gimbal.result.belief.grid.all_log_odds();
  const auto expected_map = fixed.result.belief.grid.all_log_odds();
  EXPECT_TRUE(std::equal(map.begin(), map.end(), expected_map.begin(), expected_map.end()));
}

TEST(GimbalMission, TakesEveryFrameAtItsViewsPitch) {
  std::vector<ViewPose> views = around(0.0);
  for (std::size_t i = 0; i < views.size(); ++i) {
    views[i].gimbal_pitch_rad = deg_to_rad(std::array{60.0, 10.0, 30.0}[i]);
  }
  Watch watch;
  std::vector<double> pitches_rad;
  const Scenario scenario = route(views, kGimbal);
  watch.sensed = [&](const SensedView& view) {
    const Isometry T_body_camera = view.T_world_body.inverse() * view.depth[0].T_world_camera;
    const Vec3 ahead = T_body_camera.linear().col(2);
    pitches_rad.push_back(std::atan2(-ahead.z(), ahead.x()));
  };
  const Flown flight(scenario, {.observers = {&watch}});
  ASSERT_EQ(pitches_rad.size(), 4U);
  EXPECT_NEAR(pitches_rad[0], 0.0, 1e-9);  // the start is the most level it can be
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_NEAR(pitches_rad[i + 1], views[i].gimbal_pitch_rad, 1e-9) << i;
  }
}

/// 60 degrees a second: a view that only turns the gimbal takes as long as that.
TEST(GimbalMission, WaitsForTheGimbal) {
  const ViewPose down{Vec3(3.2, 0, 2), kPi, deg_to_rad(60.0)};
  const ViewPose level{Vec3(3.2, 0, 2), kPi, 0.0};
  const Flown flight(route({level, down, level, level}, kGimbal));
  const auto& views = flight.result.views;
  ASSERT_EQ(views.size(), 5U);
  constexpr double kRounding_s = 1e-9;
  EXPECT_GT(views[2].time_s - views[1].time_s, 1.0 - kRounding_s);
  EXPECT_LT(views[2].time_s - views[1].time_s, 1.5);
  EXPECT_GT(views[3].time_s - views[2].time_s, 1.0 - kRounding_s);
  EXPECT_LT(views[4].time_s - views[3].time_s, 0.5);
}

TEST(GimbalMission, ChoosesPitchesOfItsOwn) {
  const Flown flight(smoke({kGimbal, "planner.termination.max_iterations=8"}));
  std::set<double> used;
  for (const ViewRecord& view : flight.result.views) {
    used.insert(view.decision.view.gimbal_pitch_rad);
  }
  EXPECT_GT(used.size(), 1U);
  for (const double pitch_rad : used) {
    const auto all = pitches_rad(*flight.scenario.cameras[0].gimbal);
    EXPECT_NE(std::find(all.begin(), all.end(), pitch_rad), all.end());
  }
}

}  // namespace
}  // namespace gnbv
