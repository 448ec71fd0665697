// Density frontiers: which voxels, how they cluster, and how large clusters are cut.
#include "planner/map/frontiers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

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

/// A row of voxels along x, every `stride`-th one.
Map row(int voxels, int stride = 1) {
  Map map;
  for (int i = 0; i < voxels; ++i) map.occupy(Vec3(-7.9 + 0.2 * stride * i, 0.1, 1.1));
  return map;
}

TEST(Frontier, IsOccupiedAndThinlySampledButNotEmpty) {
  Map map;
  map.occupy(Vec3(0.1, 0.1, 1.1), 3);
  map.occupy(Vec3(2.1, 0.1, 1.1), 300);  // 300 points within the search radius of one another
  map.occupy(Vec3(4.1, 0.1, 1.1), 0);
  const auto frontier_at = [&](double x_m) {
    const GridGeometry& g = map.grid.geometry();
    return is_frontier({}, map.grid, map.cloud, g.index_of(g.key_of(Vec3(x_m, 0.1, 1.1))));
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
    const VoxelIndex v = map.grid.geometry().index_of(map.grid.geometry().key_of(p_m));
    for (int miss = 0; miss < 8; ++miss) map.grid.apply({.free = {v}, .occupied = {}});
  }
  FrontierConfig config;
  config.min_cluster_voxels = 1;
  ASSERT_EQ(map.clusters(config).size(), 1U);
  EXPECT_EQ(map.clusters(config)[0].voxels.size(), 1U);
  config.occupied_only = false;
  ASSERT_EQ(map.clusters(config).size(), 1U);
  EXPECT_EQ(map.clusters(config)[0].voxels.size(), 5U);
}

TEST(Frontier, ClustersJoinUpToTwoVoxelsApart) {
  FrontierConfig config;
  config.max_extent_m = 0.0;
  EXPECT_EQ(row(6, 2).clusters(config).size(), 1U);
  EXPECT_EQ(row(6, 3).clusters(config).size(), 0U);  // six clusters of one voxel: too small
  config.min_cluster_voxels = 1;
  EXPECT_EQ(row(6, 3).clusters(config).size(), 6U);
  config.neighbour_voxels = 3;
  EXPECT_EQ(row(6, 3).clusters(config).size(), 1U);
}

TEST(Frontier, ClustersSmallerThanTheLeastAreLeftOut) {
  EXPECT_EQ(row(4).clusters({}).size(), 0U);
  EXPECT_EQ(row(5).clusters({}).size(), 1U);
}

TEST(Frontier, CentroidIsTheMeanOfTheVoxelsCentres) {
  const auto clusters = row(5).clusters({});
  ASSERT_EQ(clusters.size(), 1U);
  EXPECT_NEAR((clusters[0].centroid_world_m - Vec3(-7.5, 0.1, 1.1)).norm(), 0.0, 1e-12);
}

TEST(Frontier, LargeClustersAreCutAndNothingIsLost) {
  const Map map = row(80);  // 16 m
  FrontierConfig config;
  const auto cut = map.clusters(config);
  EXPECT_EQ(cut.size(), 8U);  // cells of 2 m
  std::set<VoxelIndex> voxels;
  for (const FrontierCluster& cluster : cut) {
    const auto& all = cluster.voxels;
    EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
    EXPECT_LE(static_cast<double>(all.back() - all.front() + 1) * 0.2, 2.0 + 1e-9);
    voxels.insert(all.begin(), all.end());
  }
  EXPECT_EQ(voxels.size(), 80U);
  config.max_extent_m = 0.0;  // the paper to the letter
  EXPECT_EQ(map.clusters(config).size(), 1U);
}

TEST(Frontier, CutsLoseNoVoxelOfAClusterThatIsLargeEnough) {
  // the lattice cuts 10, 10 and 2 voxels; four others, apart from them, are too few
  Map map = row(22);
  for (int i = 0; i < 4; ++i) map.occupy(Vec3(0.1 + 0.2 * i, 5.1, 1.1));
  FrontierConfig config;
  for (const double extent_m : {0.4, 1.0, 2.0, 3.0}) {
    config.max_extent_m = extent_m;
    std::multiset<VoxelIndex> voxels;
    for (const FrontierCluster& cluster : map.clusters(config)) {
      voxels.insert(cluster.voxels.begin(), cluster.voxels.end());
    }
    std::multiset<VoxelIndex> expected;
    config.max_extent_m = 0.0;
    for (const FrontierCluster& cluster : map.clusters(config)) {
      expected.insert(cluster.voxels.begin(), cluster.voxels.end());
    }
    EXPECT_EQ(expected.size(), 22U);
    EXPECT_EQ(voxels, expected) << extent_m;
  }
}

TEST(Frontier, ClustersAreTheComponentsOfTheNeighbourhoodGraph) {
  Map map;
  std::vector<Vec3> seeds;
  for (int i = 0; i < 60; ++i) {  // a scattered pattern, some of it connected
    map.occupy(Vec3(std::fmod(1.37 * i * i, 7.0), std::fmod(0.73 * i, 5.0), 1.1));
  }
  FrontierConfig config;
  config.min_cluster_voxels = 1;
  config.max_extent_m = 0.0;
  const auto clusters = map.clusters(config);
  // brute force: voxel pairs within the neighbourhood are in the same cluster, others never
  std::map<VoxelIndex, std::size_t> cluster_of;
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    for (const VoxelIndex v : clusters[c].voxels) cluster_of[v] = c;
  }
  EXPECT_EQ(cluster_of.size(), map.cloud.voxels().size());
  std::map<VoxelIndex, VoxelIndex> root;
  for (const auto& [v, c] : cluster_of) root[v] = v;
  const auto find = [&](VoxelIndex v) {
    while (root[v] != v) v = root[v];
    return v;
  };
  for (const auto& [a, ca] : cluster_of) {
    for (const auto& [b, cb] : cluster_of) {
      const Key ka = map.grid.geometry().key_at(a);
      const Key kb = map.grid.geometry().key_at(b);
      int apart = 0;
      for (std::size_t i = 0; i < 3; ++i) apart = std::max(apart, std::abs(ka[i] - kb[i]));
      if (apart <= 2) root[find(a)] = find(b);
    }
  }
  for (const auto& [a, ca] : cluster_of) {
    for (const auto& [b, cb] : cluster_of) EXPECT_EQ(ca == cb, find(a) == find(b));
  }
}

}  // namespace
}  // namespace gnbv
