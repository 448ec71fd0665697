// View validity and visibility against brute force and hand-drawn scenes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "planner/map/ray_walk.hpp"
#include "planner/view_validity.hpp"
#include "planner/visibility.hpp"
#include "sim/core/rng.hpp"

namespace gnbv {
namespace {

const Box3 kWorkspace(Vec3(-5, -5, 0), Vec3(5, 5, 5));
const Box3 kNavigation(Vec3(-5, -5, 0.7), Vec3(5, 5, 5));

double draw(std::uint64_t frame, std::uint64_t index) {
  return uniform01({11, Stream::bench, frame, index});
}

OccupancyGrid empty_grid() { return OccupancyGrid(OccupancyConfig{}, kWorkspace); }

/// Everything measured free but for the given voxels.
OccupancyGrid free_grid_with(const std::set<VoxelIndex>& occupied) {
  OccupancyGrid grid = empty_grid();
  ScanUpdate update;
  for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
    (occupied.contains(v) ? update.occupied : update.free).push_back(v);
  }
  grid.apply(update);
  return grid;
}

VoxelIndex voxel_at(const OccupancyGrid& grid, const Vec3& p_world_m) {
  return grid.geometry().index_of(grid.geometry().key_of(p_world_m));
}

TEST(PathCheck, EqualsBruteForceOverSampledSpheres) {
  OccupancyGrid probe = empty_grid();
  std::set<VoxelIndex> occupied;
  for (std::uint64_t i = 0; i < 60; ++i) {
    occupied.insert(
        static_cast<VoxelIndex>(draw(0, i) * static_cast<double>(probe.geometry().voxel_count())));
  }
  const OccupancyGrid grid = free_grid_with(occupied);
  constexpr double kRadius_m = 0.8;
  int blocked = 0;
  int compared = 0;
  for (std::uint64_t trial = 0; trial < 300; ++trial) {
    const auto point = [&](std::uint64_t at) {
      return Vec3(draw(at, 3 * trial) * 10 - 5, draw(at, 3 * trial + 1) * 10 - 5,
                  draw(at, 3 * trial + 2) * 5);
    };
    const Vec3 a = point(1);
    const Vec3 b = point(2);
    if (!is_sphere_clear(grid, a, kRadius_m)) continue;
    double nearest_m = 1e9;
    for (int i = 0; i <= 400; ++i) {
      const Vec3 p = a + (i / 400.0) * (b - a);
      for (const VoxelIndex v : occupied) {
        const Vec3 c = grid.geometry().center_m(grid.geometry().key_at(v));
        const Box3 cube(c - Vec3::Constant(0.1), c + Vec3::Constant(0.1));
        nearest_m = std::min(nearest_m, cube.exteriorDistance(p));
      }
    }
    // 400 samples of a segment under 15 m miss the nearest point by less than 1 cm
    if (std::fabs(nearest_m - kRadius_m) < 0.01) continue;
    ++compared;
    blocked += nearest_m < kRadius_m ? 1 : 0;
    EXPECT_EQ(is_path_clear(grid, a, b, kRadius_m), nearest_m > kRadius_m) << trial;
  }
  EXPECT_GT(compared, 200);
  EXPECT_GT(blocked, 50);  // the scene says both yes and no
  EXPECT_LT(blocked, compared - 20);
}

TEST(PathCheck, WhatIsTooCloseAlreadyMayBeLeftButNotApproached) {
  OccupancyGrid probe = empty_grid();
  const OccupancyGrid grid = free_grid_with({voxel_at(probe, Vec3(0.1, 0.1, 2.1))});
  const Vec3 here(0.1, 1.0, 2.1);  // 0.8 m from the voxel's face
  EXPECT_FALSE(is_sphere_clear(grid, here, 1.5));
  EXPECT_TRUE(is_path_clear(grid, here, here + Vec3(0, 1, 0), 1.5));
  EXPECT_TRUE(is_path_clear(grid, here, here + Vec3(1, 0.5, 0), 1.5));
  EXPECT_FALSE(is_path_clear(grid, here, here - Vec3(0, 0.1, 0), 1.5));
  EXPECT_FALSE(is_path_clear(grid, here, here + Vec3(2, -0.5, 0), 1.5));
}

TEST(ViewValidity, NamesTheReason) {
  OccupancyGrid probe = empty_grid();
  const OccupancyGrid grid = free_grid_with({voxel_at(probe, Vec3(0.1, 0.1, 2.1))});
  const ValidityConfig config{.collision_radius_m = 0.5};
  const ViewPose current{Vec3(-2, 0.1, 2.1), 0};
  const std::vector<ViewPose> recent = {{Vec3(-2, 2, 2), 1.0}};
  const auto reason = [&](const ViewPose& candidate) {
    return rejection(config, kNavigation, grid, recent, current, candidate);
  };
  EXPECT_EQ(reason({Vec3(-2, 1, 2), 0}), std::nullopt);
  EXPECT_EQ(reason({Vec3(-2, 1, 0.6), 0}), Rejection::out_of_bounds);
  EXPECT_EQ(reason({Vec3(-2, 2, 2), 1.05}), Rejection::recently_visited);
  EXPECT_EQ(reason({Vec3(-2, 2, 2), 1.2}), std::nullopt);
  EXPECT_EQ(reason({Vec3(0.1, 0.1, 2.1), 0}), Rejection::not_free);
  EXPECT_EQ(reason({Vec3(0.1, 0.1, 2.6), 0}), Rejection::collision);
  EXPECT_EQ(reason({Vec3(2, 0.1, 2.1), 0}), Rejection::path_blocked);
}

TEST(ViewValidity, UnknownSpaceIsNotFree) {
  const OccupancyGrid grid = empty_grid();
  EXPECT_EQ(rejection({}, kNavigation, grid, {}, {Vec3(0, 0, 2), 0}, {Vec3(1, 0, 2), 0}),
            Rejection::not_free);
}

TEST(ViewValidity, TheFacesOfTheNavigationBoxAreInside) {
  const OccupancyGrid grid = free_grid_with({});
  for (const Vec3& p : {Vec3(5, 5, 5), Vec3(-5, -5, 0.7), Vec3(5, -5, 0.7)}) {
    EXPECT_EQ(rejection({}, kNavigation, grid, {}, {Vec3(0, 0, 2), 0}, {p, 0}), std::nullopt);
  }
}

TEST(ViewRays, AreTheLatticeOfTheReleasedCode) {
  const CameraModel camera = make_camera_model({});
  const auto rays = make_view_rays({&camera, 1}, 0.2);
  EXPECT_EQ(rays.size(), 47U * 34U);
  for (const ViewRay& ray : rays) {
    EXPECT_NEAR(ray.end_body_m.x(), 8.0, 1e-12);  // the plane at maximum range
    EXPECT_LE(std::fabs(ray.end_body_m.y()), 8 * std::tan(deg_to_rad(30)) + 1e-12);
    EXPECT_LE(std::fabs(ray.end_body_m.z()), 8 * std::tan(deg_to_rad(22.5)) + 1e-12);
  }
}

/// The same counts, from sets of voxels gathered ray by ray.
ViewStats brute_force(const OccupancyGrid& grid, const SurfaceCloud& cloud,
                      std::span<const ViewRay> rays, const ViewPose& pose) {
  ViewStats stats;
  std::set<VoxelIndex> seen;
  const Isometry T = T_world_body(pose);
  for (const ViewRay& ray : rays) {
    std::vector<Key> keys;
    walk_ray(grid.geometry(), (T * ray.origin_body_m).cast<float>(),
             (T * ray.end_body_m).cast<float>(), [&](const Key& key) {
               keys.push_back(key);
               return true;
             });
    for (const Key& key : keys) {
      if (!grid.geometry().contains(key)) break;
      const VoxelIndex v = grid.geometry().index_of(key);
      stats.entropy_per_ray_nat += static_cast<double>(grid.entropy_nat(v));
      seen.insert(v);
      if (grid.state(v) == VoxelState::occupied) break;
    }
  }
  for (const VoxelIndex v : seen) {
    stats.entropy_nat += static_cast<double>(grid.entropy_nat(v));
    stats.free_voxels += grid.state(v) == VoxelState::free ? 1 : 0;
    stats.unknown_voxels += grid.state(v) == VoxelState::unknown ? 1 : 0;
    stats.occupied_voxels += grid.state(v) == VoxelState::occupied ? 1 : 0;
    if (grid.state(v) == VoxelState::occupied) stats.density_sum += cloud.density(v);
  }
  return stats;
}

TEST(EvaluateView, EqualsBruteForceOnRandomMaps) {
  OccupancyGrid grid = empty_grid();
  for (std::uint64_t scan = 0; scan < 4; ++scan) {
    ScanUpdate update;
    for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
      const double u = draw(20 + scan, v);
      if (u < 0.3) update.free.push_back(v);
      if (u > 0.997) update.occupied.push_back(v);
    }
    grid.apply(update);
  }
  SurfaceCloud cloud(CloudConfig{}, grid.geometry());
  std::vector<Vec3f> points;
  for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
    if (grid.state(v) != VoxelState::occupied) continue;
    const Vec3 center_m = grid.geometry().center_m(grid.geometry().key_at(v));
    for (std::uint64_t i = 0; i < v % 4; ++i) {
      points.push_back((center_m + Vec3::Constant(0.1 * draw(40 + i, v) - 0.05)).cast<float>());
    }
  }
  cloud.add(points, 0.02);
  const CameraModel camera = make_camera_model({.range_max_m = 4.0, .pitch_rad = 0.3});
  const auto rays = make_view_rays({&camera, 1}, 0.2);
  VisitMarks marks(grid.geometry().voxel_count());
  for (std::uint64_t i = 0; i < 20; ++i) {
    const ViewPose pose{Vec3(draw(30, i) * 9 - 4.5, draw(31, i) * 9 - 4.5, draw(32, i) * 4 + 0.7),
                        draw(33, i) * 6.28};
    const ViewStats fast = evaluate_view(grid, cloud, rays, pose, marks);
    const ViewStats slow = brute_force(grid, cloud, rays, pose);
    EXPECT_EQ(fast.free_voxels, slow.free_voxels);
    EXPECT_EQ(fast.unknown_voxels, slow.unknown_voxels);
    EXPECT_EQ(fast.occupied_voxels, slow.occupied_voxels);
    // sums of up to 1e5 float32 entropies in float64, in another order
    EXPECT_NEAR(fast.entropy_nat, slow.entropy_nat, 1e-6);
    EXPECT_EQ(fast.entropy_per_ray_nat, slow.entropy_per_ray_nat);
    EXPECT_NEAR(fast.density_sum, slow.density_sum, 1e-9);
    EXPECT_GT(slow.density_sum, 0.0);
    EXPECT_GT(slow.occupied_voxels, 0U);
  }
}

