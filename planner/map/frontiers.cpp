#include "planner/map/frontiers.hpp"

#include <algorithm>
#include <map>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// All marked voxels within the neighbourhood of `seed`, directly or by way of others; takes their
/// marks away.
std::vector<VoxelIndex> connected_to(VoxelIndex seed, int reach, const GridGeometry& geometry,
                                     FrontierMarks& marks) {
  std::vector<VoxelIndex> voxels = {seed};
  marks[seed] = 0;
  for (std::size_t next = 0; next < voxels.size(); ++next) {
    const Box3 center_m(geometry.center_m(geometry.key_at(voxels[next])));
    for_each_key(geometry.keys_in(center_m, reach), [&](const Key& near) {
      const VoxelIndex v = geometry.index_of(near);
      if (marks[v] == 0) return;
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

std::vector<FrontierCluster> find_frontiers(const FrontierConfig& config, const OccupancyGrid& grid,
                                            const SurfaceCloud& cloud, FrontierMarks& marks) {
  const GridGeometry& geometry = grid.geometry();
  GNBV_CHECK(marks.size() == geometry.voxel_count(), "{} marks for {} voxels", marks.size(),
             geometry.voxel_count());
  std::vector<VoxelIndex> frontier;
  for (const VoxelIndex v : cloud.voxels()) {
    if (is_frontier(config, grid, cloud, v)) frontier.push_back(v);
  }
  std::sort(frontier.begin(), frontier.end());
  for (const VoxelIndex v : frontier) marks[v] = 1;

  const auto min_voxels = static_cast<std::size_t>(config.min_cluster_voxels);
  std::vector<FrontierCluster> clusters;
  for (const VoxelIndex seed : frontier) {
    if (marks[seed] == 0) continue;
    std::vector<std::vector<VoxelIndex>> pieces = {
        connected_to(seed, config.neighbour_voxels, geometry, marks)};
    const std::vector<VoxelIndex>& whole = pieces.front();
    if (whole.size() < min_voxels) continue;  // before the cut: no sliver of a large one
    if (config.max_extent_m > 0.0 && largest_extent_m(whole, geometry) > config.max_extent_m) {
      pieces = cut(whole, config.max_extent_m, geometry);
    }
    for (std::vector<VoxelIndex>& piece : pieces) {
      Vec3 sum_m = Vec3::Zero();
      for (const VoxelIndex v : piece) sum_m += geometry.center_m(geometry.key_at(v));
      const Vec3 centroid_m = sum_m / static_cast<double>(piece.size());
      clusters.push_back({std::move(piece), centroid_m});
    }
  }
  return clusters;
}

}  // namespace gnbv
