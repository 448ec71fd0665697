#include "planner/termination.hpp"

#include <cmath>
#include <cstddef>

namespace gnbv {

std::string_view name_of(Termination reason) {
  switch (reason) {
    case Termination::max_iterations:
      return "max_iterations";
    case Termination::entropy_change:
      return "entropy_change";
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

}  // namespace gnbv
