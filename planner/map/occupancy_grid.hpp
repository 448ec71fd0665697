// What is believed about space: a dense block of float32 log-odds that follows OctoMap's update
// rule bit for bit. Questions are const; only apply() changes the belief.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/map/grid_geometry.hpp"

namespace gnbv {

/// Defaults: OctoMap's sensor model, and the thresholds of the released configuration.
struct OccupancyConfig {
  double resolution_m = 0.2;
  double prob_hit = 0.7;
  double prob_miss = 0.4;
  double clamp_min = 0.1192;
  double clamp_max = 0.971;
  double occupied_min = 0.6;   // p >= this is occupied
  double free_max = 0.4;       // p <= this is free, between is unknown
};

enum class VoxelState : std::uint8_t { unknown = 0, free = 1, occupied = 2 };

/// The voxels one scan touches, each once, occupied before free (OctoMap's computeUpdate).
struct ScanUpdate {
  std::vector<VoxelIndex> free;      // disjoint from occupied
  std::vector<VoxelIndex> occupied;
};

class OccupancyGrid {
 public:
  /// `bounds_m` is the workspace: the grid holds nothing outside it.
  OccupancyGrid(const OccupancyConfig& config, const Box3& bounds_m);

  const OccupancyConfig& config() const { return config_; }
  const GridGeometry& geometry() const { return geometry_; }

  /// Natural logarithm of the odds, float32 as in OctoMap; 0 while unmeasured.
  float log_odds(VoxelIndex v) const { return log_odds_[v]; }
  /// Whether any scan has touched the voxel (OctoMap: the node exists).
  bool is_measured(VoxelIndex v) const { return measured_[v] != 0; }
  VoxelState state(VoxelIndex v) const { return state_[v]; }
  /// State outside the grid is unknown.
  VoxelState state_at(const Vec3& p_world_m) const;
  double probability(VoxelIndex v) const;

  /// Eq. (1) in nat; ln 2 while unmeasured, 0 at a clamping bound (released code: "ignore entropies
  /// at clamping points").
  float entropy_nat(VoxelIndex v) const { return entropy_nat_[v]; }
  /// Sum of Eq. (1) over all voxels of the workspace, clamped ones at their own small value;
  /// kept up to date by apply().
  double total_entropy_nat() const { return total_entropy_nat_; }
  std::size_t occupied_count() const { return occupied_count_; }

  /// Adds the log-odds of a miss to each free voxel and of a hit to each occupied one, clamped.
  void apply(const ScanUpdate& update);

  /// Row pointers for the hot loops; index with VoxelIndex.
  std::span<const VoxelState> states() const { return state_; }
  std::span<const float> entropies_nat() const { return entropy_nat_; }
  std::span<const float> all_log_odds() const { return log_odds_; }

 private:
  void add_log_odds(VoxelIndex v, float delta);

  OccupancyConfig config_;
  GridGeometry geometry_;
  float hit_log_ = 0.0F, miss_log_ = 0.0F;
  float clamp_min_log_ = 0.0F, clamp_max_log_ = 0.0F;
  float occupied_min_log_ = 0.0F, free_max_log_ = 0.0F;
  std::vector<float> log_odds_;
  std::vector<std::uint8_t> measured_;
  std::vector<VoxelState> state_;
  std::vector<float> entropy_nat_;
  double total_entropy_nat_ = 0.0;
  std::size_t occupied_count_ = 0;
};

}  // namespace gnbv