TEST(EvaluateView, AWallHidesWhatIsBehindItAndIsCountedItself) {
  OccupancyGrid probe = empty_grid();
  std::set<VoxelIndex> wall;
  for (double y = -4.9; y < 5.0; y += 0.2) {
    for (double z = 0.1; z < 5.0; z += 0.2) wall.insert(voxel_at(probe, Vec3(1.1, y, z)));
  }
  // free up to the wall, unknown behind it
  OccupancyGrid grid = empty_grid();
  ScanUpdate update;
  for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
    const double x_m = grid.geometry().center_m(grid.geometry().key_at(v)).x();
    if (wall.contains(v)) update.occupied.push_back(v);
    if (x_m < 1.0) update.free.push_back(v);
  }
  grid.apply(update);
  const SurfaceCloud cloud(CloudConfig{}, grid.geometry());
  const CameraModel camera = make_camera_model({.range_max_m = 4.0});
  const auto rays = make_view_rays({&camera, 1}, 0.2);
  VisitMarks marks(grid.geometry().voxel_count());
  const ViewStats stats = evaluate_view(grid, cloud, rays, {Vec3(-1.03, 0.03, 2.53), 0.0}, marks);
  EXPECT_EQ(stats.unknown_voxels, 0U);
  // the wall is 2.03 m ahead: 60 x 45 degrees see 2.34 x 1.68 m of it, 12 or 13 by 9 voxels
  EXPECT_GE(stats.occupied_voxels, 12U * 8U);
  EXPECT_LE(stats.occupied_voxels, 14U * 10U);
}

