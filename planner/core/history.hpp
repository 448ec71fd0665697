// What was decided so far and how the total entropy went: the memory that sampling, validity and
// termination look back on.
#pragma once

#include <vector>

#include "planner/core/plan.hpp"
#include "planner/core/termination.hpp"

namespace gnbv {

struct Belief;

/// All oldest first.
struct History {
  std::vector<Decision> decisions;
  std::vector<double> entropies_nat;  // as entropy_has_settled() wants them
  std::vector<MapProgress> progress;  // after each view
};

/// Where the views were taken.
std::vector<Vec3> positions_of(const History& history);

/// The last views, so many at most.
std::vector<ViewPose> recent_views(const History& history, int count);

/// Records the outcome of the latest decision's view.
void remember_entropy(const Belief& belief, double entropy_before_nat, History& history);
void remember_progress(const Belief& belief, double straight_m, History& history);

}  // namespace gnbv
