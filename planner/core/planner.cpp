#include "planner/core/planner.hpp"

#include <algorithm>
#include <cmath>

#include "planner/motion/paths.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// Whether each of the last entropy_window views changed the total entropy by less than
/// entropy_change_percent: 100 |E_n - E_n-1| / mean(E_n, E_n-1).
bool has_entropy_settled(const TerminationConfig& config, std::span<const double> entropies_nat) {
  const auto window = static_cast<std::size_t>(config.entropy_window);
  if (config.entropy_change_percent <= 0.0 || entropies_nat.size() < window + 1) return false;
  const std::span<const double> recent = entropies_nat.last(window + 1);
  for (std::size_t i = 1; i < recent.size(); ++i) {
    const double mean_nat = 0.5 * (recent[i] + recent[i - 1]);
    const double change_percent = 100.0 * std::fabs(recent[i] - recent[i - 1]) / mean_nat;
    // negated, so that 0 / 0 counts as settled: no entropy is left
    if (change_percent >= config.entropy_change_percent) return false;
  }
  return true;
}

/// Whether the last new_voxels_window views together made too few voxels occupied for their metres.
bool is_gain_low(const TerminationConfig& config, std::span<const MapProgress> progress) {
  const auto window = static_cast<std::size_t>(config.new_voxels_window);
  if (config.min_new_voxels_per_m <= 0.0 || progress.size() < window + 1) return false;
  const MapProgress& from = progress[progress.size() - 1 - window];
  const MapProgress& to = progress.back();
  // noise can free a voxel again: the difference may be negative
  const double voxels =
      static_cast<double>(to.occupied_voxels) - static_cast<double>(from.occupied_voxels);
  const double metres = to.straight_m - from.straight_m;
  return metres > 0.0 && voxels < config.min_new_voxels_per_m * metres;
}

/// Whether none of the last max_views_without_new_points views added a point to the cloud.
bool are_points_old(const TerminationConfig& config, std::span<const MapProgress> progress) {
  const auto views = static_cast<std::size_t>(config.max_views_without_new_points);
  if (views == 0 || progress.size() < views + 1) return false;
  return progress.back().cloud_points == progress[progress.size() - 1 - views].cloud_points;
}

}  // namespace

void remember_start(const Belief& belief, History& history) {
  history.entropies_nat = {belief.grid.total_entropy_nat()};
}

void remember(const Decision& taken, const Belief& belief, double straight_m, History& history) {
  if (!belief.has_depth_return) history.entropies_nat.clear();
  history.entropies_nat.push_back(belief.grid.total_entropy_nat());
  history.decisions.push_back(taken);
  history.progress.push_back({.occupied_voxels = belief.grid.occupied_count(),
                              .cloud_points = belief.cloud.points_world_m().size(),
                              .straight_m = straight_m});
}

double planned_m(const History& history, const Vec3& from_world_m, const Decision& next) {
  const double so_far_m = history.progress.empty() ? 0.0 : history.progress.back().straight_m;
  return so_far_m + path_length_m(from_world_m, next.via_world_m, next.view.p_world_m);
}

std::vector<ViewPose> recent_views(const History& history, int count) {
  const std::span<const Decision> all = history.decisions;
  std::vector<ViewPose> recent;
  for (const Decision& decision : all.last(std::min(all.size(), static_cast<std::size_t>(count)))) {
    recent.push_back(decision.view);
  }
  return recent;
}

bool is_back_and_forth(RepeatedBy repeated_by, std::span<const Decision> decisions, int moves) {
  constexpr double kSame_m = 0.01;
  const auto count = static_cast<std::size_t>(moves);
  if (repeated_by == RepeatedBy::utilities) {
    if (moves <= 2 || decisions.size() <= count) return false;
    const std::span<const Decision> last = decisions.last(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (!traits_of(last[i].sampler).is_scored) return false;
      if (i >= 2 && last[i].score.value != last[i - 2].score.value) return false;
    }
    return true;
  }
  if (moves <= 0 || decisions.size() < count + 2) return false;
  const auto moved_m = [&](std::size_t from, std::size_t to) {
    return (decisions[to].view.p_world_m - decisions[from].view.p_world_m).norm();
  };
  for (std::size_t i = decisions.size() - count; i < decisions.size(); ++i) {
    if (moved_m(i - 2, i) > kSame_m || moved_m(i - 1, i) <= kSame_m) return false;
  }
  return true;
}

std::optional<Termination> end_after_view(const TerminationConfig& config, const EndRules& rules,
                                          const History& history) {
  const bool are_enough =
      history.decisions.size() >= static_cast<std::size_t>(config.max_iterations);
  if (!config.within_plans && !history.ahead.empty()) return std::nullopt;
  if (are_enough) return Termination::max_iterations;
  if (rules.entropy && has_entropy_settled(config, history.entropies_nat)) {
    return Termination::entropy_change;
  }
  if (rules.gain && is_gain_low(config, history.progress)) return Termination::low_gain;
  if (rules.gain && are_points_old(config, history.progress)) return Termination::no_new_points;
  if (rules.repetition &&
      is_back_and_forth(config.repeated_by, history.decisions, config.repeated_moves)) {
    return Termination::repeated_motion;
  }
  return std::nullopt;
}

std::variant<Decision, Termination> next_decision(const TerminationConfig& config,
                                                  const ViewPose& current, History& history,
                                                  const std::function<Plan()>& make_plan) {
  if (history.ahead.empty()) {
    Plan plan = make_plan();
    if (!plan.has_view()) return plan.end;
    for (int number = 1; Decision & view : plan.views) view.plan_view = number++;
    history.ahead.assign(plan.views.rbegin(), plan.views.rend());
  }
  Decision next = history.ahead.back();
  const bool is_too_far = config.max_distance_m > 0.0 &&
                          planned_m(history, current.p_world_m, next) > config.max_distance_m;
  if (is_too_far) return Termination::max_distance;
  history.ahead.pop_back();
  return next;
}

Plan Planner::replay(std::span<const Decision> recorded, const Belief&, const History&,
                     const ViewPose&, Scratch&) {
  Plan plan;
  plan.views = {recorded.front()};
  return plan;
}

void need_as_recorded(const Plan& plan, std::span<const Decision> recorded, std::size_t iteration) {
  const std::size_t count = std::clamp(plan.views.size(), std::size_t{1}, recorded.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (i < plan.views.size() && is_same_view(plan.views[i].view, recorded[i].view)) continue;
    throw BadInput(fmt::format(
        "view {}: what is decided anew is another view than was recorded: another version of the "
        "program, another mesh or another planner made this run; fly it anew",
        iteration + i));
  }
}

}  // namespace gnbv
