// The decision of a baseline that has planned all its views: which of its route comes next.
#pragma once

#include <span>

#include "planner/decision.hpp"

namespace gnbv {

struct Belief;
struct History;
struct PlannerModel;

/// The first view of the route (plan_route()) after the one taken last that may be flown to. A
/// route has nowhere else to go: what blocks the straight way is flown around.
Plan follow_route(const PlannerModel& model, const Belief& belief, const History& history,
                  std::span<const ViewPose> route, const ViewPose& current);

}  // namespace gnbv
