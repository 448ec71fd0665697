// AGVS and FVS candidates, and local minima: all pure functions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/config.hpp"
#include "planner/guided/view_sampling.hpp"
#include "planner/map/frontiers.hpp"
#include "sensors/camera_model.hpp"
#include "tests/planner/map/drawn_map.hpp"

namespace gnbv {
namespace {

TEST(Agvs, OffersTheGridOfThePaperScaledAndOfWhereItIsWhatTheSwitchesSay) {
  const ViewPose current{Vec3(1, 2, 3), 0.3};
  struct Case {
    AgvsConfig config;
    double scale;
    int turns, stays;  // views here with another yaw, and with this one
  };
  for (const auto& [config, scale, turns, stays] :
       std::vector<Case>{{{}, 1.0, 2, 1},
                         {{}, 1.5, 2, 0},
                         {{.current_pose = false}, 1.0, 2, 0},
                         {{.rotation_at_all_scales = false}, 1.0, 2, 1},
                         {{.rotation_at_all_scales = false}, 1.5, 0, 0},
                         {{.rotation_only = false}, 1.0, 0, 0}}) {
    double farthest_m = 0.0;
    int elsewhere = 0, turned = 0, stayed = 0;
    for (const ViewPose& view : sample_agvs(config, current, scale)) {
      const double offset_m = (view.p_world_m - current.p_world_m).norm();
      farthest_m = std::max(farthest_m, offset_m);
      ++(offset_m > 1e-9 ? elsewhere : is_same_view(view, current) ? stayed : turned);
    }
    EXPECT_EQ(elsewhere, 26 * 3);  // 3 x 3 x 3 positions, 3 yaws
    EXPECT_EQ(turned, turns);
    EXPECT_EQ(stayed, stays);
    EXPECT_NEAR(farthest_m, scale * std::sqrt(3.0), 1e-12);
  }
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

/// Of a mission that chose views of these utilities, the last one at that scale.
History with_utilities(const std::vector<double>& utilities, double last_scale) {
  History history;
  for (const double utility : utilities) {
    history.decisions.push_back({.view = {Vec3(utility, 0, 5), 0},
                                 .sampler = Sampler::agvs,
                                 .scale = last_scale,
                                 .score = {.value = utility}});
  }
  return history;
}

TEST(Agvs, ScaleGrowsWhenUtilityIsLowAndUpToItsLimitIfAtAll) {
  AgvsConfig config;
  const auto scale = [&](const std::vector<double>& utilities, double last_scale) {
    return next_agvs_scale(config, with_utilities(utilities, last_scale), 1.0);
  };
  EXPECT_EQ(scale({0.5, 0.05, 0.02, 0.09}, 1.0), 1.5);
  EXPECT_EQ(scale({0.5, 0.05, 0.02, 0.09}, 6.0), 7.5);
  EXPECT_EQ(scale({0.01, 0.02, 0.3}, 6.0), 1.0);
  EXPECT_EQ(scale({0.01, 0.3, 0.02, 0.03}, 6.0), 1.0);
  EXPECT_EQ(scale({0.0, 0.0}, 1.0), 1.0);
  config.scales = false;
  EXPECT_EQ(scale({0.0, 0.0, 0.0}, 3.0), 1.0);
}

TEST(Agvs, ScaleGrowsWhenEntropyStandsStill) {
  AgvsConfig config{.entropy_threshold_nat = 0.001, .entropy_window = 3};
  // of 1000 voxels: still below 1 nat a view, up or down
  const std::vector<double> still = {900, 500, 499.5, 500.2, 500.1};
  const std::vector<double> moving = {500, 499.5, 498, 498.1};
  const auto scale = [&](const std::vector<double>& entropies_nat) {
    return next_agvs_scale(config, {.entropies_nat = entropies_nat}, 1000.0);
  };
  EXPECT_EQ(scale(still), 1.5);
  EXPECT_EQ(scale(moving), 1.0);
  EXPECT_EQ(scale({500, 500, 500}), 1.0);  // no full window yet
  config.entropy_threshold_nat = 0.0;
  EXPECT_EQ(scale(still), 1.0);
}

/// Views from those positions.
std::vector<Decision> at(const std::vector<Vec3>& positions_m) {
  std::vector<Decision> decisions;
  for (const Vec3& p_m : positions_m) decisions.push_back({.view = {p_m, 0.0}});
  return decisions;
}

TEST(Agvs, ScaleGrowsWhenItGoesBackAndForth) {
  const AgvsConfig config = {.repeated_by = RepeatedBy::places};  // four moves
  const Vec3 a(0, 0, 5);
  const Vec3 b(1, 0, 5);
  const auto scale = [&](const std::vector<Vec3>& positions_m) {
    return next_agvs_scale(config, {.decisions = at(positions_m)}, 1.0);
  };
  EXPECT_EQ(scale({a, b, a, b, a, b}), 1.5);
  EXPECT_EQ(scale({b, a, b, a, b}), 1.0);  // three moves undone, not four
  EXPECT_EQ(scale({a, b, a, b, Vec3(1, 1, 5), b}), 1.0);
  EXPECT_EQ(scale({a, a, a, a, a, a}), 1.0);  // turning on the spot is no motion
}

TEST(Fvs, StandsOnThreeLayersOfACylinderFacingItsAxis) {
  const FvsConfig config;
  const Vec3 centroid(3, -2, 6);
  const auto views = sample_fvs(config, centroid);
  ASSERT_EQ(views.size(), 12U);
  std::array<int, 3> by_layer = {0, 0, 0};
  for (const ViewPose& view : views) {
    const Vec3 offset = view.p_world_m - centroid;
    EXPECT_NEAR(offset.head<2>().norm(), 2.5, 1e-12);
    ++by_layer.at(static_cast<std::size_t>(std::lround(offset.z()) + 1));
    const Vec3 forward = T_world_body(view).linear().col(0);
    EXPECT_NEAR(forward.head<2>().dot(-offset.head<2>().normalized()), 1.0, 1e-12);
  }
  EXPECT_EQ(by_layer, (std::array<int, 3>{4, 4, 4}));
  // the authors come around to the first bearing again
  FvsConfig authors;
  authors.first_bearing_twice = true;
  authors.views_per_layer = 8;
  const auto theirs = sample_fvs(authors, centroid);
  ASSERT_EQ(theirs.size(), 27U);
  for (const std::size_t first : {0, 9, 18}) {
    EXPECT_TRUE(is_same_view(theirs[first], theirs[first + 8]));
  }
}

// What a view sees of the cluster it was sampled for.

const Box3 kWorkspace(Vec3(-8, -8, 0), Vec3(8, 8, 8));

OccupancyGrid grid_with(const std::vector<Vec3>& occupied_m) {
  OccupancyGrid grid(OccupancyConfig{}, kWorkspace);
  for (const Vec3& p_m : occupied_m) hit(grid, {voxel_at(grid, p_m)});
  return grid;
}

FrontierCluster cluster_of(const OccupancyGrid& grid, const Vec3& p_m) {
  const VoxelIndex v = voxel_at(grid, p_m);
  return {{v}, grid.geometry().center_m(grid.geometry().key_at(v))};
}

const Vec3 kTarget(3.1, 0.1, 4.1);
const ViewPose kFacing{Vec3(0.1, 0.1, 4.1), 0.0};

TEST(Frustum, IsBoundedByFieldOfViewAndRange) {
  const CameraModel camera = make_camera_model({});  // 60 x 45 degrees, 0.3 to 8 m
  const OccupancyGrid grid = grid_with({});
  const auto sees = [&](double x, double y, double z) {
    return !cluster_rejection({&camera, 1}, grid, {{}, Vec3(x, y, z)}, {}, false);
  };
  EXPECT_TRUE(sees(4, 0, 0));
  EXPECT_FALSE(sees(-4, 0, 0));
  EXPECT_TRUE(sees(4, 4 * std::tan(deg_to_rad(29.9)), 0));
  EXPECT_FALSE(sees(4, 4 * std::tan(deg_to_rad(30.1)), 0));
  EXPECT_TRUE(sees(4, 0, -4 * std::tan(deg_to_rad(22.4))));
  EXPECT_FALSE(sees(4, 0, -4 * std::tan(deg_to_rad(22.6))));
  EXPECT_TRUE(sees(7.99, 0, 0));
  EXPECT_FALSE(sees(8.01, 0, 0));
  EXPECT_FALSE(sees(0.29, 0, 0));
}

TEST(ClusterView, RejectsWhatDoesNotLookAtTheClusterOrIsHiddenUnlessAskedNotTo) {
  const std::vector<CameraModel> cameras = {make_camera_model({.pitch_rad = deg_to_rad(-60.0)}),
                                            make_camera_model({})};
  const std::span up = std::span(cameras).first(1), ahead = std::span(cameras).last(1);
  const OccupancyGrid open = grid_with({kTarget});
  const OccupancyGrid hidden = grid_with({kTarget, Vec3(1.5, 0.1, 4.1)});
  const FrontierCluster cluster = cluster_of(open, kTarget);
  const ViewPose away{kFacing.p_world_m, kPi};
  EXPECT_EQ(cluster_rejection(ahead, open, cluster, kFacing, true), std::nullopt);
  EXPECT_EQ(cluster_rejection(ahead, open, cluster, away, true), Rejection::cluster_outside_fov);
  EXPECT_EQ(cluster_rejection(up, open, cluster, kFacing, true), Rejection::cluster_outside_fov);
  EXPECT_EQ(cluster_rejection(cameras, open, cluster, kFacing, true), std::nullopt)
      << "any will do";
  EXPECT_EQ(cluster_rejection(ahead, hidden, cluster, kFacing, true), Rejection::cluster_hidden);
  EXPECT_EQ(cluster_rejection(ahead, hidden, cluster, kFacing, false), std::nullopt);
  FrontierCluster wide = cluster;  // a second voxel of it beside the obstacle is enough
  wide.voxels.push_back(voxel_at(hidden, Vec3(3.1, 1.1, 4.1)));
  EXPECT_EQ(cluster_rejection(ahead, hidden, wide, kFacing, true), std::nullopt);
}

// The presets of the planner's switches.

TEST(Presets, DifferInTheirSwitchesAndInNothingElse) {
  PlannerConfig config;
  config.utility.alpha = 7.0;
  config.map.resolution_m = 0.3;
  struct Case {
    const char* preset;
    FvsMode mode;
    int clusters, views_per_layer;
    double radius_m;
    HitVoxel hit_voxel;
  };
  for (const auto& [preset, mode, clusters, views_per_layer, radius_m, hit_voxel] :
       std::vector<Case>{{"released", FvsMode::single, 1, 8, 3.5, HitVoxel::excluded},
                         {"authors_2018", FvsMode::burst, 5, 8, 3.5, HitVoxel::excluded},
                         {"paper", FvsMode::burst, 1, 4, 2.5, HitVoxel::counted}}) {
    config.preset = preset;
    set_preset_switches(config);
    EXPECT_EQ(config.fvs.mode, mode) << preset;
    EXPECT_EQ(config.fvs.clusters, clusters) << preset;
    EXPECT_EQ(config.fvs.views_per_layer, views_per_layer) << preset;
    EXPECT_EQ(config.fvs.radius_m, radius_m) << preset;
    EXPECT_EQ(config.utility.hit_voxel, hit_voxel) << preset;
    EXPECT_EQ(config.utility.alpha, 7.0);
    EXPECT_EQ(config.map.resolution_m, 0.3);
  }
}

}  // namespace
}  // namespace gnbv
