// The settings of the map and of what is read out of it, without the map itself.
#pragma once

namespace gnbv {

/// Defaults: OctoMap's sensor model, and the thresholds of the released configuration. Thresholds
/// are compared as float32 log-odds, so one miss (0.4) is free and one hit (0.7) occupied.
struct OccupancyConfig {
  double resolution_m = 0.2;
  double prob_hit = 0.7;
  double prob_miss = 0.4;
  double clamp_min = 0.1192;
  double clamp_max = 0.971;
  double occupied_min = 0.6;  // p >= this is occupied
  double free_max = 0.4;      // p <= this is free, between is unknown
};

/// Defaults: the released filter sizes.
struct CloudConfig {
  double leaf_m = 0.02;         // RGBD points
  double profile_leaf_m = 0.1;  // LIDAR points
};

/// Defaults: the released configuration (density below 100 of 300, neighbours up to 2 voxels away,
/// at least 5 voxels); cutting is our own, see FIDELITY.md.
struct FrontierConfig {
  double density_share = 1.0 / 3.0;  // frontier: 0 < density < this share of density_max()
  bool occupied_only = true;         // and the voxel is occupied, not only full of points
  int neighbour_voxels = 2;          // Chebyshev distance that joins two voxels
  int min_cluster_voxels = 5;
  double max_extent_m = 2.0;  // clusters larger along any axis are cut; 0: never
};

}  // namespace gnbv
