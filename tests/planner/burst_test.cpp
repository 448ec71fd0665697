// Bursts: views that cover a cluster, flown one after the other (section 2.4 and the paper's code).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/core/error.hpp"
#include "tests/planner/map/random_points.hpp"
#include "tests/planner/wall_world.hpp"

namespace gnbv {
namespace {

/// The planner of bursts that find no view out of bounds but where a test says so.
SmallPlanner burst_planner(const std::function<void(PlannerConfig&)>& change = {}) {
  return SmallPlanner([&](PlannerConfig& c) {
    c.fvs.mode = FvsMode::burst;
    c.fvs.frontier.linking = FrontierLinking::face;
    if (change) change(c);
  });
}

/// Free space, and surface that was seen thinly: a point in each of the voxels.
Belief seen_thinly(const SmallPlanner& planner, const std::function<bool(const Vec3&)>& is_surface,
                   double jitter_m = 0.0) {
  Belief belief(planner.model());
  const GridGeometry& grid = belief.grid.geometry();
  Random random(7);
  ScanUpdate update;
  std::vector<Vec3f> points_m;
  for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) {
    const Vec3 center_m = grid.center_m(grid.key_at(v));
    if (!is_surface(center_m)) {
      update.free.push_back(v);
      continue;
    }
    update.occupied.push_back(v);
    const Vec3f off = random.point_in(Box3(Vec3::Constant(-1.0), Vec3::Constant(1.0)));
    points_m.push_back(center_m.cast<float>() + static_cast<float>(jitter_m) * off);
  }
  belief.grid.apply(update);
  belief.cloud.add(points_m, 0.02);
  return belief;
}

/// Patches of 3 x 3 voxels that face the x axis.
Belief patches(const SmallPlanner& planner, const std::vector<Vec3>& middles_m) {
  return seen_thinly(planner, [&](const Vec3& p_m) {
    return std::ranges::any_of(middles_m, [&](const Vec3& middle_m) {
      return ((p_m - middle_m).array().abs() < Eigen::Array3d(0.1, 0.3, 0.3)).all();
    });
  });
}

const std::vector<Vec3> kThreePatches = {{3.1, 0.1, 4.1}, {-3.1, 3.1, 3.1}, {0.1, -5.1, 5.1}};

/// A planner that keeps what its bursts leave behind.
struct Flown {
  explicit Flown(const SmallPlanner& small)
      : model(small.model()), scratch(model, 2), planner(make_planner(small.config, model)) {}

  Plan next(const Belief& belief, const History& history = still_history()) {
    return planner->next(belief, history, kCurrent, scratch);
  }

  PlannerModel model;
  Scratch scratch;
  std::unique_ptr<Planner> planner;
};

std::vector<ViewPose> views_of(const Plan& plan) {
  std::vector<ViewPose> views;
  for (const Decision& decision : plan.views) views.push_back(decision.view);
  return views;
}

void expect_same(const std::vector<ViewPose>& a, const std::vector<ViewPose>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(is_same_view(a[i], b[i])) << i;
}

/// Whether the straight line from one place to another crosses the voxel of 0.2 m.
bool crosses(const Vec3& from_m, const Vec3& to_m, const Vec3& center_m) {
  double enters = 0.0, leaves = 1.0;
  for (int a = 0; a < 3; ++a) {
    const double way_m = to_m[a] - from_m[a];
    const double one = (center_m[a] - 0.1 - from_m[a]) / way_m;
    const double other = (center_m[a] + 0.1 - from_m[a]) / way_m;
    enters = std::max(enters, std::min(one, other));
    leaves = std::min(leaves, std::max(one, other));
  }
  return enters < leaves;
}

/// A cluster covered by the rule as the header has it, with one camera: view by view, point by
/// point, and each point against all voxels.
struct ByForce {
  const PlannerModel& model;
  const FvsConfig& fvs;
  const Belief& belief;
  std::vector<Vec3> occupied_m = {};  // centres
  std::vector<ViewPose> kept = {};
  std::vector<int> covers = {};

