// The decision as a whole: which view, at which scale, and when there is none.
#include "planner/next_view.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gnbv {
namespace {

const Box3 kWorkspace(Vec3(-8, -8, 0), Vec3(8, 8, 8));
const ViewPose kCurrent{Vec3(0.1, 0.1, 4.1), 0.0};

PlannerModel small_model() {
  PlannerConfig config;
  config.validity.collision_radius_m = 0.5;
  const CameraModel camera = make_camera_model({});
  return PlannerModel(config, kWorkspace, {&camera, 1}, {});
}

/// A wall at x = 6, all else free where `is_known` says so and unmeasured elsewhere.
template <typename IsKnown>
Belief wall_ahead(const PlannerModel& model, const IsKnown& is_known) {
  Belief belief(model);
  const GridGeometry& grid = belief.grid.geometry();
  ScanUpdate update;
  for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) {
    const Vec3 center_m = grid.center_m(grid.key_at(v));
    if (std::fabs(center_m.x() - 6.1) < 0.05) {
      update.occupied.push_back(v);
    } else if (is_known(center_m)) {
      update.free.push_back(v);
    }
  }
  belief.grid.apply(update);
  return belief;
}

bool everywhere(const Vec3&) { return true; }

std::optional<Decision> plan(const PlannerModel& model, const Belief& belief,
                             const History& history = {}, int threads = 2) {
  Workbench bench(model, threads);
  return plan_next_view(model, belief, history, kCurrent, bench).next;
}

TEST(PlanNextView, FindsNothingInAnUnknownWorld) {
  const PlannerModel model = small_model();
  EXPECT_FALSE(plan(model, Belief(model)));
}

TEST(PlanNextView, FindsNothingWhereNoSurfaceIsInSight) {
  const PlannerModel model = small_model();
  Belief belief(model);
  ScanUpdate update;
  for (VoxelIndex v = 0; v < belief.grid.geometry().voxel_count(); ++v) update.free.push_back(v);
  belief.grid.apply(update);
  EXPECT_FALSE(plan(model, belief));
}

TEST(PlanNextView, ChoosesTheHighestUtilityAndTheFirstOfEquals) {
  const PlannerModel model = small_model();
  const Belief belief = wall_ahead(model, everywhere);
  const std::optional<Decision> decision = plan(model, belief);
  ASSERT_TRUE(decision);
  // the same search, written out
  VisitMarks marks(belief.grid.geometry().voxel_count());
  std::optional<ViewPose> best;
  double best_value = 0.0;
  for (const ViewPose& view : sample_agvs(model.config.agvs, kCurrent, 1.0)) {
    if (rejection(model.config.validity, model.navigation_m, belief.grid, {}, kCurrent, view)) {
      continue;
    }
    ViewStats stats = evaluate_view(belief.grid, belief.cloud, model.view_rays, view, marks);
    stats.density_max = belief.cloud.density_max();
    stats.path_m = (view.p_world_m - kCurrent.p_world_m).norm();
    const auto utility = score(model.config.utility, stats);
    if (!utility || (best && utility->value <= best_value)) continue;
    best = view;
    best_value = utility->value;
  }
  ASSERT_TRUE(best);
  EXPECT_EQ(decision->view.p_world_m, best->p_world_m);
  EXPECT_EQ(decision->view.yaw_rad, best->yaw_rad);
  EXPECT_EQ(decision->score.value, best_value);
  EXPECT_EQ(decision->scale, 1.0);
}

TEST(PlanNextView, DoesNotDependOnTheNumberOfThreads) {
  const PlannerModel model = small_model();
  const Belief belief = wall_ahead(model, everywhere);
  const std::optional<Decision> one = plan(model, belief, {}, 1);
  for (const int threads : {2, 5}) {
    const std::optional<Decision> many = plan(model, belief, {}, threads);
    EXPECT_EQ(many->view.p_world_m, one->view.p_world_m);
    EXPECT_EQ(many->view.yaw_rad, one->view.yaw_rad);
    EXPECT_EQ(many->score.value, one->score.value);
  }
}

TEST(PlanNextView, TakesLargerStepsWhereNoneNearbyIsValid) {
  const PlannerModel model = small_model();
  // unmeasured within 2 m: all of scale 1 (at most sqrt 3 m) and none of the corners of scale 1.5
  const Belief belief =
      wall_ahead(model, [](const Vec3& p_m) { return (p_m - kCurrent.p_world_m).norm() > 2.0; });
  const std::optional<Decision> decision = plan(model, belief);
  ASSERT_TRUE(decision);
  EXPECT_EQ(decision->scale, 1.5);
}

TEST(PlanNextView, TriesTheFinestGridBeforeGivingUp) {
  const PlannerModel model = small_model();
  // known within 2 m only, so that no view of the larger scales is valid
  const Belief belief =
      wall_ahead(model, [](const Vec3& p_m) { return (p_m - kCurrent.p_world_m).norm() < 2.0; });
  History history;
  history.decisions.assign(3, {.view = {Vec3(3, 3, 3), 0}, .sampler = "agvs", .scale = 3.0});
  const std::optional<Decision> decision = plan(model, belief, history);
  ASSERT_TRUE(decision);
  EXPECT_EQ(decision->scale, 1.0);
}

TEST(PlanNextView, TheStartIsNoUtilityToLearnFrom) {
  const PlannerModel model = small_model();
  const Belief belief = wall_ahead(model, everywhere);
  History history;
  history.decisions.assign(3, {.view = {Vec3(3, 3, 3), 0}, .sampler = "start"});
  EXPECT_EQ(plan(model, belief, history)->scale, 1.0);
  history.decisions.assign(3, {.view = {Vec3(3, 3, 3), 0}, .sampler = "agvs"});
  EXPECT_EQ(plan(model, belief, history)->scale, 1.5);
}

TEST(RememberEntropy, StartsWithTheFirstDepthReturn) {
  const PlannerModel model = small_model();
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

}  // namespace
}  // namespace gnbv
