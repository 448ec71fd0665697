#include "tools/run/margin_note.hpp"

#include <fmt/format.h>

namespace gnbv {

std::string margin_note(const Scenario& scenario, const PathError& error) {
  const double radius_m = scenario.planner.validity.collision_radius_m;
  const double hull_m = scenario.vehicle.airframe.hull_radius_m;
  if (radius_m <= hull_m || error.max_m <= radius_m - hull_m) return "";
  return fmt::format(
      "the vehicle was up to {:.2f} m off its path, more than the {:.2f} m that are kept free "
      "beyond "
      "its hull; what helps: planner.validity.collision_radius_m of at least {:.2f}\n",
      error.max_m, radius_m - hull_m, error.max_m + hull_m);
}

}  // namespace gnbv
