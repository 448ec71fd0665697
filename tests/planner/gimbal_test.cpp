// What a gimbal adds to the planner: views of every pitch, each seen as a fixed camera would.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/core/belief.hpp"
#include "planner/guided/view_sampling.hpp"
#include "planner/map/frontiers.hpp"
#include "planner/map/occupancy_grid.hpp"
#include "planner/route/route_planners.hpp"
#include "planner/tour/unseen_space.hpp"
#include "sim/core/error.hpp"
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
  const AgvsConfig moves = {.current_pose = false};
  const auto level = sample_agvs(moves, current, 1.0);
  const auto pitched = sample_agvs(moves, current, 1.0, kPitches);
  EXPECT_EQ(pitched.size(), 3 * (level.size() + 1) - 1);  // only the current pose is left out
  EXPECT_EQ(sample_agvs({}, current, 1.0, kPitches).size(), 3 * 81U);
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
  const auto none = sample_agvs(moves, {Vec3(1, 2, 3), 0.3}, 1.0, std::array{0.0});
  ASSERT_EQ(none.size(), level.size());
  for (std::size_t i = 0; i < none.size(); ++i) EXPECT_EQ(none[i].yaw_rad, level[i].yaw_rad);
}

TEST(Gimbal, AnotherPitchIsAnotherView) {
  const PlannerModel model({}, {}, Box3(Vec3(-5, -5, 0), Vec3(5, 5, 5)), std::array{on_gimbal()},
                           {});
  Belief belief(model);
  clear(belief.grid, voxels_where(belief.grid, everywhere));
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

// Baselines that lay all views around the profile at once.

const Box3 kRoutesIn(Vec3(-12, -12, 0), Vec3(12, 12, 12));

/// A box of 4 x 2 x 3 m on the ground around the origin.
OccupancyGrid box_in_the_middle() {
  OccupancyGrid grid(OccupancyConfig{}, kRoutesIn);
  fill(grid, Box3(Vec3(-2, -1, 0), Vec3(2, 1, 3)));
  return grid;
}

PlannerModel planner_model() {
  const CameraConfig camera;
  return {{}, {.z_min_m = 0.0}, kRoutesIn, {&camera, 1}, {}};
}

const ViewPose kStart{Vec3(0, -12, 2), 0};

std::vector<ViewPose> route(decltype(&lay_hemisphere) lay, const OccupancyGrid& grid) {
  return lay({}, planner_model(), grid, kStart, 100);
}

TEST(UniformHemisphere, StandsAtTheStandoffAllAroundLooksInwardsAndGoesToTheNearestLeft) {
  const auto views = route(lay_hemisphere, box_in_the_middle());
  ASSERT_EQ(views.size(), 100U);
  std::array<int, 4> by_quadrant = {0, 0, 0, 0};
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Vec3& p_m = views[i].p_world_m;
    EXPECT_TRUE(kRoutesIn.contains(p_m));
    // voxel centres stand for voxels: within half a voxel's diagonal of the standoff
    EXPECT_NEAR(Box3(Vec3(-2, -1, 0), Vec3(2, 1, 3)).exteriorDistance(p_m), 4.0, 0.18);
    EXPECT_LE(T_world_body(views[i]).linear().col(0).dot(p_m), 0.0);
    ++by_quadrant[(p_m.x() > 0 ? 1U : 0U) + (p_m.y() > 0 ? 2U : 0U)];
    for (std::size_t j = i + 2; j < views.size(); ++j) {
      EXPECT_GE((views[j].p_world_m - p_m).norm(), (views[i + 1].p_world_m - p_m).norm() - 1e-12);
    }
  }
  for (const int count : by_quadrant) EXPECT_NEAR(count, 25, 4);
}

TEST(Lawnmower, PassesEverySideInRowsThatOverlap) {
  const auto views = route(lay_lawnmower, box_in_the_middle());
  // footprints at 4 m: 4.62 x 3.31 m, less 30 %
  const double column_m = 0.7 * 8.0 * std::tan(deg_to_rad(30.0));
  const double row_m = 0.7 * 8.0 * std::tan(deg_to_rad(22.5));
  for (const Vec3& side : {Vec3(0, -5, 0), Vec3(6, 0, 0), Vec3(0, 5, 0), Vec3(-6, 0, 0)}) {
    const Vec3 outwards = side.normalized();
    int on_side = 0;
    for (const ViewPose& view : views) {
      const Vec3 forward = T_world_body(view).linear().col(0);
      if (forward.dot(outwards) > -0.999) continue;
      if (std::abs(view.p_world_m.dot(outwards) - side.norm()) > 0.2) continue;
      ++on_side;
    }
    const double width_m = 2.0 * std::abs(side.cross(Vec3::UnitZ()).norm() > 5.5 ? 5.0 : 6.0);
    EXPECT_GE(on_side, static_cast<int>(width_m / column_m) * static_cast<int>(3.0 / row_m));
  }
  // from view to view it flies a column or a row, but where one side ends and the next begins
  int jumps = 0;
  for (std::size_t i = 1; i < views.size(); ++i) {
    jumps += (views[i].p_world_m - views[i - 1].p_world_m).norm() > column_m + 1e-9 ? 1 : 0;
  }
  EXPECT_LE(jumps, 4);
}

TEST(Lawnmower, LaysNoMoreViewsThanAnybodyFliesAndNoneWithoutAProfile) {
  const OccupancyGrid grid = box_in_the_middle();
  const auto laid = [&](const RouteConfig& config) {
    return lay_lawnmower(config, planner_model(), grid, kStart, 0).size();
  };
  EXPECT_THROW(laid({.standoff_m = 0.1, .overlap = 0.95}), BadInput);
  EXPECT_LT(laid({.standoff_m = 1.0, .overlap = 0.5}), std::size_t{kMostLaidViews});
  const OccupancyGrid nothing(OccupancyConfig{}, kRoutesIn);
  EXPECT_TRUE(route(lay_lawnmower, nothing).empty());
  EXPECT_TRUE(route(lay_hemisphere, nothing).empty());
}

// Which view of space that nobody has seen is worth a look.

TEST(MostUnseen, LooksAtUnknownSpaceTheNearerTheBetter) {
  const CameraConfig camera;
  const PlannerModel model({}, {}, Box3(Vec3(-16, -8, 0), Vec3(16, 8, 8)), {&camera, 1}, {});
  const Vec3 at_m(-4, 0, 4);
  const std::vector<TourView> views = {{1, {at_m, kPi}}, {2, {at_m, 0.0}}, {3, {at_m, 0.0}}};
  Scratch scratch(model, 3);
  Belief belief(model);
  clear(belief.grid, voxels_where(belief.grid, [](const Vec3& p_m) { return p_m.x() < 0.0; }));
  const std::vector<double> near_m = {0.0, 5.0, 2.0}, same_m = {0.0, 2.0, 2.0};
  EXPECT_EQ(most_unseen(model, belief, views, near_m, scratch), 2U);
  EXPECT_EQ(most_unseen(model, belief, views, same_m, scratch), 1U) << "the first of equals";
  EXPECT_EQ(most_unseen(model, belief, {{views[0]}}, {near_m.data(), 1}, scratch), std::nullopt);
  clear(belief.grid, voxels_where(belief.grid, everywhere));
  EXPECT_EQ(most_unseen(model, belief, views, near_m, scratch), std::nullopt);
}

}  // namespace
}  // namespace gnbv
