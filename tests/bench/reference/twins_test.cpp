// The competent twins compute what they claim to: a benchmark against a wrong answer says nothing.
#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "bench/reference/analytic_scans.hpp"
#include "bench/reference/kd_density_twin.hpp"
#include "bench/reference/octomap_twin.hpp"
#include "bench/reference/view_twins.hpp"
#include "bench/speed/speed_rows.hpp"
#include "planner/map/scan_insertion.hpp"
#include "planner/map/surface_cloud.hpp"

namespace gnbv {
namespace {

/// Some frames of the circle, every fourth one.
std::vector<DepthFrame> some_frames() {
  std::vector<DepthFrame> frames;
  for (std::size_t i = 0; i < circle_frames().size(); i += 4) frames.push_back(circle_frames()[i]);
  return frames;
}

std::vector<Vec3f> ends_of(const DepthFrame& frame) {
  std::vector<Vec3f> ends_m;
  for (const ScanRay& ray : rays_of(frame, circle_camera(), kFloor_m)) {
    ends_m.push_back(ray.end_world_m);
  }
  return ends_m;
}

/// One ray to the centre of each voxel in which a ray ends.
std::vector<ScanRay> discretised(const std::vector<Vec3f>& ends_m, const GridGeometry& grid) {
  std::set<Key> keys;
  for (const Vec3f& end_m : ends_m) keys.insert(grid.key_of(end_m));
  std::vector<ScanRay> rays;
  for (const Key& key : keys) rays.push_back({grid.center_m(key).cast<float>(), true});
  return rays;
}

TEST(DiscretisedInsertion, IsOursOfOneRayAVoxelVoxelByVoxel) {
  OccupancyGrid grid(OccupancyConfig{}, kWorkspace_m);
  FanWalker walker(grid.geometry());
  OctomapTwin twin{OccupancyConfig{}};
  for (const DepthFrame& frame : some_frames()) {
    const Vec3f origin_m = frame.T_world_camera.translation().cast<float>();
    const std::vector<Vec3f> ends_m = ends_of(frame);
    twin.insert_point_cloud(OctomapScan(origin_m, ends_m), /*lazy=*/true, /*discretize=*/true);
    grid.apply(walker.compute_update(origin_m, discretised(ends_m, grid.geometry())));
  }
  std::size_t measured = 0;
  for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
    const std::optional<float> expected = twin.log_odds(grid.geometry().key_at(v));
    ASSERT_EQ(grid.is_measured(v), expected.has_value()) << v;
    if (!expected) continue;
    ++measured;
    ASSERT_EQ(std::bit_cast<std::uint32_t>(grid.log_odds(v)),
              std::bit_cast<std::uint32_t>(*expected));
  }
  EXPECT_GT(measured, 10'000U);
}

TEST(KeysetViews, SeeTheVoxelsOfTheExactWalk) {
  OccupancyGrid grid(OccupancyConfig{}, kWorkspace_m);
  ScanInserter inserter(grid.geometry());
  FrameRays rays;
  for (const DepthFrame& frame : some_frames()) {
    compute_frame_rays(frame, circle_camera(), kFloor_m, rays);
    grid.apply(inserter.compute_update(rays, frame, circle_camera(), grid, 1));
  }
  const auto cameras = camera_pair();
  const ViewRays view_rays = make_view_rays(cameras, grid.geometry().resolution_m());
  KeysetViewTwin twin(grid);
  ViewCounts sum;
  for (int i = 0; i < 12; ++i) {
    const double angle_rad = 0.5 * i;
    const ViewPose pose = {
        Vec3(8.3 * std::cos(angle_rad), 7.7 * std::sin(angle_rad), 1.3 + 0.4 * i),
        angle_rad + kPi + 0.2 * (i % 3)};
    const ViewCounts exact = exact_view_counts(grid, view_rays, pose);
    EXPECT_EQ(twin.evaluate(view_rays, pose), exact) << i;
    sum.occupied += exact.occupied;
    sum.unknown += exact.unknown;
  }
  EXPECT_GT(sum.occupied, 500);
  EXPECT_GT(sum.unknown, 10'000);
}

TEST(KdDensity, HoldsTheCountsOfEveryPairAndOurCloud) {
  const GridGeometry grid(Box3(Vec3(-20, -20, 0), Vec3(20, 20, 20)), 0.2);
  CloudConfig config;
  config.leaf_m = 0.05;  // fewer pairs to look at
  SurfaceCloud ours(config, grid);
  KdDensityTwin twin(config.leaf_m, ours.search_radius_m(), grid);
  for (const DepthFrame& frame : some_frames()) {
    std::vector<Vec3f> hits_m;
    for (const ScanRay& ray : rays_of(frame, circle_camera(), kFloor_m)) {
      if (ray.hit) hits_m.push_back(ray.end_world_m);
    }
    ours.add(hits_m, config.leaf_m);
    twin.add(hits_m);
  }
  const std::span<const Vec3f> points_m = twin.points_world_m();
  ASSERT_EQ(std::vector(points_m.begin(), points_m.end()),
            std::vector(ours.points_world_m().begin(), ours.points_world_m().end()));
  const auto radius2_m2 = static_cast<float>(ours.search_radius_m() * ours.search_radius_m());
  std::vector<std::uint64_t> every_pair(grid.voxel_count(), 0);
  for (const Vec3f& p : points_m) {
    std::uint64_t near = 0;
    for (const Vec3f& q : points_m) {
      const Vec3f d = q - p;
      near += static_cast<std::uint64_t>(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= radius2_m2);
    }
    every_pair[grid.index_of(grid.key_of(p))] += near;
  }
  ASSERT_GT(points_m.size(), 5'000U);
  for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) {
    ASSERT_EQ(twin.neighbour_sum(v), every_pair[v]) << v;
    ASSERT_EQ(twin.point_count(v), ours.point_count(v)) << v;
  }
}

}  // namespace
}  // namespace gnbv