TEST(EvaluateView, SeesFromEveryFaceOfTheWorkspace) {
  const OccupancyGrid grid = empty_grid();
  const SurfaceCloud cloud(CloudConfig{}, grid.geometry());
  const CameraModel camera = make_camera_model({.range_max_m = 4.0});
  const auto rays = make_view_rays({&camera, 1}, 0.2);
  VisitMarks marks(grid.geometry().voxel_count());
  for (const ViewPose& pose : {ViewPose{Vec3(5, 0, 2), kPi}, ViewPose{Vec3(-5, 0, 2), 0.0},
                               ViewPose{Vec3(0, 5, 2), -kPi / 2}, ViewPose{Vec3(0, -5, 2), kPi / 2},
                               ViewPose{Vec3(0, 0, 5), 0.0}, ViewPose{Vec3(0, 0, 0), 0.0}}) {
    EXPECT_GT(evaluate_view(grid, cloud, rays, pose, marks).unknown_voxels, 1000U)
        << pose.p_world_m.transpose();
  }
}

TEST(InsideWalk, NamesTheVoxelsOfTheFullWalkThatLieInTheGrid) {
  for (const double resolution_m : {0.2, 0.07, 0.05}) {
    const GridGeometry grid(kWorkspace, resolution_m);
    for (std::uint64_t i = 0; i < 500; ++i) {
      const Vec3 from(draw(50, i) * 10 - 5, draw(51, i) * 10 - 5, draw(52, i) * 5);
      // some along an axis, some out of the grid
      Vec3 to = from + Vec3(draw(53, i) - 0.5, draw(54, i) - 0.5, draw(55, i) - 0.5) * 8.0;
      if (i % 5 == 0) to.y() = from.y();
      if (i % 10 == 0) to.z() = from.z();
      const RayOrigin origin = make_ray_origin(grid, from.cast<float>());
      if (!grid.contains(origin.key)) continue;
      std::vector<VoxelIndex> full;
      walk_ray(grid, origin, to.cast<float>(), [&](const Key& key) {
        if (!grid.contains(key)) return false;
        full.push_back(grid.index_of(key));
        return true;
      });
      std::vector<VoxelIndex> inside;
      walk_ray_inside(grid, origin, to.cast<float>(), [&](VoxelIndex v) {
        inside.push_back(v);
        return true;
      });
      ASSERT_EQ(inside, full) << resolution_m << " " << i;
    }
  }
}

TEST(VisitMarks, ForgetNothingWhenTheirCounterWrapsAround) {
  VisitMarks marks(2);
  marks.next_view();
  EXPECT_TRUE(marks.mark(0));
  for (int i = 0; i < 65535; ++i) marks.next_view();
  EXPECT_TRUE(marks.mark(0));
  EXPECT_FALSE(marks.mark(0));
  EXPECT_TRUE(marks.mark(1));
}

}  // namespace
}  // namespace gnbv
