// Density frontiers: where the surface is seen but thinly sampled (paper section 2.4, Fig. 6).
#pragma once

#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/map/surface_cloud.hpp"

namespace gnbv {

/// Defaults: the released configuration (density below 100 of 300, neighbours up to 2 voxels away,
/// at least 5 voxels); cutting is our own, see FIDELITY.md.
struct FrontierConfig {
  double density_share = 1.0 / 3.0;  // frontier: 0 < density < this share of density_max()
  bool occupied_only = true;         // and the voxel is occupied, not only full of points
  int neighbour_voxels = 2;          // Chebyshev distance that joins two voxels
  int min_cluster_voxels = 5;
  double max_extent_m = 2.0;  // clusters larger along any axis are cut; 0: never
};

/// Whether the voxel's density is below the bound, but not 0, and it is occupied. Without
/// `occupied_only` points will do: those of thin parts lie in voxels that other rays cleared.
bool is_frontier(const FrontierConfig& config, const OccupancyGrid& grid, const SurfaceCloud& cloud,
                 VoxelIndex v);

/// Connected frontier voxels, in ascending order.
struct FrontierCluster {
  std::vector<VoxelIndex> voxels;
  Vec3 centroid_world_m = Vec3::Zero();  // of the voxels' centres
};

/// Memory of find_frontiers(), a byte a voxel; all zero between calls.
using FrontierMarks = ZeroedArray<std::uint8_t>;

/// The clusters in the order of their first voxels. Those of fewer than min_cluster_voxels are left
/// out; of the others, one larger than max_extent_m along any axis is cut along the world lattice
/// of that size, into pieces of any size: no voxel is lost.
std::vector<FrontierCluster> find_frontiers(const FrontierConfig& config, const OccupancyGrid& grid,
                                            const SurfaceCloud& cloud, FrontierMarks& marks);

}  // namespace gnbv
