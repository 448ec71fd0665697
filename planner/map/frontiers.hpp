// Density frontiers: where the surface is seen but thinly sampled (paper section 2.4, Fig. 6).
#pragma once

#include <span>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/map/surface_cloud.hpp"

namespace gnbv {

/// Which frontier voxels are neighbours. `pcl`: those that share a face, if their centres are
/// nearer than a voxel in float32. PCL's Euclidean clusters with a tolerance of one voxel come out
/// so: which faces join is a matter of rounding.
enum class FrontierLinking { face, chebyshev, pcl };

/// Defaults: the paper's code (density below 100 of 300, 5 to 1,000 voxels); cutting is our own,
/// see FIDELITY.md.
struct FrontierConfig {
  double density_share = 1.0 / 3.0;  // frontier: 0 < density < this share of density_max()
  bool occupied_only = false;        // and the voxel is occupied, not only full of points
  FrontierLinking linking = FrontierLinking::pcl;
  int neighbour_voxels = 2;  // chebyshev: distance that joins two voxels
  int min_cluster_voxels = 5;
  int max_cluster_voxels = 1000;  // larger ones are left out; 0: none is
  double max_extent_m = 0.0;      // clusters larger along any axis are cut; 0: never
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

/// The cluster of these voxels, which are sorted.
FrontierCluster make_cluster(std::vector<VoxelIndex> voxels, const GridGeometry& geometry);

/// The voxels of all of them, ascending, each once.
std::vector<VoxelIndex> voxels_of(std::span<const FrontierCluster> clusters);

/// All frontier voxels but those of which `ignored` holds 1, ascending. Empty: none is ignored.
std::vector<VoxelIndex> frontier_voxels(const FrontierConfig& config, const OccupancyGrid& grid,
                                        const SurfaceCloud& cloud, const FrontierMarks& ignored);

/// The clusters of these voxels (ascending) in the order of their first ones. Smaller and larger
/// ones than the configuration says are left out; of the others, one larger than max_extent_m along
/// any axis is cut along the world lattice of that size, into pieces of any size: no voxel is lost.
std::vector<FrontierCluster> cluster_frontiers(const FrontierConfig& config,
                                               const GridGeometry& geometry,
                                               const std::vector<VoxelIndex>& frontier,
                                               FrontierMarks& marks);

/// The clusters of all frontier voxels.
std::vector<FrontierCluster> find_frontiers(const FrontierConfig& config, const OccupancyGrid& grid,
                                            const SurfaceCloud& cloud, FrontierMarks& marks);

}  // namespace gnbv
