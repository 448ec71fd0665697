// Laws of the tour's planner as a whole, before a wall that was scanned thinly.
#include "planner/tour/tour_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "planner/core/belief.hpp"
#include "planner/tour/gains.hpp"
#include "planner/tour/tour_state.hpp"
#include "planner/tour/visibility_cache.hpp"
#include "tests/planner/map/drawn_map.hpp"
#include "tests/planner/wall_world.hpp"

namespace gnbv {
namespace {

struct TourWorld {
  explicit TourWorld(double range_max_m = 8.0, const Box3& workspace_m = kWorkspace) {
    cameras = {{.range_max_m = range_max_m}};
    planner.config.utility.name = "tour";
    workspace = workspace_m;
  }
  PlannerModel model(std::uint64_t seed) const {
    return make_model(planner.config, workspace, cameras, {}, seed);
  }
  SmallPlanner planner;
  std::vector<CameraConfig> cameras;
  Box3 workspace;
};

/// Where the first plan of that seed flies.
std::vector<ViewPose> first_tour(std::uint64_t seed) {
  const TourWorld world;
  const PlannerModel model = world.model(seed);
  const Belief belief = thin_wall_ahead(world.planner);
  Scratch scratch(model, 2);
  TourPlanner planner({.price = 0.01, .iterations = 20}, model,
                      true);  // long, and not yet the best
  const Plan plan = planner.next(belief, {}, kCurrent, scratch);
  return plan.tour->plan ? plan.tour->plan->views : std::vector<ViewPose>{};
}

bool are_same(const std::vector<ViewPose>& a, const std::vector<ViewPose>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), is_same_view);
}

TEST(TourPlanner, SearchesByTheMissionsSeed) {
  const std::vector<ViewPose> tour = first_tour(1);
  ASSERT_GE(tour.size(), 4U);
  EXPECT_TRUE(are_same(first_tour(1), tour));
  const std::array<std::uint64_t, 4> others = {2, 3, 4, 5};
  EXPECT_TRUE(std::any_of(others.begin(), others.end(),
                          [&](std::uint64_t seed) { return !are_same(first_tour(seed), tour); }));
}

/// Wherever the plan is, it ends when it asks next, and it asks hundreds of times.
TEST(TourPlanner, AsksOftenWhetherToStopWhereverItIs) {
  const TourWorld world;
  const PlannerModel model = world.model(1);
  const Belief belief = thin_wall_ahead(world.planner);
  std::atomic<int> polls = 0;
  const auto stop_at = [&](int poll) {
    Scratch scratch(model, 2);
    polls = 0;
    scratch.should_stop = [&polls, poll] { return ++polls >= poll; };
    TourPlanner planner({}, model, true);
    planner.next(belief, {}, kCurrent, scratch);
  };
  stop_at(1 << 30);
  const int all = polls;
  EXPECT_GT(all, 300) << "at each node, and in each round of the search";
  for (const int poll : {1, all / 3, 2 * all / 3, all}) {
    EXPECT_THROW(stop_at(poll), StopRequested) << poll << " of " << all;
  }
}

/// A shed whose open side faces the vehicle. Nothing of its walls pays at this price.
TEST(TourPlanner, BeforeItEndsItLooksIntoWhatItsSurfaceSurrounds) {
  const TourWorld world;
  const PlannerModel model = world.model(1);
  const Box3 outside_m(Vec3(0, -3, 0), Vec3(6, 3, 5));
  const Box3 inside_m(Vec3(-1, -2.6, 0), Vec3(5.6, 2.6, 4.6));
  const auto is_inside = [&](const Vec3& p_m) {
    return outside_m.contains(p_m) && inside_m.contains(p_m);
  };
  const auto first_plan = [&](const auto& is_unknown) {
    Belief belief(model);
    hit(belief.grid, voxels_where(belief.grid, [&](const Vec3& p_m) {
          return outside_m.contains(p_m) && !inside_m.contains(p_m);
        }));
    clear(belief.grid, voxels_where(belief.grid, [&](const Vec3& p_m) {
            return (!outside_m.contains(p_m) || inside_m.contains(p_m)) && !is_unknown(p_m);
          }));
    sample_thinly(belief);
    Scratch scratch(model, 2);
    TourPlanner planner({.explore = false, .price = 1e6, .end_price = 1.0}, model, false);
    return planner.next(belief, {}, {Vec3(-6.0, 0.1, 2.1), 0.0}, scratch);
  };
  const Plan look = first_plan(is_inside);
  ASSERT_TRUE(look.has_view());
  EXPECT_GT(std::cos(look.next().view.yaw_rad), 0.5) << "towards the shed";
  EXPECT_EQ(first_plan([](const Vec3&) { return false; }).end, Termination::tour_complete);
  const auto beyond = [](const Vec3& p_m) { return p_m.x() < -7.0 || p_m.z() > 6.0; };
  EXPECT_EQ(first_plan(beyond).end, Termination::tour_complete) << "the sky is not surrounded";
}

