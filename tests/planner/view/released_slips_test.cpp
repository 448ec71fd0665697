// The slips of the released code.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "planner/guided/utility.hpp"
#include "planner/view/shadow_band.hpp"
#include "planner/view/visibility.hpp"
#include "sim/core/error.hpp"
#include "tests/planner/map/drawn_map.hpp"
#include "tests/planner/view/view_scene.hpp"

namespace gnbv {
namespace {

/// Free up to a plane of occupied voxels: x + slope y = 1.1 m.
struct WallScene {
  explicit WallScene(double slope) {
    const auto between = [&](double low_m, double high_m) {
      return voxels_where(grid, [=](const Vec3& p_m) {
        const double depth_m = p_m.x() + slope * p_m.y() - 1.1;
        return depth_m > low_m && depth_m < high_m;
      });
    };
    grid.apply({.free = between(-1e9, -0.1), .occupied = between(-0.1, 0.3)});
  }
  ViewStats look(const ReleasedSlips& slips) const {
    return evaluate_view_with_slips(grid, cloud, rays, pose, slips, 0.0);
  }

  OccupancyGrid grid{OccupancyConfig{}, Box3(Vec3(-5, -5, 0), Vec3(5, 5, 5))};
  SurfaceCloud cloud{CloudConfig{}, grid.geometry()};
  ShadowBand shadow{ShadowConfig{}, grid.geometry()};
  CameraModel camera = make_camera_model({.range_max_m = 4.0});
  ViewRays rays = make_view_rays({&camera, 1}, 0.2);
  ViewPose pose = {Vec3(-1.03, 0.03, 2.53), 0.0};
};

const Box3 kObject_m(Vec3(-3.0, -4.0, 0.5), Vec3(4.0, 2.1, 3.0));

TEST(WithoutSlips, TheSlowPathIsTheFastOne) {
  const RandomScene scene(kObject_m);
  const CameraModel camera = make_camera_model({.range_max_m = 4.0});
  const ViewRays rays = make_view_rays({&camera, 1}, 0.2);
  VisitMarks marks(scene.grid.geometry().voxel_count());
  for (std::uint64_t i = 0; i < 10; ++i) {
    const ViewPose pose = RandomScene::pose(i);
    const ViewStats slow = evaluate_view_with_slips(scene.grid, scene.cloud, rays, pose, {}, 1.5);
    const ViewStats fast =
        evaluate_view(scene.grid, scene.cloud, rays, pose, marks, {.sparse_below = 1.5});
    EXPECT_EQ(slow.free_voxels, fast.free_voxels);
    EXPECT_EQ(slow.unknown_voxels, fast.unknown_voxels);
    EXPECT_EQ(slow.occupied_voxels, fast.occupied_voxels);
    EXPECT_EQ(slow.predicted_voxels, fast.predicted_voxels);
    EXPECT_EQ(slow.sparse_voxels, fast.sparse_voxels);
    EXPECT_NEAR(slow.entropy_nat, fast.entropy_nat, 1e-6);
    EXPECT_NEAR(slow.entropy_per_ray_nat, fast.entropy_per_ray_nat, 1e-5);
    EXPECT_NEAR(slow.density_sum, fast.density_sum, 1e-3);
  }
}

/// The slips as the header has them, ray by ray and voxel by voxel.
ViewStats by_force(const RandomScene& scene, const ViewRays& rays, const ViewPose& pose,
                   const ReleasedSlips& slips) {
  const GridGeometry& geometry = scene.grid.geometry();
  const auto crossed = [&](const Vec3& from_m, const Vec3& to_m) {
    std::vector<VoxelIndex> voxels;
    walk_ray(geometry, from_m.cast<float>(), to_m.cast<float>(), [&](const Key& key) {
      if (geometry.contains(key)) voxels.push_back(geometry.index_of(key));
      return geometry.contains(key);
    });
    return voxels;
  };
  const auto is_occupied = [&](VoxelIndex v) {
    return scene.grid.state(v) == VoxelState::occupied;
  };
  const auto is_predicted = [&](VoxelIndex v) { return scene.grid.is_predicted(v); };
  ViewStats stats;
  std::set<VoxelIndex> seen;
  for (std::size_t i = 0; i < rays.count(); ++i) {
    const Vec3 from_m = pose.p_world_m;
    Vec3 to_m = T_world_body(pose) *
                Vec3(rays.end_body_m[0][i], rays.end_body_m[1][i], rays.end_body_m[2][i]);
    std::vector<VoxelIndex> voxels = crossed(from_m, to_m);
    to_m = geometry.center_m(geometry.key_of(to_m));
    const bool meets_prediction = std::ranges::any_of(voxels, is_predicted);
    const auto hit = std::ranges::find_if(voxels, is_occupied);
    if (hit != voxels.end()) {
      const VoxelIndex v = *hit;
      to_m = geometry.center_m(geometry.key_at(v));
      voxels.erase(hit, voxels.end());
      if (slips.excludes_hit_voxel || slips.prediction_hides_hits) voxels = crossed(from_m, to_m);
      const bool is_hidden = slips.prediction_hides_hits && !meets_prediction;
      if (!slips.excludes_hit_voxel && !is_hidden) voxels.push_back(v);
    }
    const bool is_dropped = slips.drops_leaving_rays && !scene.object_bounds_m.contains(to_m);
    for (const VoxelIndex v : voxels) {
      if (!scene.object_bounds_m.contains(geometry.center_m(geometry.key_at(v)))) continue;
      const double entropy_nat = scene.grid.entropy_nat(v);
      if (!is_dropped) stats.entropy_per_ray_nat += entropy_nat;
      if (!seen.insert(v).second) continue;
      stats.entropy_nat += entropy_nat;
      stats.occupied_voxels += is_occupied(v);
      stats.free_voxels += scene.grid.state(v) == VoxelState::free;
      stats.unknown_voxels += scene.grid.state(v) == VoxelState::unknown;
    }
  }
  return stats;
}

TEST(Slips, AreThoseByForce) {
  RandomScene scene(kObject_m);
  for (VoxelIndex v = 0; v < scene.grid.geometry().voxel_count(); v += 3) scene.grid.predict(v);
  const CameraModel camera = make_camera_model({.range_max_m = 4.0});
  const ViewRays rays = make_view_rays({&camera, 1}, 0.2);
  double entropies_nat = 0.0;
  std::set<double> all_nat;
  for (int mask = 0; mask < 8; ++mask) {
    const ReleasedSlips slips = {.excludes_hit_voxel = (mask & 1) != 0,
                                 .prediction_hides_hits = (mask & 2) != 0,
                                 .drops_leaving_rays = (mask & 4) != 0};
    entropies_nat = 0.0;
    for (std::uint64_t i = 0; i < 10; ++i) {
      const ViewPose pose = RandomScene::pose(i);
      const ViewStats ours =
          evaluate_view_with_slips(scene.grid, scene.cloud, rays, pose, slips, 0.0);
      const ViewStats forced = by_force(scene, rays, pose, slips);
      EXPECT_EQ(ours.occupied_voxels, forced.occupied_voxels) << mask << ' ' << i;
      EXPECT_EQ(ours.free_voxels, forced.free_voxels) << mask << ' ' << i;
      EXPECT_EQ(ours.unknown_voxels, forced.unknown_voxels) << mask << ' ' << i;
      EXPECT_NEAR(ours.entropy_nat, forced.entropy_nat, 1e-6) << mask << ' ' << i;
      EXPECT_NEAR(ours.entropy_per_ray_nat, forced.entropy_per_ray_nat, 1e-5) << mask << ' ' << i;
      entropies_nat += forced.entropy_per_ray_nat;
    }
    all_nat.insert(entropies_nat);
  }
  // with the hit voxel excluded it is the same whether a prediction hides it
  EXPECT_EQ(all_nat.size(), 6U);
}

TEST(ExcludedHitVoxel, AFlatWallHeadOnIsNotSeenATiltedOneWhereItsVoxelsAreClipped) {
  const WallScene flat(0.0), tilted(0.6);
  // 2.03 m ahead: 60 x 45 degrees see 2.34 x 1.68 m of it, 12 or 13 by 9 voxels, and none behind
  EXPECT_NEAR(flat.look({}).occupied_voxels, 12.5 * 9, 20);
  EXPECT_EQ(flat.look({}).unknown_voxels, 0U);
  EXPECT_EQ(flat.look({.excludes_hit_voxel = true}).occupied_voxels, 0U);
  const auto slipped = tilted.look({.excludes_hit_voxel = true}).occupied_voxels;
  EXPECT_GT(slipped, 0U);
  EXPECT_LT(slipped, tilted.look({}).occupied_voxels / 2);
}

TEST(ExcludedHitVoxel, IsForTheBaselinesAlone) {
  const WallScene flat(0.0);
  VisitMarks marks(flat.grid.geometry().voxel_count());
  const auto occupied = [&](const char* name) {
    const UtilityConfig config{.name = name, .hit_voxel = HitVoxel::excluded};
    return evaluate_view(flat.grid, flat.cloud, flat.rays, flat.pose, marks,
                         view_options(config, flat.shadow, 0.0))
        .occupied_voxels;
  };
  EXPECT_EQ(occupied("isler"), 0U);
  EXPECT_EQ(occupied("bircher"), 0U);
  EXPECT_GT(occupied("proposed"), 90U);
  EXPECT_GT(occupied("aep"), 90U);
}

TEST(PredictionThatHidesHits, IsProposedsAloneAndNeedsAWeightForPrediction) {
  Corridor corridor(8);
  corridor.hit(2);
  const ShadowBand shadow({}, corridor.grid.geometry());
  UtilityConfig config{.name = "proposed", .prediction_hides_hits = true};
  const auto occupied = [&] {
    return evaluate_view(corridor.grid, corridor.cloud, Corridor::one_ray(1.2),
                         {Vec3(0.1, 0.1, 0.1), 0.0}, corridor.marks,
                         view_options(config, shadow, 0.0))
        .occupied_voxels;
  };
  EXPECT_EQ(occupied(), 0U);
  config.gamma = 0.0;
  EXPECT_EQ(occupied(), 1U);
  config.gamma = 0.5;
  config.name = "isler";
  EXPECT_EQ(occupied(), 1U);
}

/// One pixel that looks along +x from x = 0.1 m.
FrameRays ray_to(double x_m, PixelRay kind = PixelRay::hits) {
  FrameRays rays;
  rays.origin_world_m = Vec3f(0.1F, 0.1F, 0.1F);
  rays.end_m = {{{static_cast<float>(x_m)}, {0.1F}, {0.1F}}};
  rays.kind = {kind};
  return rays;
}

TEST(ShadowBand, CountsTheFewestStepsBehindAHitWhereNothingHasBeenMeasured) {
  struct Case {
    std::vector<FrameRays> rays;
    std::vector<VoxelIndex> missed;    // before them
    std::array<int, 12> steps_behind;  // the voxel with the end of the band is left out
  };
  for (const Case& c :
       std::vector<Case>{{{ray_to(0.7)}, {}, {0, 0, 0, 0, 1, 2, 3}},
                         {{ray_to(0.7), ray_to(0.9)}, {}, {0, 0, 0, 0, 1, 1, 2, 3}},
                         {{ray_to(0.7), ray_to(0.9), ray_to(0.5)}, {}, {0, 0, 0, 1, 1, 1, 2, 3}},
                         {{ray_to(0.7)}, {4}, {0, 0, 0, 0, 0, 2, 3}},
                         {{ray_to(0.7, PixelRay::clears), ray_to(0.7, PixelRay::none)}, {}, {}}}) {
    Corridor corridor(12);
    ShadowBand band({.shadow_depth_m = 0.75}, corridor.grid.geometry());
    EXPECT_DOUBLE_EQ(band.steps_max(), 7.5);
    for (const VoxelIndex v : c.missed) corridor.miss(v);
    for (const FrameRays& rays : c.rays) band.add(rays, corridor.grid);
    for (VoxelIndex v = 0; v < 12; ++v) {
      EXPECT_EQ(band.steps_behind(v), c.steps_behind[v]) << v;
      EXPECT_EQ(corridor.grid.is_shaded(v), c.steps_behind[v] > 0) << v;
      corridor.miss(v);
      EXPECT_FALSE(corridor.grid.is_shaded(v)) << "measured";
    }
  }
}

TEST(ShadowBand, RefusesDepthsThatNoByteCounts) {
  const Corridor corridor(2);
  EXPECT_THROW(ShadowBand({.shadow_depth_m = 0.0}, corridor.grid.geometry()), BadInput);
  EXPECT_THROW(ShadowBand({.shadow_depth_m = 17.0}, corridor.grid.geometry()), BadInput);
}

// What is listed of a view is what was counted of it.

TEST(VoxelsInSight, AreThoseThatTheUtilityCounts) {
  const RandomScene scene;
  const CameraModel left = make_camera_model({.range_max_m = 5.0});
  const CameraModel right =
      make_camera_model({.fov_x_rad = 0.6, .fov_y_rad = 0.4, .range_max_m = 3.0});
  const std::array cameras = {left, right};
  const ViewRays rays = make_view_rays(cameras, scene.grid.geometry().resolution_m());
  VisitMarks marks(scene.grid.geometry().voxel_count());
  std::size_t predicted = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const ViewPose pose = RandomScene::pose(i);
    const ViewStats stats = evaluate_view(scene.grid, scene.cloud, rays, pose, marks);
    const VoxelsInSight seen = voxels_in_sight(scene.grid, rays, pose);
    EXPECT_EQ(seen.unknown.size(), stats.unknown_voxels) << i;
    EXPECT_EQ(seen.predicted.size(), stats.predicted_voxels) << i;
    EXPECT_TRUE(std::ranges::is_sorted(seen.unknown));
    for (const VoxelIndex v : seen.unknown) EXPECT_EQ(scene.grid.state(v), VoxelState::unknown);
    for (const VoxelIndex v : seen.predicted) EXPECT_TRUE(scene.grid.is_predicted(v));
    predicted += seen.predicted.size();
  }
  EXPECT_GT(predicted, 100U);
}

}  // namespace
}  // namespace gnbv
