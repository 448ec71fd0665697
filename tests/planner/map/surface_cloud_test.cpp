#include "planner/map/surface_cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "bench/reference/analytic_scans.hpp"
#include "bench/reference/pcl_twin.hpp"
#include "sim/core/error.hpp"
#include "tests/planner/map/random_points.hpp"

namespace gnbv {
namespace {

const Box3 kBox_m(Vec3(-2, -2, 0), Vec3(2, 2, 2));

std::vector<Vec3f> points_of_frame(const ViewPose& pose) {
  const CameraModel camera = make_camera_model({.width_px = 160, .height_px = 120});
  const DepthFrame frame = analytic_depth(example_scene(), camera, T_world_body(pose));
  std::vector<Vec3f> points;
  for (const ScanRay& ray : rays_of(frame, camera, 0.3)) {
    if (ray.hit) points.push_back(ray.end_world_m);
  }
  return points;
}

/// Sums of neighbour counts per voxel, every pair looked at.
std::vector<std::uint64_t> brute_force(const SurfaceCloud& cloud, const GridGeometry& grid) {
  std::vector<std::uint64_t> sums(grid.voxel_count(), 0);
  const auto radius2_m2 = static_cast<float>(cloud.search_radius_m() * cloud.search_radius_m());
  for (const Vec3f& p : cloud.points_world_m()) {
    std::uint64_t near = 0;
    for (const Vec3f& q : cloud.points_world_m()) {
      const float dx = q[0] - p[0];
      const float dy = q[1] - p[1];
      const float dz = q[2] - p[2];
      near += static_cast<std::uint64_t>(dx * dx + dy * dy + dz * dz <= radius2_m2);
    }
    sums[grid.index_of(grid.key_of(p))] += near;
  }
  return sums;
}

std::vector<std::uint64_t> by_pcl(const SurfaceCloud& cloud, const GridGeometry& grid) {
  std::vector<std::uint64_t> sums(grid.voxel_count(), 0);
  const std::vector<std::uint32_t> counts =
      pcl_neighbour_counts(cloud.points_world_m(), cloud.search_radius_m());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    sums[grid.index_of(grid.key_of(cloud.points_world_m()[i]))] += counts[i];
  }
  return sums;
}

std::vector<std::uint64_t> sums_of(const SurfaceCloud& cloud, const GridGeometry& grid) {
  std::vector<std::uint64_t> sums;
  for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) sums.push_back(cloud.neighbour_sum(v));
  return sums;
}

TEST(SurfaceCloud, DensityEqualsBruteForceAndPclAfterEveryBatch) {
  // buckets that coincide with the voxels, and two that do not; the last is one leaf wide
  for (const auto& [voxel_m, leaf_m] :
       std::vector<std::pair<double, double>>{{0.2, 0.02}, {0.17, 0.025}, {0.05, 0.06}}) {
    const GridGeometry grid(kBox_m, voxel_m);
    SurfaceCloud cloud({.leaf_m = leaf_m, .profile_leaf_m = 0.1}, grid);
    Random random(41);
    for (int batch = 0; batch < 4; ++batch) {
      cloud.add(random_sheet(random, kBox_m, 1500), batch == 0 ? 0.1 : leaf_m);
      const std::vector<std::uint64_t> sums = sums_of(cloud, grid);
      ASSERT_EQ(sums, brute_force(cloud, grid)) << "voxel " << voxel_m << ", batch " << batch;
      ASSERT_EQ(sums, by_pcl(cloud, grid)) << "voxel " << voxel_m << ", batch " << batch;
      for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) {
        const double points = std::max(1U, cloud.point_count(v));
        ASSERT_DOUBLE_EQ(cloud.density(v), static_cast<double>(sums[v]) / points);
      }
    }
    EXPECT_GT(cloud.points_world_m().size(), 1000U);
  }
}

TEST(SurfaceCloud, EqualsLeafByLeafFillingOfBatches) {
  const GridGeometry grid(kBox_m, 0.2);
  SurfaceCloud cloud(CloudConfig{}, grid);
  const LeafLattice lattice(0.02);
  std::map<LeafKey, Vec3f> first_centroid;
  Random random(43);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (int batch = 0; batch < 6; ++batch) {
    const double leaf_m = batch % 2 == 0 ? 0.1 : 0.02;  // a coarse one enters by its centroids
    const std::vector<Vec3f> points = random_sheet(random, kBox_m, 4000);
    const std::size_t before = first_centroid.size();
    for (const Vec3f& c_m : leaf_filter(points, leaf_m)) {
      first_centroid.emplace(lattice.key_of(c_m), c_m);
    }
    std::vector<Vec3f> given = points;
    for (const Vec3f& outside_m : {Vec3f(2.01F, 0, 1), Vec3f(0, -2.01F, 1), Vec3f(0, 0, -0.01F),
                                   Vec3f(kNan, 0, 1), Vec3f(0, 0, 1e30F)}) {
      given.push_back(outside_m);
    }
    ASSERT_EQ(cloud.add(given, leaf_m), first_centroid.size() - before);
  }
  for (const Vec3f& p_m : cloud.points_world_m()) {
    ASSERT_EQ(first_centroid.at(lattice.key_of(p_m)), p_m);
  }
}

