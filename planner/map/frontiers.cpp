#include "planner/map/frontiers.hpp"

#include <algorithm>
#include <map>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// Whether two voxels with these centres are neighbours, if `reach` of each other.
bool is_linked(FrontierLinking linking, const Vec3& a_m, const Vec3& b_m, double resolution_m) {
  switch (linking) {
    case FrontierLinking::chebyshev:
      return true;
    case FrontierLinking::face:
      return (a_m - b_m).lpNorm<1>() < 1.5 * resolution_m;
    case FrontierLinking::pcl: {
      const auto tolerance_m = static_cast<double>(static_cast<float>(resolution_m));
      const Vec3f apart_m = a_m.cast<float>() - b_m.cast<float>();
      return apart_m.squaredNorm() < static_cast<float>(tolerance_m * tolerance_m);
    }
  }
  return false;
}

/// All marked voxels within the neighbourhood of `seed`, directly or by way of others; takes their
/// marks away.
std::vector<VoxelIndex> connected_to(VoxelIndex seed, const FrontierConfig& config,
                                     const GridGeometry& geometry, FrontierMarks& marks) {
  const int reach = config.linking == FrontierLinking::chebyshev ? config.neighbour_voxels : 1;
  std::vector<VoxelIndex> voxels = {seed};
  marks[seed] = 0;
  for (std::size_t next = 0; next < voxels.size(); ++next) {
    const Vec3 center_m = geometry.center_m(geometry.key_at(voxels[next]));
    for_each_key(geometry.keys_in(Box3(center_m), reach), [&](const Key& near) {
      const VoxelIndex v = geometry.index_of(near);
      if (marks[v] == 0) return;
      if (!is_linked(config.linking, center_m, geometry.center_m(near), geometry.resolution_m())) {
        return;
      }
      marks[v] = 0;
      voxels.push_back(v);
    });
  }
  std::sort(voxels.begin(), voxels.end());
  return voxels;
}

double largest_extent_m(std::span<const VoxelIndex> voxels, const GridGeometry& geometry) {
  Eigen::AlignedBox3i keys;
  for (const VoxelIndex v : voxels) {
    keys.extend(Eigen::Vector3i::Map(geometry.key_at(v).data()));
  }
  return (keys.sizes().maxCoeff() + 1) * geometry.resolution_m();
}

/// The voxels by the cell of the world lattice in which their centres lie; by z, then y, then x.
std::vector<std::vector<VoxelIndex>> cut(std::span<const VoxelIndex> voxels, double cell_m,
                                         const GridGeometry& geometry) {
  std::map<Key, std::vector<VoxelIndex>> cells;
  for (const VoxelIndex v : voxels) {
    const auto [x, y, z] = cube_of(geometry.center_m(geometry.key_at(v)), cell_m);
    cells[{z, y, x}].push_back(v);
  }
  std::vector<std::vector<VoxelIndex>> pieces;
  for (auto& [cell, piece] : cells) pieces.push_back(std::move(piece));
  return pieces;
}

}  // namespace

bool is_frontier(const FrontierConfig& config, const OccupancyGrid& grid, const SurfaceCloud& cloud,
                 VoxelIndex v) {
  if (config.occupied_only && grid.state(v) != VoxelState::occupied) return false;
  const double density = cloud.density(v);
  return density > 0.0 && density < config.density_share * cloud.density_max();
}

FrontierCluster make_cluster(std::vector<VoxelIndex> voxels, const GridGeometry& geometry) {
  Vec3 sum_m = Vec3::Zero();
  for (const VoxelIndex v : voxels) sum_m += geometry.center_m(geometry.key_at(v));
  const Vec3 centroid_m = sum_m / static_cast<double>(voxels.size());
  return {std::move(voxels), centroid_m};
}

std::vector<VoxelIndex> frontier_voxels(const FrontierConfig& config, const OccupancyGrid& grid,
                                        const SurfaceCloud& cloud, const FrontierMarks& ignored) {
  std::vector<VoxelIndex> frontier;
  for (const VoxelIndex v : cloud.voxels()) {
    if (ignored.size() > 0 && ignored[v] != 0) continue;
    if (is_frontier(config, grid, cloud, v)) frontier.push_back(v);
  }
  std::sort(frontier.begin(), frontier.end());
  return frontier;
}

std::vector<VoxelIndex> voxels_of(std::span<const FrontierCluster> clusters) {
  std::vector<VoxelIndex> voxels;
  for (const FrontierCluster& cluster : clusters) {
    voxels.insert(voxels.end(), cluster.voxels.begin(), cluster.voxels.end());
  }
  std::ranges::sort(voxels);
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
  return voxels;
}

std::vector<FrontierCluster> cluster_frontiers(const FrontierConfig& config,
                                               const GridGeometry& geometry,
                                               const std::vector<VoxelIndex>& frontier,
                                               FrontierMarks& marks) {
  GNBV_CHECK(marks.size() == geometry.voxel_count(), "{} marks for {} voxels", marks.size(),
             geometry.voxel_count());
  for (const VoxelIndex v : frontier) marks[v] = 1;
  const auto min_voxels = static_cast<std::size_t>(config.min_cluster_voxels);
  const auto max_voxels = static_cast<std::size_t>(config.max_cluster_voxels);
  std::vector<FrontierCluster> clusters;
  for (const VoxelIndex seed : frontier) {
    if (marks[seed] == 0) continue;
    std::vector<std::vector<VoxelIndex>> pieces = {connected_to(seed, config, geometry, marks)};
    const std::vector<VoxelIndex>& whole = pieces.front();
    // before the cut: no sliver of a large one
    if (whole.size() < min_voxels || (max_voxels > 0 && whole.size() > max_voxels)) continue;
    if (config.max_extent_m > 0.0 && largest_extent_m(whole, geometry) > config.max_extent_m) {
      pieces = cut(whole, config.max_extent_m, geometry);
    }
    for (std::vector<VoxelIndex>& piece : pieces) {
      clusters.push_back(make_cluster(std::move(piece), geometry));
    }
  }
  return clusters;
}

std::vector<FrontierCluster> find_frontiers(const FrontierConfig& config, const OccupancyGrid& grid,
                                            const SurfaceCloud& cloud, FrontierMarks& marks) {
  return cluster_frontiers(config, grid.geometry(), frontier_voxels(config, grid, cloud, {}),
                           marks);
}

}  // namespace gnbv