  bool sees(const ViewPose& view, const Vec3& p_m) const {
    const CameraModel& camera = model.cameras.front();
    const Isometry T_world_camera = T_world_body(view) * camera.T_body_camera;
    const Vec3 p_camera_m = T_world_camera.inverse() * p_m;
    const CameraConfig& config = camera.config;
    if (p_camera_m.z() < config.range_min_m || p_camera_m.z() > config.range_max_m) return false;
    const Eigen::Vector2d pixel = pixel_of(camera, p_camera_m);
    if (pixel.minCoeff() < 0.0 || pixel.x() > config.width_px || pixel.y() > config.height_px) {
      return false;
    }
    const GridGeometry& grid = belief.grid.geometry();
    const Vec3 own_m = grid.center_m(grid.key_of(p_m));
    return std::ranges::none_of(occupied_m, [&](const Vec3& center_m) {
      return center_m != own_m && crosses(T_world_camera.translation(), own_m, center_m);
    });
  }

  void cover(const FrontierCluster& cluster) {
    std::vector<Vec3> left_m;
    for (const Vec3f& p_m : belief.cloud.points_world_m()) {
      const Vec3 at_m = p_m.cast<double>();
      if ((at_m - cluster.centroid_world_m).norm() <= fvs.radius_m - 1.0) left_m.push_back(at_m);
    }
    double share = 0.0;
    for (int k = 0; k < fvs.views_per_layer && share < fvs.share_to_cover && !left_m.empty(); ++k) {
      const double bearing_rad = 2.0 * kPi * k / fvs.views_per_layer;
      std::size_t most = 0;
      std::optional<ViewPose> best;
      for (const double up_m : {-1.0, 0.0, 1.0}) {
        const Vec3 out_m(fvs.radius_m * std::cos(bearing_rad), fvs.radius_m * std::sin(bearing_rad),
                         up_m);
        const ViewPose view{cluster.centroid_world_m + out_m, wrap_angle_rad(bearing_rad + kPi)};
        const ViewPose from = kept.empty() ? kCurrent : kept.back();
        ViewChecker checker(model.validity, model.navigation_m, model.no_fly, belief.grid, {},
                            from);
        if (checker.check(view).rejected) continue;
        if (cluster_rejection(model.cameras, belief.grid, cluster, view, false)) continue;
        const auto seen = static_cast<std::size_t>(
            std::ranges::count_if(left_m, [&](const Vec3& p_m) { return sees(view, p_m); }));
        if (best && seen <= most) continue;
        if (fvs.keeps_blind && seen == 0) {
          kept.push_back(view);
          covers.push_back(0);
          continue;
        }
        best = view;
        most = seen;
      }
      share = static_cast<double>(most) / static_cast<double>(left_m.size());
      if (!best) continue;
      kept.push_back(*best);
      covers.push_back(static_cast<int>(most));
      std::erase_if(left_m, [&](const Vec3& p_m) { return sees(*best, p_m); });
    }
  }
};

TEST(Burst, CoversItsClustersAsTheRuleDoesByForce) {
  std::size_t views = 0;
  for (const double share : {0.2, 0.5, 0.8, 1.0}) {
    const SmallPlanner small = burst_planner([&](PlannerConfig& c) {
      c.fvs.share_to_cover = share;
      c.fvs.keeps_blind = share > 0.6;
      c.fvs.views_per_layer = 7;  // bearings along which no ray runs into a voxel's edge
      c.fvs.clusters = 3;
    });
    Random random(static_cast<std::uint64_t>(10 * share));
    const Belief belief = seen_thinly(
        small,
        [&](const Vec3& p_m) {
          return Box3(Vec3(2, -1, 3), Vec3(4, 1, 5)).contains(p_m) && random.chance(0.25);
        },
        0.08);
    const Plan plan = Flown(small).next(belief);
    ASSERT_EQ(plan.clusters.size(), 3U);
    const PlannerModel model = small.model();
    ByForce force{model, small.config.fvs, belief};
    for (const VoxelIndex v : voxels_where(belief.grid, [&](const Vec3& p_m) {
           return belief.grid.state_at(p_m) == VoxelState::occupied;
         })) {
      force.occupied_m.push_back(belief.grid.geometry().center_m(belief.grid.geometry().key_at(v)));
    }
    for (const FrontierCluster& cluster : plan.clusters) force.cover(cluster);
    expect_same(views_of(plan), force.kept);
    for (std::size_t i = 0; i < plan.chosen.size(); ++i) {
      EXPECT_EQ(plan.candidates[plan.chosen[i]].covers, force.covers.at(i)) << share << ' ' << i;
    }
    views += force.kept.size();
  }
  EXPECT_GT(views, 12U);
}

TEST(Burst, IsFlownFromTheNearestClusterOnWithoutAnyDecisionWhateverTheMapBecomes) {
  const SmallPlanner small = burst_planner([](PlannerConfig& c) { c.fvs.clusters = 2; });
  Belief belief = patches(small, kThreePatches);
  const Plan whole = Flown(small).next(belief);
  ASSERT_GT(whole.views.size(), 1U);
  Flown flown(small);
  History history = still_history();
  int decisions = 0;
  int number = 0;
  for (const Decision& expected : whole.views) {
    const auto next = next_decision(small.config.termination, kCurrent, history, [&] {
      ++decisions;
      return flown.next(belief, history);
    });
    EXPECT_TRUE(is_same_view(std::get<Decision>(next).view, expected.view));
    EXPECT_EQ(std::get<Decision>(next).plan_view, ++number);
    clear(belief.grid, voxels_where(belief.grid, everywhere));
    hit(belief.grid, {voxel_at(belief.grid, whole.views.back().view.p_world_m)});
  }
  EXPECT_EQ(decisions, 1);
  EXPECT_TRUE(history.ahead.empty());
  ASSERT_EQ(whole.clusters.size(), 2U);
  EXPECT_NEAR(whole.clusters[0].centroid_world_m.x(), 3.1, 0.1);   // 3.0 m away
  EXPECT_NEAR(whole.clusters[1].centroid_world_m.x(), -3.1, 0.1);  // 4.5 m, before 5.3 m
}

TEST(Burst, IsTheSameWhateverAUtilityThinksOfItsViews) {
  std::vector<ViewPose> views;
  for (const std::string_view name : utility_names()) {
    for (const HitVoxel hit :
         {HitVoxel::counted, HitVoxel::excluded}) {  // excluded: some are refused
      const SmallPlanner small = burst_planner([&](PlannerConfig& c) {
        c.fvs.clusters = 3;
        c.utility.name = name;
        c.utility.hit_voxel = hit;
      });
      const Plan plan = Flown(small).next(patches(small, kThreePatches));
      if (views.empty()) views = views_of(plan);
      expect_same(views_of(plan), views);
      for (const std::size_t kept : plan.chosen) EXPECT_FALSE(plan.candidates[kept].rejected);
    }
  }
  EXPECT_GT(views.size(), 3U);
}

TEST(Burst, NeverComesBackToAClusterWhateverCameOfIt) {
  for (const double radius_m : {2.5, 30.0}) {  // of 30 m, all views are out of the workspace
    const SmallPlanner small = burst_planner([&](PlannerConfig& c) { c.fvs.radius_m = radius_m; });
    const Belief belief = patches(small, kThreePatches);
    Flown flown(small);
    std::set<VoxelIndex> tried;
    for (int burst = 0; burst < 3; ++burst) {
      const Plan plan = flown.next(belief);
      EXPECT_EQ(plan.next().sampler, radius_m == 2.5 ? Sampler::fvs : Sampler::agvs);
      ASSERT_EQ(plan.clusters.size(), 1U);
      EXPECT_EQ(plan.frontier.size(), 27U - tried.size()) << "what is ignored is no frontier";
      for (const VoxelIndex v : plan.clusters.front().voxels) EXPECT_TRUE(tried.insert(v).second);
    }
    EXPECT_EQ(tried.size(), 27U);
    const Plan none_left = flown.next(belief);
    EXPECT_EQ(none_left.next().sampler, Sampler::agvs);
    EXPECT_TRUE(none_left.clusters.empty());
  }
}

TEST(Burst, GoesOnAsItWouldHaveAfterEachOfItsViews) {
  const SmallPlanner small = burst_planner();
  const Belief belief = patches(small, kThreePatches);
  Flown whole(small);
  const Plan first = whole.next(belief);
  const Plan second = whole.next(belief);
  ASSERT_GT(first.views.size(), 1U);
  for (std::size_t count = 1; count <= first.views.size(); ++count) {
    Flown resumed(small);
    std::vector<Decision> recorded(first.views.begin(), first.views.begin() + count);
    const auto replay = [&] {
      return resumed.planner->replay(recorded, belief, still_history(), kCurrent, resumed.scratch);
    };
    const Plan again = replay();
    expect_same(views_of(again), views_of(first));
    for (std::size_t i = 0; i < first.views.size(); ++i) {
      EXPECT_EQ(again.views[i].score.value, first.views[i].score.value);
    }
    expect_same(views_of(resumed.next(belief)), views_of(second));
    recorded.back().view.yaw_rad += 0.1;
    EXPECT_THROW(replay(), BadInput);
  }
}

TEST(Burst, GivesWayToTheGridOrEndsTheMissionWhereNoViewIsValid) {
  for (const bool goes_on : {true, false}) {
    const SmallPlanner small = burst_planner([&](PlannerConfig& c) {
      c.fvs.radius_m = 30.0;
      c.fvs.agvs_when_stuck = goes_on;
    });
    const Plan plan = Flown(small).next(patches(small, kThreePatches));
    EXPECT_EQ(plan.has_view(), goes_on);
    EXPECT_EQ(plan.end, Termination::no_valid_view);
    EXPECT_EQ(plan.candidates.front().rejected, Rejection::out_of_bounds);
  }
}

TEST(Burst, WithoutPointsAroundItsClusterHasNoView) {
  // views 1 m from the axis: no point is asked for
  const SmallPlanner small = burst_planner([](PlannerConfig& c) { c.fvs.radius_m = 1.0; });
  const Plan plan = Flown(small).next(patches(small, {{3.1, 0.1, 4.1}, {3.1, 0.7, 4.1}}));
  EXPECT_EQ(plan.clusters.size(), 1U);
  EXPECT_EQ(plan.next().sampler, Sampler::agvs);
}

TEST(Burst, ThatNobodySeesAnythingFromIsFlownUnlessItHasToSee) {
  // around a closed box whose only points are in the middle
  for (const bool needs_sight : {false, true}) {
    const SmallPlanner small =
        burst_planner([&](PlannerConfig& c) { c.fvs.needs_visible_cluster = needs_sight; });
    const Vec3 middle_m(-3.1, 0.1, 4.1);
    Belief belief = patches(small, {middle_m});
    fill(belief.grid, Box3(middle_m.array() - 0.7, middle_m.array() + 0.7));
    const Plan plan = Flown(small).next(belief);
    ASSERT_EQ(plan.clusters.size(), 1U);
    EXPECT_EQ(plan.next().sampler, needs_sight ? Sampler::agvs : Sampler::fvs);
    for (const std::size_t kept : plan.chosen)
      EXPECT_EQ(plan.candidates[kept].covers.value_or(0), 0);
  }
}

TEST(Burst, IsTriedAgainAsOftenAsTheMissionMay) {
  // only the farthest cluster has a view: of the others all are below the navigation box
  const std::vector<Vec3> some = {{0.1, 2.1, 0.3}, {0.1, -2.1, 0.3}, {-5.1, 0.1, 4.1}};
  struct Case {
    int retries, growth;
    std::size_t clusters;
    Sampler sampler;
  };
  for (const auto& [retries, growth, clusters, sampler] :
       std::vector<Case>{{0, 0, 1, Sampler::agvs},
                         {1, 0, 2, Sampler::agvs},
                         {2, 0, 3, Sampler::fvs},
                         {1, 1, 3, Sampler::fvs}}) {
    const SmallPlanner small = burst_planner([&](PlannerConfig& c) {
      c.validity.z_min_m = 2.0;
      c.fvs.retries = retries;
      c.fvs.clusters_growth = growth;
    });
    const Belief belief = patches(small, some);
    Flown flown(small);
    const Plan plan = flown.next(belief);
    EXPECT_EQ(plan.clusters.size(), clusters);
    EXPECT_EQ(plan.next().sampler, sampler);
    // none is given back
    EXPECT_EQ(flown.next(belief).clusters.size(), std::min<std::size_t>(3 - clusters, 1));
  }
}

TEST(Culling, SeesByTheMapOrByTheFront) {
  const SmallPlanner small = burst_planner();
  // a patch, and one 0.6 m behind it
  const Belief belief = patches(small, {{3.1, 0.1, 4.1}, {3.7, 0.1, 4.1}});
  const PlannerModel model = small.model();
  const auto points_m = belief.cloud.points_world_m();
  const auto seen_by = [&](Culling culling) {
    const auto seen = points_in_sight(culling, model.cameras, belief.grid, kCurrent, points_m);
    std::array<int, 2> counts = {0, 0};
    for (std::size_t i = 0; i < points_m.size(); ++i) counts[points_m[i].x() > 3.4F] += seen[i];
    return counts;
  };
  EXPECT_EQ(seen_by(Culling::front), (std::array{9, 0}));
  const auto by_map = seen_by(Culling::map);
  EXPECT_EQ(by_map[0], 9);
  EXPECT_EQ(by_map[1], 0) << "all of it is in the shadow of the nearer one";
}

}  // namespace
}  // namespace gnbv