/// Neighbours, on average, of the points of a square metre scanned every mm: of those about its
/// middle, and of those at an edge.
std::pair<double, double> neighbours_on_plane(const Vec3& normal) {
  SurfaceCloud cloud(CloudConfig{}, GridGeometry(kBox_m, 0.2));
  const Eigen::Quaterniond R = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), normal);
  const Vec3 middle_m(0.1037, 0.1069, 1.0193);  // no plane here runs along corners of leaves
  std::vector<Vec3f> points_m;
  for (double x_m = -0.5; x_m < 0.5; x_m += 0.001) {
    for (double y_m = -0.5; y_m < 0.5; y_m += 0.001) {
      points_m.push_back((middle_m + R * Vec3(x_m, y_m, 0.0)).cast<float>());
    }
  }
  cloud.add(points_m, cloud.config().leaf_m);
  const auto radius2_m2 = static_cast<float>(std::pow(cloud.search_radius_m(), 2));
  std::array<double, 2> points = {0.0, 0.0};  // about the middle, at the edge
  std::array<double, 2> neighbours = {0.0, 0.0};
  for (const Vec3f& p_m : cloud.points_world_m()) {
    const Vec3 at_m = R.inverse() * (p_m.cast<double>() - middle_m);
    const std::size_t where = at_m.x() > 0.49 ? 1 : 0;
    if (std::fabs(at_m.y()) > 0.1 || (where == 0 && std::fabs(at_m.x()) > 0.1)) continue;
    points[where] += 1.0;
    for (const Vec3f& q_m : cloud.points_world_m()) {
      neighbours[where] += (q_m - p_m).squaredNorm() <= radius2_m2 ? 1.0 : 0.0;
    }
  }
  return {neighbours[0] / points[0], neighbours[1] / points[1]};
}

TEST(SurfaceCloud, AFullPlaneStaysBelowTheNormaliserAsItsNormalSays) {
  EXPECT_DOUBLE_EQ(SurfaceCloud(CloudConfig{}, GridGeometry(kBox_m, 0.2)).density_max(), 300.0);
  for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0, 1, 1), Vec3(1, 1, 1), Vec3(1, 2, 5)}) {
    const double expected = 0.5 * kPi * 100.0 * normal.normalized().lpNorm<1>();
    const auto [middle, edge] = neighbours_on_plane(normal);
    EXPECT_NEAR(middle, expected, 0.05 * expected) << normal.transpose();
    EXPECT_NEAR(edge, 0.5 * expected, 0.13 * expected) << normal.transpose();
  }
}

TEST(LeafFilter, EqualsPclVoxelGridOnAFrame) {
  const std::vector<Vec3f> points = points_of_frame({Vec3(-6, 0, 3), 0.0});
  ASSERT_GT(points.size(), 5000U);
  for (const double leaf_m : {0.02, 0.1, 0.25}) {
    std::vector<Vec3f> ours = leaf_filter(points, leaf_m);
    std::vector<Vec3f> pcl = pcl_leaf_filter(points, leaf_m);
    ASSERT_EQ(ours.size(), pcl.size());
    const LeafLattice lattice(leaf_m);
    std::map<LeafKey, Vec3f> by_leaf;
    for (const Vec3f& c_m : ours) by_leaf.emplace(lattice.key_of(c_m), c_m);
    ASSERT_EQ(by_leaf.size(), ours.size());
    std::size_t not_found = 0;
    for (const Vec3f& c_m : pcl) {
      const auto match = by_leaf.find(lattice.key_of(c_m));
      if (match == by_leaf.end()) {
        ++not_found;  // PCL's float32 sum may round a centroid across the border of its leaf
        continue;
      }
      // PCL adds up to 200 float32 coordinates below 16 m: each addition rounds by at most half an
      // ulp of 3200, 1.2e-4, and so does the mean
      ASSERT_LT((match->second - c_m).cwiseAbs().maxCoeff(), 1.2e-4F) << "leaf " << leaf_m;
    }
    EXPECT_LE(not_found, 2U);
  }
}

TEST(SurfaceCloud, RefusesLeavesItCannotHold) {
  const GridGeometry grid(kBox_m, 0.2);
  EXPECT_THROW(SurfaceCloud({.leaf_m = 0.0, .profile_leaf_m = 0.1}, grid), BadInput);
  EXPECT_THROW(SurfaceCloud({.leaf_m = 0.001, .profile_leaf_m = 0.1}, grid), BadInput);
}

}  // namespace
}  // namespace gnbv
