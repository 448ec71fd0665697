// The decision where the views are laid out or given: which of them comes next.
#pragma once

#include <span>

#include "planner/decision.hpp"

namespace gnbv {

struct Belief;
struct History;
struct PlannerModel;

/// Whether views that are given may be flown to. Whoever flies them has nowhere else to go: what
/// blocks the straight way is flown around. Those that are as good as one of `recent` are rejected.
class GivenViewChecker {
 public:
  /// Everything referred to stays with the caller.
  GivenViewChecker(const PlannerModel& model, const Belief& belief,
                   std::span<const ViewPose> recent, const ViewPose& current);
  GivenViewChecker(const GivenViewChecker&) = delete;  // the checker refers to the rules beside it
  GivenViewChecker& operator=(const GivenViewChecker&) = delete;
  /// As ViewChecker::check(), and whether the gimbal can.
  void check(Candidate& candidate);

 private:
  const PlannerModel& model_;
  const ValidityConfig validity_;
  ViewChecker checker_;
};

/// The first of the views, in their order, that may be flown to (GivenViewChecker); all before it
/// are candidates with their reason of rejection.
Plan first_flyable(const PlannerModel& model, const Belief& belief,
                   std::span<const ViewPose> recent, std::span<const ViewPose> views,
                   const ViewPose& current);

/// The same of a route (plan_route()) after the view taken last, and of all that were taken
/// recently (ValidityConfig::recent_poses).
Plan follow_route(const PlannerModel& model, const Belief& belief, const History& history,
                  std::span<const ViewPose> route, const ViewPose& current);

}  // namespace gnbv