/// Cameras that see a metre far in a box of 100 m would have 700,000 nodes.
TEST(TourState, ALatticeOfItsOwnStepHasNoMoreNodesThanCanBePlannedOver) {
  for (const double range_m : {0.5, 1.0, 8.0}) {
    const TourWorld world(range_m);
    const Box3 box_m(Vec3(0, 0, 0.7), Vec3(100, 100, 15));
    const double step_m = automatic_step_m(world.model(0).cameras, box_m);
    const Roadmap roadmap({box_m, 0.2}, box_m, step_m);
    EXPECT_LE(roadmap.size(), kMostAutomaticNodes);
    EXPECT_GE(step_m, 0.25 * range_m);
  }
  const TourWorld world;
  EXPECT_EQ(automatic_step_m(world.model(0).cameras, Box3(Vec3(0, 0, 0), Vec3(40, 40, 10))), 2.0);
}

const Box3 kBox(Vec3(-8, -8, 0), Vec3(8, 8, 8));
constexpr double kRadius_m = 0.7;

struct World {
  explicit World(OccupancyGrid occupancy)
      : grid(std::move(occupancy)), space(grid.geometry(), kBox, {}, kRadius_m) {
    space.follow(grid);
  }
  std::vector<Vec3> nodes(const Patch& patch) const {
    return points_to_see({grid, space, cameras}, patch, 4);
  }
  OccupancyGrid grid;
  OpenSpace space;
  std::vector<CameraModel> cameras = {make_camera_model({})};
};

const Patch kFacingEast{
    .target_m = Vec3f(0.1F, 0.1F, 4.1F), .normal = Vec3f(1, 0, 0), .missing = 10.0F};

/// By the definition: before the patch, in a camera's image once the vehicle is turned to it.
TEST(SurfaceNodes, SeeThePatchFromBeforeItWithinTheImage) {
  const World world(free_grid(kBox, Box3(Vec3(-0.2, -0.6, 3.4), Vec3(0.2, 0.6, 4.8))));
  const std::vector<Vec3> nodes = world.nodes(kFacingEast);
  ASSERT_FALSE(nodes.empty());
  const CameraConfig& camera = world.cameras.front().config;
  for (const Vec3& p_m : nodes) {
    const Vec3 to_m = p_m - kFacingEast.target_m.cast<double>();
    EXPECT_GT(to_m.x(), 0.0);
    EXPECT_LE(std::fabs(std::atan2(to_m.z(), to_m.head<2>().norm())),
              0.5 * camera.fov_y_rad + 0.05);
    EXPECT_LE(to_m.norm(), camera.range_max_m);
    EXPECT_TRUE(world.space.is_open(world.grid, world.grid.geometry().key_of(p_m)));
  }
}

TEST(SurfaceNodes, AreNoneBehindAWallAndFoundOnceWhereSpaceOpens) {
  // nearer than any node may be
  World world(free_grid(kBox, Box3(Vec3(0.8, -8, 0), Vec3(1.2, 8, 8))));
  EXPECT_TRUE(world.nodes(kFacingEast).empty());
  const std::vector<Patch> patches = {kFacingEast};
  SearchedCubes searched;
  const auto found = [&](std::uint8_t is_seen) {
    return points_for_unseen({world.grid, world.space, world.cameras}, patches, {{is_seen}},
                             searched)
        .size();
  };
  EXPECT_EQ(found(0), 0U);
  world.grid = free_grid(kBox);
  world.space.follow(world.grid);
  EXPECT_EQ(found(1), 0U);
  EXPECT_EQ(found(0), 2U) << "what was searched for in vain is searched for again";
  EXPECT_EQ(found(0), 0U) << "found before";
}

// Laws of what a plan says it is for: nothing that can be expected is lost or moved.

Patch patch_at(const Vec3f& p_m, float missing, PatchSource source = PatchSource::sampled) {
  return {.target_m = p_m, .normal = Vec3f::UnitZ(), .missing = missing, .source = source};
}

