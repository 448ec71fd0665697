// Density frontiers: which voxels, how they cluster, and how large clusters are cut.
#include "planner/map/frontiers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "bench/reference/pcl_twin.hpp"
#include "tests/planner/map/drawn_map.hpp"
#include "tests/planner/map/random_points.hpp"

namespace gnbv {
namespace {

const Box3 kWorkspace(Vec3(-8, -8, 0), Vec3(8, 8, 4));

struct Map {
  Map() : grid(OccupancyConfig{}, kWorkspace), cloud(CloudConfig{}, grid.geometry()) {}

  /// Makes the voxel at `p` occupied, with `points` points near its centre.
  void occupy(const Vec3& p_m, int points = 1) {
    const Key key = grid.geometry().key_of(p_m);
    grid.apply({.free = {}, .occupied = {grid.geometry().index_of(key)}});
    std::vector<Vec3f> all_m;
    for (int i = 0; i < points; ++i) {
      const Vec3 offset_m(0.02 * (i % 9 - 4), 0.02 * (i / 9 % 9 - 4), 0.02 * (i / 81 % 9 - 4));
      all_m.push_back((grid.geometry().center_m(key) + offset_m).cast<float>());
    }
    cloud.add(all_m, 0.02);
  }
  std::vector<FrontierCluster> clusters(const FrontierConfig& config) const {
    FrontierMarks marks(grid.geometry().voxel_count());
    const std::vector<FrontierCluster> found = find_frontiers(config, grid, cloud, marks);
    EXPECT_TRUE(std::all_of(marks.begin(), marks.end(), [](std::uint8_t m) { return m == 0; }));
    return found;
  }

