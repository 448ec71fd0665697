// When the mission is over (paper section 2.6).
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace gnbv {

/// Defaults: Table 1 with the released window; max_iterations is the paper's longest aircraft run.
struct TerminationConfig {
  int max_iterations = 635;
  double entropy_change_percent = 0.001;   // of the total entropy, per view; 0 switches it off
  int entropy_window = 5;                  // consecutive views, armed after the first depth return
};

enum class Termination { max_iterations, entropy_change, no_valid_view, repeated_motion, interrupted, collision };
std::string_view name_of(Termination reason);

/// `entropies_nat`: total entropy after each view taken since the first depth return, and the value
/// before it, oldest first.
bool entropy_has_settled(const TerminationConfig& config, const std::vector<double>& entropies_nat);

}  // namespace gnbv