TEST(TourPlan, GathersBySourceAndPlaceWhatCanBeExpected) {
  const ObservationYield yield;
  const std::vector<Patch> patches = {patch_at({0.1F, 0.1F, 0.1F}, 30.0F),
                                      patch_at({0.2F, 0.1F, 0.1F}, 10.0F),
                                      patch_at({-0.1F, 0.1F, 0.1F}, 20.0F),
                                      patch_at({0.2F, 0.2F, 0.2F}, 8.0F, PatchSource::boundary),
                                      patch_at({9.0F, 9.0F, 9.0F}, 0.0F)};
  const TourPlan plan = make_tour_plan({}, patches, yield);
  EXPECT_EQ(plan.cube_m, kLeastCube_m);
  ASSERT_EQ(plan.cubes.size(), 3U);
  const double share = yield.share(patches[0], {});
  EXPECT_EQ(plan.cubes[0].source, PatchSource::sampled);
  EXPECT_NEAR(plan.cubes[0].p_world_m.x(), -0.1, 1e-6);  // below 0 is another cube
  EXPECT_NEAR(plan.cubes[0].expected, 20.0 * share, 1e-5);
  EXPECT_NEAR(plan.cubes[1].p_world_m.x(), (30.0 * 0.1 + 10.0 * 0.2) / 40.0, 1e-6);
  EXPECT_NEAR(plan.cubes[1].expected, 40.0 * share, 1e-5);
  EXPECT_EQ(plan.cubes[2].source, PatchSource::boundary);
  EXPECT_NEAR(plan.cubes[2].expected, 8.0 * yield.share(patches[3], {}), 1e-5);
}

TEST(TourPlan, CubesGrowUntilTheyAreFew) {
  std::vector<Patch> patches;
  double expected = 0.0;
  const ObservationYield yield;
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 100; ++j) {
      patches.push_back(
          patch_at(Vec3f(0.5F * static_cast<float>(i), 0.5F * static_cast<float>(j), 0.0F) +
                       Vec3f::Constant(0.25F),
                   4.0F));
      expected += static_cast<double>(4.0F * yield.share(patches.back(), {}));
    }
  }
  const TourPlan plan = make_tour_plan({}, patches, yield);
  EXPECT_EQ(plan.cube_m, 1.0);
  EXPECT_EQ(plan.cubes.size(), 2500U);
  double sum = 0.0;
  for (const PatchCube& cube : plan.cubes) sum += cube.expected;
  EXPECT_NEAR(sum, expected, 1e-6 * expected);
}

TEST(VisibilityCache, AFrameSeesWhatTheViewSeesThatItWasTakenFrom) {
  const TourWorld world;
  const PlannerModel model = world.model(1);
  const Belief belief = thin_wall_ahead(world.planner);
  TourState state({}, model);
  state.cells.add(belief.cloud.points_world_m(), belief.grid, 1);
  state.patches = find_patches(state.cells, belief.grid, 1);
  const TourScene scene{world.planner.config.tour, state.cells, state.patches};
  for (const double yaw_rad : {0.0, 0.5, -0.7}) {
    const ViewPose view{kCurrent.p_world_m, yaw_rad};
    const FramePose frame = {0, T_world_body(view) * model.cameras[0].T_body_camera};
    const auto by_view = state.visibility.observe(scene, view, 1);
    const auto by_frame = state.visibility.observe(scene, {&frame, 1}, 2);
    ASSERT_GT(by_view.size(), 50U);
    ASSERT_EQ(by_frame.size(), by_view.size());
    for (std::size_t i = 0; i < by_view.size(); ++i) {
      EXPECT_EQ(by_frame[i].patch, by_view[i].patch);
      EXPECT_EQ(by_frame[i].incidence, by_view[i].incidence);
    }
    const std::vector<FramePose> twice = {frame, frame};
    EXPECT_EQ(state.visibility.observe(scene, twice, 2).size(), by_view.size());
  }
}

TEST(VisibilityCache, TheHeadingNearAPoseIsTheOneItDiffersFromTheLeast) {
  const TourWorld world;
  const PlannerModel model = world.model(1);
  const TourState state({}, model);
  for (int heading = 0; heading < state.visibility.headings(); ++heading) {
    ViewPose pose = state.visibility.pose(kCurrent.p_world_m, heading);
    for (const double off_rad : {0.0, deg_to_rad(22.0), -deg_to_rad(22.0), 2.0 * kPi}) {
      pose.yaw_rad = state.visibility.pose(kCurrent.p_world_m, heading).yaw_rad + off_rad;
      EXPECT_EQ(state.visibility.heading_near(pose), heading) << off_rad;
    }
  }
}

}  // namespace
}  // namespace gnbv