  OccupancyGrid grid;
  SurfaceCloud cloud;
};

TEST(Frontier, IsOccupiedAndThinlySampledButNotEmpty) {
  Map map;
  map.occupy(Vec3(0.1, 0.1, 1.1), 3);
  map.occupy(Vec3(2.1, 0.1, 1.1), 300);  // 300 points within the search radius of one another
  map.occupy(Vec3(4.1, 0.1, 1.1), 0);
  const auto frontier_at = [&](double x_m) {
    return is_frontier({.occupied_only = true}, map.grid, map.cloud,
                       voxel_at(map.grid, Vec3(x_m, 0.1, 1.1)));
  };
  EXPECT_TRUE(frontier_at(0.1));
  EXPECT_FALSE(frontier_at(2.1));
  EXPECT_FALSE(frontier_at(4.1));
  EXPECT_FALSE(frontier_at(6.1));                   // not occupied
  EXPECT_EQ(map.cloud.density_max() / 3.0, 100.0);  // the released bound is a third of it
}

TEST(Frontier, PointsInClearedVoxelsCountWhereAsked) {
  Map map;
  for (int i = 0; i < 5; ++i) {
    const Vec3 p_m(0.1 + 0.2 * i, 0.1, 1.1);
    map.occupy(p_m, 3);
    if (i == 2) continue;
    // as rays that pass a thin part do
    clear(map.grid, {voxel_at(map.grid, p_m)});
  }
  FrontierConfig config = {
      .occupied_only = true, .linking = FrontierLinking::face, .min_cluster_voxels = 1};
  ASSERT_EQ(map.clusters(config).size(), 1U);
  EXPECT_EQ(map.clusters(config)[0].voxels.size(), 1U);
  config.occupied_only = false;
  ASSERT_EQ(map.clusters(config).size(), 1U);
  EXPECT_EQ(map.clusters(config)[0].voxels.size(), 5U);
}

/// Voxels within the neighbourhood are of one component: pair by pair.
std::vector<std::set<VoxelIndex>> components(const Map& map, const FrontierConfig& config) {
  const GridGeometry& grid = map.grid.geometry();
  std::vector<std::set<VoxelIndex>> all;
  for (const VoxelIndex v : map.cloud.voxels()) {
    std::set<VoxelIndex> joined = {v};
    std::erase_if(all, [&](const std::set<VoxelIndex>& other) {
      const bool is_near = std::ranges::any_of(other, [&](VoxelIndex w) {
        int apart = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          apart = std::max(apart, std::abs(grid.key_at(v)[i] - grid.key_at(w)[i]));
        }
        return apart <= config.neighbour_voxels;
      });
      if (is_near) joined.insert(other.begin(), other.end());
      return is_near;
    });
    all.push_back(std::move(joined));
  }
  const auto least = static_cast<std::size_t>(config.min_cluster_voxels);
  std::erase_if(all, [&](const auto& component) { return component.size() < least; });
  return all;
}

TEST(Frontier, ClustersAreTheComponentsOfTheNeighbourhoodGraphCutWithoutLoss) {
  Map map;  // a scattered pattern, some of it connected, and a row of 16 m
  for (int i = 0; i < 60; ++i) {
    map.occupy(Vec3(std::fmod(1.37 * i * i, 7.0), std::fmod(0.73 * i, 5.0), 1.1));
  }
  for (int i = 0; i < 80; ++i) map.occupy(Vec3(-7.9 + 0.2 * i, -6.1, 1.1));
  std::size_t cut = 0;
  for (const int neighbours : {1, 2, 3}) {
    for (const int least : {1, 5}) {
      FrontierConfig config{.linking = FrontierLinking::chebyshev,
                            .neighbour_voxels = neighbours,
                            .min_cluster_voxels = least};
      const auto expected = components(map, config);
      std::set<VoxelIndex> expected_voxels;
      for (const auto& one : expected) expected_voxels.insert(one.begin(), one.end());
      for (const double extent_m : {0.0, 0.4, 1.0, 2.0}) {  // 0: the paper to the letter
        config.max_extent_m = extent_m;
        const auto clusters = map.clusters(config);
        std::multiset<VoxelIndex> voxels;
        for (const FrontierCluster& cluster : clusters) {
          EXPECT_TRUE(std::ranges::is_sorted(cluster.voxels));
          Box3 box_m;
          Vec3 sum_m = Vec3::Zero();
          for (const VoxelIndex v : cluster.voxels) {
            const Vec3 center_m = map.grid.geometry().center_m(map.grid.geometry().key_at(v));
            box_m.extend(center_m);
            sum_m += center_m;
          }
          const auto size = static_cast<double>(cluster.voxels.size());
          EXPECT_LT((cluster.centroid_world_m - sum_m / size).norm(), 1e-12);
          voxels.insert(cluster.voxels.begin(), cluster.voxels.end());
          const std::set<VoxelIndex> own(cluster.voxels.begin(), cluster.voxels.end());
          if (extent_m == 0.0) {
            EXPECT_EQ(std::ranges::count(expected, own), 1);
          } else {
            EXPECT_LE(box_m.sizes().maxCoeff() + 0.2, extent_m + 1e-9);
          }
        }
        EXPECT_EQ(voxels,
                  (std::multiset<VoxelIndex>(expected_voxels.begin(), expected_voxels.end())));
        cut += clusters.size() > expected.size() ? 1 : 0;
      }
    }
  }
  EXPECT_GT(cut, 10U);
}

TEST(Frontier, LinkedAsInTheAuthorsUseOfPclTheClustersArePcls) {
  const GridGeometry grid(Box3(Vec3(-20, -3, 0), Vec3(20, 3, 6)), 0.2);
  Random random(3);
  std::vector<VoxelIndex> voxels;
  std::vector<Vec3f> centers_m;
  for (VoxelIndex v = 0; v < grid.voxel_count(); ++v) {
    if (!random.chance(0.5)) continue;
    voxels.push_back(v);
    centers_m.push_back(grid.center_m(grid.key_at(v)).cast<float>());
  }
  const auto clusters_by = [&](FrontierLinking linking, int max_voxels) {
    FrontierMarks marks(grid.voxel_count());
    std::set<std::set<VoxelIndex>> clusters;
    const FrontierConfig config = {.linking = linking, .max_cluster_voxels = max_voxels};
    for (const FrontierCluster& one : cluster_frontiers(config, grid, voxels, marks)) {
      clusters.emplace(one.voxels.begin(), one.voxels.end());
    }
    return clusters;
  };
  for (const int max_voxels : {20, 1000}) {
    std::set<std::set<VoxelIndex>> expected;
    for (const std::vector<int>& one : pcl_clusters(centers_m, 0.2, 5, max_voxels)) {
      std::set<VoxelIndex> cluster;
      for (const int i : one) cluster.insert(voxels[static_cast<std::size_t>(i)]);
      expected.insert(std::move(cluster));
    }
    EXPECT_GT(expected.size(), 100U);
    EXPECT_EQ(clusters_by(FrontierLinking::pcl, max_voxels), expected);
    EXPECT_NE(clusters_by(FrontierLinking::face, max_voxels), expected) << "not all faces join";
  }
}

}  // namespace
}  // namespace gnbv
