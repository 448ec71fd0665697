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
  clamp_min_log_ = log_odds_of(config.clamp_min);
  clamp_max_log_ = log_odds_of(config.clamp_max);
  occupied_min_log_ = log_odds_of(config.occupied_min);
  free_max_log_ = log_odds_of(config.free_max);
  settled_word_ = compute_settled_word();
  hits_ = make_memo(log_odds_of(config.prob_hit));
  misses_ = make_memo(log_odds_of(config.prob_miss));
  const std::size_t voxels = geometry_.voxel_count();
  log_odds_ = ZeroedArray<float>(voxels);
  words_ = ZeroedArray<VoxelWord>(voxels + kWordPadding);
  total_entropy_ = compute_entropy(0.0F).units * static_cast<std::int64_t>(voxels);
}

VoxelState OccupancyGrid::state_at(const Vec3& p_world_m) const {
  const Key key = geometry_.key_of(p_world_m);
  return geometry_.contains(key) ? state(geometry_.index_of(key)) : VoxelState::unknown;
}

double OccupancyGrid::total_entropy_nat() const {
  return static_cast<double>(total_entropy_) / kTotalUnits;
}

OccupancyGrid::Entropy OccupancyGrid::compute_entropy(float log_odds) const {
  if (is_clamped(log_odds)) return {};
  // Eq. (1) in terms of l = |log-odds|, where p = 1 / (1 + e^-l) cannot round to 0 or 1
  const double l = std::fabs(static_cast<double>(log_odds));
  const double e = std::exp(-l);
  const double entropy_nat = std::log1p(e) + l * e / (1.0 + e);
  return {.word_units = static_cast<std::uint32_t>(std::llround(entropy_nat / kEntropyUnit_nat)),
          .units = std::llround(entropy_nat * kTotalUnits)};
}

VoxelState OccupancyGrid::state_of_log_odds(float log_odds) const {
  if (log_odds >= occupied_min_log_) return VoxelState::occupied;
  return log_odds <= free_max_log_ ? VoxelState::free : VoxelState::unknown;
}

VoxelWord OccupancyGrid::compute_settled_word() const {
  constexpr auto kNoWord = static_cast<VoxelWord>(kStateMask);  // no state
  const auto has_entropy_within = [&](float bound) {
    return compute_entropy(std::nextafter(bound, 0.0F)).word_units > 0;
  };
  // at bounds so wide that the entropy is 0 before them, words do not tell which voxels are at them
  const bool is_told = has_entropy_within(clamp_min_log_) && has_entropy_within(clamp_max_log_) &&
                       state_of_log_odds(clamp_min_log_) == VoxelState::free &&
                       state_of_log_odds(clamp_max_log_) != VoxelState::free;
  return is_told ? measured_word(VoxelState::free, 0) : kNoWord;
}

OccupancyGrid::Step OccupancyGrid::compute_step(float before, float delta) const {
  float after = before + delta;
  if (after < clamp_min_log_) after = clamp_min_log_;
  if (after > clamp_max_log_) after = clamp_max_log_;
  return make_step(before, after);
}

OccupancyGrid::Step OccupancyGrid::make_step(float before, float after) const {
  const Entropy entropy = compute_entropy(after);
  return {.before = before,
          .after = after,
          .word = measured_word(state_of_log_odds(after), entropy.word_units),
          .entropy_gain = entropy.units - compute_entropy(before).units};
}

OccupancyGrid::StepMemo OccupancyGrid::make_memo(float delta) const {
  const std::size_t size = std::size_t{1} << kMemoBits;
  return {.delta = delta, .steps = std::vector<Step>(size, compute_step(0.0F, delta))};
}

const OccupancyGrid::Step& OccupancyGrid::step_from(float before, StepMemo& memo) const {
  const std::uint32_t hash = std::bit_cast<std::uint32_t>(before) * 0x9e3779b1U;
  Step& step = memo.steps[hash >> (32 - kMemoBits)];
  if (step.before != before) step = compute_step(before, memo.delta);
  return step;
}

void OccupancyGrid::take_step(VoxelIndex v, const Step& step) {
  const auto is_occupied = [](VoxelWord word) {
    return static_cast<std::size_t>(state_of(word) == VoxelState::occupied);
  };
  const VoxelWord word = words_[v];
  total_entropy_ += step.entropy_gain;
  occupied_count_ += is_occupied(step.word) - is_occupied(word);
  predicted_count_ -= static_cast<std::size_t>((word & kPredictedBit) != 0);
  log_odds_[v] = step.after;
  words_[v] = step.word;
}

void OccupancyGrid::add_log_odds(std::span<const VoxelIndex> voxels, StepMemo& memo) {
  for (const VoxelIndex v : voxels) {
    const Step& step = step_from(log_odds_[v], memo);
    if (step.after == step.before) continue;  // at a bound, hence measured
    take_step(v, step);
  }
}

bool OccupancyGrid::restore(VoxelIndex v, float log_odds) {
  if (is_measured(v) || !(log_odds >= clamp_min_log_ && log_odds <= clamp_max_log_)) return false;
  take_step(v, make_step(log_odds_[v], log_odds));
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
  add_log_odds(update.free, misses_);
  add_log_odds(update.occupied, hits_);
}

}  // namespace gnbv
