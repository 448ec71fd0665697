// The figures of a mission that methods are compared by, each with its unit and which way is
// better.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/compare/mission_row.hpp"

namespace gnbv {

struct RunMetric {
  std::string name;  // with the unit of the value
  std::string key;   // of MissionRow's figures
  double factor = 1.0;
  bool higher_is_better = true;
  int decimals = 1;
  /// Whether a method can be better by it. Nobody is for ending early, nor for reducing entropy.
  bool is_judged = true;
  /// Of an effort the figure that says what a mission which used up its budget has spent.
  std::string limit_key = {};
  /// Of the whole cloud, also of views beyond the budget: not judged where a mission has some.
  bool is_of_all_views = false;

  std::optional<double> value(const MissionRow& mission) const;
  bool is_effort() const { return !limit_key.empty(); }
};

constexpr std::string_view kCoverageMetric = "coverage at 0.05 m (%)";
constexpr std::string_view kDistanceMetric = "distance (m)";

/// In the order of tables: coverage at 0.05 m first, all within the budget of views, then the
/// others that every mission has, the efforts to reach kReachShares of the ceiling, and the
/// coverage at each size that any of the missions has beside the paper's, ascending.
std::vector<RunMetric> metrics_of(std::span<const MissionRow> missions);

}  // namespace gnbv
