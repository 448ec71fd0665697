#include "planner/map/occupancy_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr int kMemoBits = 12;

std::int64_t total_units(double nat) { return std::llround(nat * 0x1p32); }
std::uint32_t word_units(double nat) {
  return static_cast<std::uint32_t>(std::llround(nat / kEntropyUnit_nat));
}

void need_between(const char* key, double value, double low, double high) {
  if (!(low < value && value < high)) {
    throw BadInput(fmt::format("{}: {} is not between {} and {}", key, value, low, high));
  }
}

}  // namespace

float log_odds_of(double probability) {
  return static_cast<float>(std::log(probability / (1.0 - probability)));
}

OccupancyGrid::OccupancyGrid(const OccupancyConfig& config, const Box3& bounds_m,
                             const Box3& object_bounds_m)
    : config_(config), geometry_(bounds_m, config.resolution_m) {
  need_between("prob_hit", config.prob_hit, 0.5, 1.0);
  need_between("prob_miss", config.prob_miss, 0.0, 0.5);
  need_between("clamp_min", config.clamp_min, 0.0, 0.5);
  need_between("clamp_max", config.clamp_max, 0.5, 1.0);
  need_between("free_max", config.free_max, 0.0, 1.0);
  need_between("occupied_min", config.occupied_min, config.free_max, 1.0);
  clamp_min_log_ = log_odds_of(config.clamp_min);
  clamp_max_log_ = log_odds_of(config.clamp_max);
  occupied_min_log_ = log_odds_of(config.occupied_min);
  free_max_log_ = log_odds_of(config.free_max);
  // at bounds so wide that the entropy is 0 before them, words do not tell which voxels are at them
  const auto has_entropy_within = [&](float bound) {
    return word_units(entropy_nat_of(std::nextafter(bound, 0.0F))) > 0;
  };
  const bool is_told = has_entropy_within(clamp_min_log_) && has_entropy_within(clamp_max_log_) &&
                       state_of_log_odds(clamp_min_log_) == VoxelState::free &&
                       state_of_log_odds(clamp_max_log_) != VoxelState::free;
  settled_word_ = is_told ? measured_word(VoxelState::free, 0) : kStateMask;  // which is no state
  for (const auto& [memo, probability] :
       {std::pair(&hits_, config.prob_hit), std::pair(&misses_, config.prob_miss)}) {
    memo->delta = log_odds_of(probability);
    memo->steps.assign(std::size_t{1} << kMemoBits, step_by(memo->delta, 0.0F));
  }
  const std::size_t voxels = geometry_.voxel_count();
  log_odds_ = ZeroedArray<float>(voxels);
  words_ = ZeroedArray<VoxelWord>(voxels + kPadding);
  total_entropy_ = total_units(entropy_nat_of(0.0F)) * static_cast<std::int64_t>(voxels);
  if (!object_bounds_m.contains(bounds_m)) leave_out_but(object_bounds_m);
}

void OccupancyGrid::leave_out_but(const Box3& object_bounds_m) {
  const auto voxels = static_cast<VoxelIndex>(geometry_.voxel_count());
  for (VoxelIndex v = 0; v < voxels; ++v) {
    if (object_bounds_m.contains(geometry_.center_m(geometry_.key_at(v)))) continue;
    words_[v] = kOutsideBit | kLn2Units << kKnownShift;
    total_entropy_ -= total_units(entropy_nat_of(0.0F));
  }
}

VoxelState OccupancyGrid::state_at(const Vec3& p_world_m) const {
  const Key key = geometry_.key_of(p_world_m);
  return geometry_.contains(key) ? state(geometry_.index_of(key)) : VoxelState::unknown;
}

double OccupancyGrid::entropy_nat_of(float log_odds) const {
  if (log_odds <= clamp_min_log_ || log_odds >= clamp_max_log_) return 0.0;
  // Eq. (1) in terms of l = |log-odds|, where p = 1 / (1 + e^-l) cannot round to 0 or 1
  const double l = std::fabs(static_cast<double>(log_odds));
  const double e = std::exp(-l);
  return std::log1p(e) + l * e / (1.0 + e);
}

VoxelState OccupancyGrid::state_of_log_odds(float log_odds) const {
  if (log_odds >= occupied_min_log_) return VoxelState::occupied;
  return log_odds <= free_max_log_ ? VoxelState::free : VoxelState::unknown;
}

OccupancyGrid::Step OccupancyGrid::step_to(float after, float before) const {
  const double entropy_nat = entropy_nat_of(after);
  return {.before = before,
          .after = after,
          .word = measured_word(state_of_log_odds(after), word_units(entropy_nat)),
          .entropy_gain = total_units(entropy_nat) - total_units(entropy_nat_of(before))};
}

OccupancyGrid::Step OccupancyGrid::step_by(float delta, float before) const {
  return step_to(std::clamp(before + delta, clamp_min_log_, clamp_max_log_), before);
}

void OccupancyGrid::take_step(VoxelIndex v, const Step& step) {
  const auto is_occupied = [](VoxelWord word) { return state_of(word) == VoxelState::occupied; };
  const VoxelWord word = words_[v];
  const bool is_counted = (word & kOutsideBit) == 0;
  if (is_counted) total_entropy_ += step.entropy_gain;
  occupied_count_ += is_occupied(step.word) - is_occupied(word);
  predicted_count_ -= (word & kPredictedBit) != 0;
  log_odds_[v] = step.after;
  words_[v] = is_counted ? step.word : kOutsideBit | measured_word(state_of(step.word), 0);
}

void OccupancyGrid::add_log_odds(std::span<const VoxelIndex> voxels, StepMemo& memo) {
  for (const VoxelIndex v : voxels) {
    const float before = log_odds_[v];
    const std::uint32_t hash = std::bit_cast<std::uint32_t>(before) * 0x9e3779b1U;
    Step& step = memo.steps[hash >> (32 - kMemoBits)];
    if (step.before != before) step = step_by(memo.delta, before);
    if (step.after != before) take_step(v, step);  // else at a bound, hence measured
  }
}

bool OccupancyGrid::restore(VoxelIndex v, float log_odds) {
  if (is_measured(v) || !(log_odds >= clamp_min_log_ && log_odds <= clamp_max_log_)) return false;
  take_step(v, step_to(log_odds, log_odds_[v]));
  ++updates_;
  return true;
}

bool OccupancyGrid::predict(VoxelIndex v) {
  if (is_measured(v) || !is_counted(v)) return false;
  predicted_count_ += !is_predicted(v);
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
  ++updates_;
}

}  // namespace gnbv
