// The decision: sample views, check them, score them, choose (paper sections 2.4 and 2.5, Fig. 1).
#pragma once

#include "planner/decision.hpp"

namespace gnbv {

struct Belief;
struct History;
struct PlannerModel;
struct Workbench;

/// The next best view from `current`. `next` is empty when no sampled view is valid: at a local
/// minimum FVS is asked first, then (FvsConfig::agvs_when_stuck) AGVS at growing scales. Where AGVS
/// finds nothing (FvsConfig::when_grid_finds_nothing) FVS is asked, too, at last for views that can
/// be reached on a way around.
Plan plan_next_view(const PlannerModel& model, const Belief& belief, const History& history,
                    const ViewPose& current, Workbench& bench);

}  // namespace gnbv
