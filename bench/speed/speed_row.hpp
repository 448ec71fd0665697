// One line of the speed table: ours against a reference, on the same input, in the same run.
#pragma once

#include <optional>
#include <string>

namespace gnbv {

struct SpeedRow {
  std::string name = {};
  double ours = 0.0;
  double reference = 0.0;                // the paper's way
  std::optional<double> competent = {};  // the way of somebody who knows the libraries
  std::string unit = {};                 // of all
  bool identical = false;                // whether all gave the answers they owe
  double target = 0.0;                   // the ratio aimed for; 0: none
  bool is_limit = false;                 // the ratio is to stay below the target instead of above
};

/// How many times as fast ours is as the reference; with is_limit how many times as slow.
double ratio(const SpeedRow& row);
/// The same over the competent way; nothing without one.
std::optional<double> competent_ratio(const SpeedRow& row);
/// Whether the answers are right and the ratio is what was aimed for.
bool is_met(const SpeedRow& row);

}  // namespace gnbv
