#include "planner/core/termination.hpp"

#include <cmath>
#include <cstddef>

namespace gnbv {

std::string_view name_of(Termination reason) {
  switch (reason) {
    case Termination::max_iterations:
      return "max_iterations";
    case Termination::max_distance:
      return "max_distance";
    case Termination::max_flight_time:
      return "max_flight_time";
    case Termination::entropy_change:
      return "entropy_change";
    case Termination::low_gain:
      return "low_gain";
    case Termination::no_new_points:
      return "no_new_points";
    case Termination::no_valid_view:
      return "no_valid_view";
    case Termination::repeated_motion:
      return "repeated_motion";
    case Termination::battery:
      return "battery";
    case Termination::route_flown:
      return "route_flown";
    case Termination::off_course:
      return "off_course";
    case Termination::tour_complete:
      return "tour_complete";
    case Termination::coverage_reached:
      return "coverage_reached";
    case Termination::utility_failed:
      return "utility_failed";
    case Termination::interrupted:
      return "interrupted";
    case Termination::collision:
      return "collision";
  }
  return "unknown";
}

bool entropy_has_settled(const TerminationConfig& config, std::span<const double> entropies_nat) {
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

bool gain_is_low(const TerminationConfig& config, std::span<const MapProgress> progress) {
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

bool points_have_dried_up(const TerminationConfig& config, std::span<const MapProgress> progress) {
  const auto views = static_cast<std::size_t>(config.max_views_without_new_points);
  if (views == 0 || progress.size() < views + 1) return false;
  return progress.back().cloud_points == progress[progress.size() - 1 - views].cloud_points;
}

bool is_too_far(const TerminationConfig& config, double straight_m, double leg_m) {
  return config.max_distance_m > 0.0 && straight_m + leg_m > config.max_distance_m;
}

bool is_back_and_forth(std::span<const Vec3> positions_m, int moves) {
  constexpr double kSame_m = 0.01;
  const auto count = static_cast<std::size_t>(moves);
  if (moves <= 0 || positions_m.size() < count + 2) return false;
  for (std::size_t i = positions_m.size() - count; i < positions_m.size(); ++i) {
    if ((positions_m[i] - positions_m[i - 2]).norm() > kSame_m) return false;
    if ((positions_m[i] - positions_m[i - 1]).norm() <= kSame_m) return false;
  }
  return true;
}

std::optional<Termination> believed_end(const TerminationConfig& config, const EndRules& rules,
                                        std::span<const double> entropies_nat,
                                        std::span<const MapProgress> progress,
                                        std::span<const Vec3> positions_m) {
  if (rules.entropy && entropy_has_settled(config, entropies_nat)) {
    return Termination::entropy_change;
  }
  if (rules.gain && gain_is_low(config, progress)) return Termination::low_gain;
  if (rules.gain && points_have_dried_up(config, progress)) return Termination::no_new_points;
  if (rules.repetition && is_back_and_forth(positions_m, config.repeated_moves)) {
    return Termination::repeated_motion;
  }
  return std::nullopt;
}

}  // namespace gnbv
