// What is believed about space: a dense block of float32 log-odds that follows OctoMap's update
// rule bit for bit. Questions are const; only apply() changes the belief.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/map/grid_geometry.hpp"
#include "planner/map/map_kernels.hpp"
#include "sim/core/zeroed_array.hpp"

namespace gnbv {

/// Defaults: OctoMap's sensor model, and the thresholds of the released configuration. Thresholds
/// are compared as float32 log-odds, so one miss (0.4) is free and one hit (0.7) occupied.
struct OccupancyConfig {
  double resolution_m = 0.2;
  double prob_hit = 0.7;
  double prob_miss = 0.4;
  double clamp_min = 0.1192;
  double clamp_max = 0.971;
  double occupied_min = 0.6;            // p >= this is occupied
  double free_max = 0.4;                // p <= this is free, between is unknown
  NoReturn no_return = NoReturn::free;  // of depth frames
};

/// octomap::logodds (octomap_utils.h)
float log_odds_of(double probability);

/// The voxels one scan touches, each once, occupied before free (OctoMap's computeUpdate).
struct ScanUpdate {
  std::vector<VoxelIndex> free;  // disjoint from occupied
  std::vector<VoxelIndex> occupied;
};

/// The object bounds of who has none.
inline const Box3 kEverywhere_m = {Vec3::Constant(-1e4), Vec3::Constant(1e4)};

class OccupancyGrid {
 public:
  /// `bounds_m` is the workspace: the grid holds nothing outside it. Voxels whose centres lie
  /// outside the object bounds have no entropy, and no view counts them. Throws BadInput naming the
  /// keys for probabilities out of order.
  OccupancyGrid(const OccupancyConfig& config, const Box3& bounds_m,
                const Box3& object_bounds_m = kEverywhere_m);

  const OccupancyConfig& config() const { return config_; }
  const GridGeometry& geometry() const { return geometry_; }

  /// Natural logarithm of the odds, float32 as in OctoMap; 0 while unmeasured.
  float log_odds(VoxelIndex v) const { return log_odds_[v]; }
  /// Whether any scan has touched the voxel (OctoMap: the node exists).
  bool is_measured(VoxelIndex v) const { return (words_[v] & kMeasuredBit) != 0; }
  VoxelState state(VoxelIndex v) const { return state_of(words_[v]); }
  /// Whether it lies in the object bounds.
  bool is_counted(VoxelIndex v) const { return (words_[v] & kOutsideBit) == 0; }
  /// State outside the grid is unknown.
  VoxelState state_at(const Vec3& p_world_m) const;

  /// Eq. (1) in nat; ln 2 while unmeasured, 0 at a clamping bound (released code: "ignore entropies
  /// at clamping points") and outside the object bounds.
  float entropy_nat(VoxelIndex v) const {
    return static_cast<float>(entropy_units_of(words_[v])) * static_cast<float>(kEntropyUnit_nat);
  }
  /// Sum of entropy_nat over all voxels, in units of 2^-32 nat, so that no order
  /// of updates changes it.
  double total_entropy_nat() const { return static_cast<double>(total_entropy_) * 0x1p-32; }
  std::size_t occupied_count() const { return occupied_count_; }
  /// Grows whenever the state of some voxel may have changed.
  std::uint64_t updates() const { return updates_; }

  /// Adds the log-odds of a miss to each free voxel and of a hit to each occupied one, clamped.
  void apply(const ScanUpdate& update);

  /// Gives a voxel that no scan has touched the log-odds it had in another grid like this one.
  /// False, and nothing changes, when one has, or when they are beyond the clamping bounds.
  [[nodiscard]] bool restore(VoxelIndex v, float log_odds);

  /// Marks the voxel as predicted to be surface (section 2.3) unless it has been measured or lies
  /// outside the object bounds; the first measurement takes the mark away. Returns whether it is
  /// marked now.
  bool predict(VoxelIndex v);
  bool is_predicted(VoxelIndex v) const { return (words_[v] & kPredictedBit) != 0; }
  std::size_t predicted_count() const { return predicted_count_; }

  /// Marks the voxel as within the shadow band (shadow_band.hpp) unless it has been measured; the
  /// first measurement takes the mark away. Returns whether it is marked now.
  bool shade(VoxelIndex v);
  bool is_shaded(VoxelIndex v) const { return (words_[v] & kShadowBit) != 0; }

  /// The word of free voxels at the lower clamping bound. A miss changes nothing of such a voxel,
  /// and its log-odds are settled_log_odds(). No other voxel has this word. With clamping bounds at
  /// which words do not tell these voxels from others, it is a word that no voxel has.
  VoxelWord settled_word() const { return settled_word_; }
  float settled_log_odds() const { return clamp_min_log_; }

  /// Rows for the hot loops; index with VoxelIndex. kPadding more words may be read.
  std::span<const VoxelWord> words() const {
    return std::span(words_).first(geometry_.voxel_count());
  }
  std::span<const float> all_log_odds() const { return log_odds_; }

 private:
  /// What a hit or a miss makes of a voxel's log-odds.
  struct Step {
    float before = 0.0F, after = 0.0F;
    VoxelWord word = 0;
    std::int64_t entropy_gain = 0;  // in 2^-32 nat
  };
  /// Steps last computed, by a hash of the log-odds: sums of hits and misses take few values.
  struct StepMemo {
    float delta = 0.0F;
    std::vector<Step> steps;
  };
  double entropy_nat_of(float log_odds) const;
  VoxelState state_of_log_odds(float log_odds) const;
  Step step_to(float after, float before) const;
  Step step_by(float delta, float before) const;
  void take_step(VoxelIndex v, const Step& step);
  void leave_out_but(const Box3& object_bounds_m);
  void add_log_odds(std::span<const VoxelIndex> voxels, StepMemo& memo);

  OccupancyConfig config_;
  GridGeometry geometry_;
  float clamp_min_log_ = 0.0F, clamp_max_log_ = 0.0F;
  float occupied_min_log_ = 0.0F, free_max_log_ = 0.0F;
  VoxelWord settled_word_ = 0;
  ZeroedArray<float> log_odds_;
  ZeroedArray<VoxelWord> words_;
  std::int64_t total_entropy_ = 0;  // in 2^-32 nat
  std::size_t occupied_count_ = 0, predicted_count_ = 0;
  std::uint64_t updates_ = 0;
  StepMemo hits_, misses_;
};

}  // namespace gnbv
