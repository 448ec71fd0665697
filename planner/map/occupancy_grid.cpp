#include "planner/map/occupancy_grid.hpp"

#include <bit>
#include <cmath>
#include <numbers>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr double kTotalUnits = 4294967296.0;  // per nat
constexpr int kMemoBits = 12;

/// octomap::logodds (octomap_utils.h)
float log_odds_of(double probability) {
  return static_cast<float>(std::log(probability / (1.0 - probability)));
}

void need_between(const char* key, double value, double low, double high) {
  if (!(low < value && value < high)) {
    throw BadInput(fmt::format("{}: {} is not between {} and {}", key, value, low, high));
  }
}

void need_usable(const OccupancyConfig& c) {
  need_between("prob_hit", c.prob_hit, 0.5, 1.0);
  need_between("prob_miss", c.prob_miss, 0.0, 0.5);
  need_between("clamp_min", c.clamp_min, 0.0, 0.5);
  need_between("clamp_max", c.clamp_max, 0.5, 1.0);
  need_between("free_max", c.free_max, 0.0, 1.0);
  need_between("occupied_min", c.occupied_min, c.free_max, 1.0);
}

}  // namespace

OccupancyGrid::OccupancyGrid(const OccupancyConfig& config, const Box3& bounds_m)
    : config_(config), geometry_(bounds_m, config.resolution_m) {
  need_usable(config);
  hit_log_ = log_odds_of(config.prob_hit);
  miss_log_ = log_odds_of(config.prob_miss);
  clamp_min_log_ = log_odds_of(config.clamp_min);
  clamp_max_log_ = log_odds_of(config.clamp_max);
  occupied_min_log_ = log_odds_of(config.occupied_min);
  free_max_log_ = log_odds_of(config.free_max);
  const Entropy unmeasured = compute_entropy(0.0F);
  entropy_memo_.assign(std::size_t{1} << kMemoBits, unmeasured);
  const std::size_t voxels = geometry_.voxel_count();
  log_odds_ = ZeroedArray<float>(voxels);
  words_ = ZeroedArray<VoxelWord>(voxels);
  total_entropy_ = unmeasured.units * static_cast<std::int64_t>(voxels);
}

VoxelState OccupancyGrid::state_at(const Vec3& p_world_m) const {
  const Key key = geometry_.key_of(p_world_m);
  return geometry_.contains(key) ? state(geometry_.index_of(key)) : VoxelState::unknown;
}

double OccupancyGrid::probability(VoxelIndex v) const {
  return 1.0 - 1.0 / (1.0 + std::exp(static_cast<double>(log_odds_[v])));
}

double OccupancyGrid::total_entropy_nat() const {
  return static_cast<double>(total_entropy_) / kTotalUnits;
}

OccupancyGrid::Entropy OccupancyGrid::compute_entropy(float log_odds) const {
  if (is_clamped(log_odds)) return {.log_odds = log_odds};
  // Eq. (1) in terms of l = |log-odds|, where p = 1 / (1 + e^-l) cannot round to 0 or 1
  const double l = std::fabs(static_cast<double>(log_odds));
  const double e = std::exp(-l);
  const double entropy_nat = std::log1p(e) + l * e / (1.0 + e);
  return {.log_odds = log_odds,
          .word_units = static_cast<std::uint32_t>(std::llround(entropy_nat / kEntropyUnit_nat)),
          .units = std::llround(entropy_nat * kTotalUnits)};
}

const OccupancyGrid::Entropy& OccupancyGrid::entropy_of(float log_odds) {
  const std::uint32_t hash = std::bit_cast<std::uint32_t>(log_odds) * 0x9e3779b1U;
  Entropy& memo = entropy_memo_[hash >> (32 - kMemoBits)];
  if (memo.log_odds != log_odds) memo = compute_entropy(log_odds);
  return memo;
}

void OccupancyGrid::add_log_odds(VoxelIndex v, float delta) {
  const float before = log_odds_[v];
  float after = before + delta;
  if (after < clamp_min_log_) after = clamp_min_log_;
  if (after > clamp_max_log_) after = clamp_max_log_;
  if (after == before) return;  // at a bound, hence measured
  set_log_odds(v, after);
}

void OccupancyGrid::set_log_odds(VoxelIndex v, float after) {
  total_entropy_ -= entropy_of(log_odds_[v]).units;
  const Entropy& entropy = entropy_of(after);
  total_entropy_ += entropy.units;
  const VoxelState now = after >= occupied_min_log_ ? VoxelState::occupied
                         : after <= free_max_log_   ? VoxelState::free
                                                    : VoxelState::unknown;
  occupied_count_ += static_cast<std::size_t>(now == VoxelState::occupied);
  occupied_count_ -= static_cast<std::size_t>(state(v) == VoxelState::occupied);
  predicted_count_ -= static_cast<std::size_t>(is_predicted(v));
  log_odds_[v] = after;
  words_[v] = measured_word(now, entropy.word_units);
}

bool OccupancyGrid::restore(VoxelIndex v, float log_odds) {
  if (is_measured(v) || !(log_odds >= clamp_min_log_ && log_odds <= clamp_max_log_)) return false;
  set_log_odds(v, log_odds);
  return true;
}

bool OccupancyGrid::predict(VoxelIndex v) {
  if (is_measured(v)) return false;
  predicted_count_ += static_cast<std::size_t>(!is_predicted(v));
  words_[v] |= kPredictedBit;
  return true;
}

bool OccupancyGrid::shade(VoxelIndex v) {
  if (is_measured(v)) return false;
  words_[v] |= kShadowBit;
  return true;
}

void OccupancyGrid::apply(const ScanUpdate& update) {
  for (const VoxelIndex v : update.free) add_log_odds(v, miss_log_);
  for (const VoxelIndex v : update.occupied) add_log_odds(v, hit_log_);
}

}  // namespace gnbv
