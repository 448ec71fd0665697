// What the planner on board refuses, believes and ends by. That it plans as the program does is the
// law of tests/end_to_end/onboard_test.cpp.
#include "planner/onboard.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/reference/analytic_scans.hpp"
#include "sim/core/error.hpp"
#include "tests/support/fault.hpp"

namespace gnbv {
namespace {

OnboardSettings small_settings() {
  OnboardSettings settings;
  settings.workspace_m = Box3(Vec3(-10, -8, 0), Vec3(10, 8, 6));
  settings.cameras = {{.name = "rgbd", .width_px = 80, .height_px = 60}};
  settings.lidars = {LidarConfig{}};
  settings.planner.utility.name = "nearest_frontier";
  settings.planner.agvs.step_m = 0.5;
  return settings;
}

const ViewPose kStart = {Vec3(-7, -6, 3), 0.6};

std::vector<DepthFrame> frames_from(const ViewPose& pose) {
  const CameraModel camera = make_camera_model(small_settings().cameras[0]);
  return {analytic_depth(example_scene(), camera, T_world_body(pose))};
}

std::string refusal(const std::function<void(OnboardSettings&)>& change) {
  OnboardSettings settings = small_settings();
  change(settings);
  return test::fault_of([&] { Onboard(std::move(settings)); });
}

TEST(Onboard, RefusesWhatNobodyCanPlanWith) {
  EXPECT_EQ(refusal([](OnboardSettings&) {}), "");
  EXPECT_THAT(refusal([](OnboardSettings& s) {
                s.cameras.clear();
                s.lidars.clear();
              }),
              testing::HasSubstr("needs a camera"));
  EXPECT_THAT(refusal([](OnboardSettings& s) { s.workspace_m.setEmpty(); }),
              testing::HasSubstr("needs a workspace"));
  EXPECT_THAT(refusal([](OnboardSettings& s) { s.planner.utility.name = "propose"; }),
              testing::AllOf(testing::HasSubstr("propose "), testing::HasSubstr("tour")));
}

TEST(Onboard, BelievesFramesOnTheWayAsThoseOfAView) {
  Onboard on_the_way(small_settings());
  on_the_way.add_frames(frames_from(kStart));
  Onboard at_a_view(small_settings());
  at_a_view.add_view(kStart, frames_from(kStart));
  EXPECT_GT(on_the_way.belief().grid.occupied_count(), 0U);
  EXPECT_EQ(on_the_way.belief().grid.total_entropy_nat(),
            at_a_view.belief().grid.total_entropy_nat());
  EXPECT_TRUE(on_the_way.history().decisions.empty());
  ASSERT_EQ(at_a_view.history().decisions.size(), 1U);
  EXPECT_TRUE(is_same_view(at_a_view.history().decisions[0].view, kStart));
}

TEST(Onboard, BelievesAProfileThatIsMeasuredNow) {
  Onboard planner(small_settings());
  const std::vector<LidarScan> sweeps = {
      analytic_scan(example_scene(), LidarConfig{}, T_world_body(kStart))};
  planner.add_profile(sweeps);
  EXPECT_FALSE(planner.belief().cloud.points_world_m().empty());
}

TEST(Onboard, EndsByTheRulesAndSaysWhich) {
  OnboardSettings settings = small_settings();
  settings.planner.termination.max_iterations = 2;
  Onboard planner(settings);
  planner.add_view(kStart, frames_from(kStart));
  const std::optional<Decision> next = planner.next_view();
  ASSERT_TRUE(next);
  planner.add_view(next->view, frames_from(next->view));
  EXPECT_FALSE(planner.next_view());
  EXPECT_EQ(planner.end(), Termination::max_iterations);

  settings.planner.termination.max_distance_m = 1e-3;
  settings.planner.agvs.rotation_only = false;
  Onboard short_of_breath(settings);
  short_of_breath.add_view(kStart, frames_from(kStart));
  EXPECT_FALSE(short_of_breath.next_view());
  EXPECT_EQ(short_of_breath.end(), Termination::max_distance);
}

TEST(Onboard, RemembersWhatItDecidedAndHowFarThatIs) {
  OnboardSettings settings = small_settings();
  settings.planner.agvs.rotation_only = false;
  Onboard planner(std::move(settings));
  planner.add_view(kStart, frames_from(kStart));
  const std::optional<Decision> next = planner.next_view();
  ASSERT_TRUE(next);
  planner.add_view(next->view, frames_from(next->view));
  const History& history = planner.history();
  ASSERT_EQ(history.decisions.size(), 2U);
  EXPECT_GT(next->candidates, 0);
  EXPECT_EQ(history.decisions[1].candidates, next->candidates);
  EXPECT_EQ(history.progress[0].straight_m, 0.0);
  EXPECT_NEAR(history.progress[1].straight_m, (next->view.p_world_m - kStart.p_world_m).norm(),
              1e-12);
}

TEST(Onboard, TheUtilityOfTheUserDecides) {
  OnboardSettings settings = small_settings();
  settings.utility = {"left turn",
                      [](const ViewStats&, const ViewPose& view) { return view.yaw_rad; }, ""};
  Onboard planner(std::move(settings));
  planner.add_view(kStart, frames_from(kStart));
  const std::optional<Decision> next = planner.next_view();
  ASSERT_TRUE(next);
  EXPECT_NEAR(next->view.yaw_rad, kStart.yaw_rad + deg_to_rad(45.0), 1e-12);
  EXPECT_EQ(next->score.value, next->view.yaw_rad);
}

TEST(Onboard, StopsWhereItIsAskedTo) {
  OnboardSettings settings = small_settings();
  settings.planner.utility.name = "tour";
  settings.should_stop = [] { return true; };
  Onboard planner(std::move(settings));
  planner.add_view(kStart, frames_from(kStart));
  EXPECT_THROW(planner.next_view(), StopRequested);
}

}  // namespace
}  // namespace gnbv
