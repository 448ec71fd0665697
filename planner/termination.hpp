// When the mission is over (paper section 2.6).
#pragma once

#include <span>
#include <string_view>

namespace gnbv {

/// Defaults: Table 1 with the released window; max_iterations is the paper's longest aircraft run.
struct TerminationConfig {
  int max_iterations = 635;
  double entropy_change_percent = 0.001;  // of the total entropy, per view; 0 switches it off
  int entropy_window = 5;                 // consecutive views
  int repeated_moves = 10;                // back and forth, in a row; 0 switches it off
};

enum class Termination {
  max_iterations,
  entropy_change,
  no_valid_view,
  repeated_motion,  // goes back and forth between two places
  battery,          // what is left is needed to land, or to come home and land
  route_flown,      // every view of a given route was taken
  off_course,       // carried out of the workspace
  tour_complete,    // tour: no view pays any more
  interrupted,
  collision
};
std::string_view name_of(Termination reason);

/// Whether each of the last entropy_window views changed the total entropy by less than the
/// threshold: 100 |E_n - E_n-1| / mean(E_n, E_n-1) < entropy_change_percent.
/// `entropies_nat`: total entropy before the first view with a depth return and after each view
/// from then on, oldest first; an unarmed rule sees fewer than entropy_window + 1 values.
bool entropy_has_settled(const TerminationConfig& config, std::span<const double> entropies_nat);

}  // namespace gnbv
