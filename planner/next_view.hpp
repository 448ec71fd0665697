// The decision: sample views, check them, score them, choose (paper sections 2.4 and 2.5, Fig. 1).
#pragma once

#include <optional>
#include <vector>

#include "planner/planner.hpp"

namespace gnbv {

/// A sampled view with what became of it.
struct Candidate {
  ViewPose view;
  std::string_view sampler;
  double scale = 1.0;                      // of the AGVS grid
  int cluster = -1;                        // FVS: the cluster it looks at, 0 = the nearest
  std::optional<Rejection> rejected = {};  // nothing: it competed with `score`
  std::vector<Vec3> via_world_m = {};      // points on the way there
  double path_m = 0.0;                     // length of the way
  Score score = {};
};

/// The next view, if any, and all candidates of this decision in the order they were sampled.
struct Plan {
  std::optional<Decision> next;
  std::optional<std::size_t> chosen;  // of the candidates
  std::vector<Candidate> candidates;
};

/// The next best view from `current`. `next` is empty when no sampled view is valid: at a local
/// minimum FVS is asked first, then (FvsConfig::agvs_when_stuck) AGVS at growing scales.
Plan plan_next_view(const PlannerModel& model, const Belief& belief, const History& history,
                    const ViewPose& current, Workbench& bench);

}  // namespace gnbv
