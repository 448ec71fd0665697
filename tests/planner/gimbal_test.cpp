// What a gimbal adds to the planner: views of every pitch, each seen as a fixed camera would.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "planner/guided/view_sampling.hpp"
#include "planner/map/frontiers.hpp"
#include "tests/planner/wall_world.hpp"

namespace gnbv {
namespace {

constexpr std::array kPitches = {-0.5, 0.0, 0.5};

CameraConfig on_gimbal() {
  CameraConfig config;
  config.p_body_m = Vec3(0.1, 0.0, -0.2);
  config.yaw_rad = 0.3;
  config.gimbal = GimbalConfig{.min_rad = -0.5, .max_rad = 0.5, .step_rad = 0.5};
  config.pitch_rad = nearest_pitch_rad(*config.gimbal, 0.0);
  return config;
}

CameraModel fixed_at(double pitch_rad) {
  CameraConfig config = on_gimbal();
  config.gimbal.reset();
  config.pitch_rad = pitch_rad;
  return make_camera_model(config);
}

TEST(Gimbal, OffersItsPitchesUpToTheLast) {
  EXPECT_EQ(pitches_rad({.min_rad = -0.5, .max_rad = 0.5, .step_rad = 0.5}),
            (std::vector<double>{-0.5, 0.0, 0.5}));
  EXPECT_EQ(pitches_rad({.min_rad = -0.5, .max_rad = 0.4, .step_rad = 0.5}),
            (std::vector<double>{-0.5, 0.0}));
  // ten steps of a tenth end at the end, whatever rounding makes of them
  const auto tenths = pitches_rad({.min_rad = 0.0, .max_rad = 1.0, .step_rad = 0.1});
  ASSERT_EQ(tenths.size(), 11U);
  EXPECT_EQ(tenths.back(), 1.0);
}

TEST(Gimbal, TurnedIsMountedAtThatPitch) {
  const CameraModel camera = make_camera_model(on_gimbal());
  for (const double pitch_rad : kPitches) {
    EXPECT_EQ(turned(camera, pitch_rad).T_body_camera.matrix(),
              fixed_at(pitch_rad).T_body_camera.matrix());
  }
  // and looks down where it is positive: the optical axis is the third column
  EXPECT_LT(turned(camera, 0.5).T_body_camera(2, 2), -0.1);
  const CameraModel fixed = fixed_at(0.2);
  EXPECT_EQ(turned(fixed, 0.5).T_body_camera.matrix(), fixed.T_body_camera.matrix());
}

TEST(Gimbal, AViewIsWalkedByTheRaysOfAFixedCamera) {
  const std::array cameras = {on_gimbal(), fixed_at(0.2).config};
  const PlannerModel model({}, {}, Box3(Vec3(-5, -5, 0), Vec3(5, 5, 5)), cameras, {});
  for (const double pitch_rad : kPitches) {
    const std::array fixed = {fixed_at(pitch_rad), fixed_at(0.2)};
    EXPECT_EQ(model.rays_at(pitch_rad).end_body_m,
              make_view_rays(fixed, model.belief.map.resolution_m).end_body_m);
  }
  EXPECT_TRUE(model.can_pitch(0.3));
  EXPECT_FALSE(model.can_pitch(0.6));
  const PlannerModel without({}, {}, model.workspace_m, std::array{fixed_at(0.2).config}, {});
  EXPECT_EQ(without.view_rays.size(), 1U);
  EXPECT_TRUE(without.can_pitch(0.0));
  EXPECT_FALSE(without.can_pitch(0.2));
}

TEST(Gimbal, EverySamplerOffersEachOfItsViewsWithEachPitch) {
  const ViewPose current{Vec3(1, 2, 3), 0.3, 0.5};
  const auto level = sample_agvs({}, current, 1.0);
  const auto pitched = sample_agvs({}, current, 1.0, kPitches);
  EXPECT_EQ(pitched.size(), 3 * (level.size() + 1) - 1);  // only the current pose is left out
  const auto has = [](const std::vector<ViewPose>& views, const ViewPose& view) {
    return std::any_of(views.begin(), views.end(),
                       [&](const ViewPose& v) { return is_same_view(v, view); });
  };
  for (ViewPose view : level) {
    for (const double pitch_rad : kPitches) {
      view.gimbal_pitch_rad = pitch_rad;
      EXPECT_TRUE(has(pitched, view));
    }
  }
  EXPECT_FALSE(has(pitched, current));
  EXPECT_TRUE(has(pitched, {current.p_world_m, current.yaw_rad, -0.5}));
  EXPECT_EQ(sample_fvs({}, Vec3::Zero(), kPitches).size(), 3 * sample_fvs({}, Vec3::Zero()).size());
  // without a gimbal only 0 is offered, and nothing changes
  const auto none = sample_agvs({}, {Vec3(1, 2, 3), 0.3}, 1.0, std::array{0.0});
  ASSERT_EQ(none.size(), level.size());
  for (std::size_t i = 0; i < none.size(); ++i) EXPECT_EQ(none[i].yaw_rad, level[i].yaw_rad);
}

TEST(Gimbal, AnotherPitchIsAnotherView) {
  const PlannerModel model({}, {}, Box3(Vec3(-5, -5, 0), Vec3(5, 5, 5)), std::array{on_gimbal()},
                           {});
  Belief belief(model);
  ScanUpdate update;
  for (VoxelIndex v = 0; v < belief.grid.geometry().voxel_count(); ++v) update.free.push_back(v);
  belief.grid.apply(update);
  const ViewPose here{Vec3(0, 0, 2), 0.0, 0.0};
  const auto rejection = [&](double pitch_rad) {
    const ViewPose view{here.p_world_m, 0.0, pitch_rad};
    Candidate candidate{.view = view, .sampler = Sampler::route};
    const std::array recent = {here};
    ViewChecker checker(model.validity, model.navigation_m, model.no_fly, belief.grid, recent,
                        here);
    check(checker, model, candidate);
    return candidate.rejected;
  };
  EXPECT_EQ(rejection(0.0), Rejection::recently_visited);
  EXPECT_EQ(rejection(0.5), std::nullopt);
  EXPECT_EQ(rejection(0.6), Rejection::beyond_gimbal);
}

TEST(Gimbal, LooksAtTheClusterWhereSomePitchDoes) {
  const OccupancyGrid grid(OccupancyConfig{}, Box3(Vec3(-5, -5, -5), Vec3(5, 5, 5)));
  CameraConfig config = on_gimbal();
  config.yaw_rad = 0.0;
  const CameraModel camera = make_camera_model(config);
  const FrontierCluster below{{}, Vec3(2.0, 0.0, -1.5)};  // 33 degrees down, 22.5 are in the image
  const auto rejection = [&](double pitch_rad) {
    return cluster_rejection({&camera, 1}, grid, below, {Vec3::Zero(), 0.0, pitch_rad}, false);
  };
  EXPECT_EQ(rejection(0.0), Rejection::cluster_outside_fov);
  EXPECT_EQ(rejection(0.5), std::nullopt);
  EXPECT_EQ(rejection(-0.5), Rejection::cluster_outside_fov);
}

}  // namespace
}  // namespace gnbv
