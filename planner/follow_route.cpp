#include "planner/follow_route.hpp"

#include <algorithm>
#include <utility>

#include "planner/belief.hpp"
#include "planner/history.hpp"
#include "planner/model.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kSampler = "route";

/// What of the route is left.
std::span<const ViewPose> ahead(std::span<const ViewPose> route, const History& history) {
  if (history.decisions.empty() || history.decisions.back().sampler != kSampler) return route;
  const ViewPose& last = history.decisions.back().view;
  const auto at = std::find_if(route.begin(), route.end(),
                               [&](const ViewPose& view) { return is_same_view(view, last); });
  return at == route.end() ? std::span<const ViewPose>() : std::span(at + 1, route.end());
}

ValidityConfig with_ways_around(ValidityConfig validity) {
  if (validity.path == PathCheck::straight) validity.path = PathCheck::astar;
  return validity;
}

}  // namespace

GivenViewChecker::GivenViewChecker(const PlannerModel& model, const Belief& belief,
                                   std::span<const ViewPose> recent, const ViewPose& current)
    : model_(model),
      validity_(with_ways_around(model.config.validity)),
      checker_(validity_, model.navigation_m, model.no_fly, belief.grid, recent, current) {}

void GivenViewChecker::check(Candidate& candidate) {
  checker_.check(candidate);
  if (!model_.can_pitch(candidate.view.gimbal_pitch_rad)) {
    candidate.rejected = Rejection::beyond_gimbal;
  }
}

Plan first_flyable(const PlannerModel& model, const Belief& belief,
                   std::span<const ViewPose> recent, std::span<const ViewPose> views,
                   const ViewPose& current) {
  GivenViewChecker checker(model, belief, recent, current);
  Plan plan;
  for (const ViewPose& view : views) {
    plan.candidates.push_back({.view = view, .sampler = kSampler});
    Candidate& candidate = plan.candidates.back();
    checker.check(candidate);
    if (candidate.rejected) continue;
    plan.chosen = plan.candidates.size() - 1;
    plan.next = Decision{.view = view,
                         .sampler = kSampler,
                         .candidates = 1,
                         .valid = 1,
                         .via_world_m = candidate.via_world_m};
    break;
  }
  return plan;
}

Plan follow_route(const PlannerModel& model, const Belief& belief, const History& history,
                  std::span<const ViewPose> route, const ViewPose& current) {
  return first_flyable(model, belief, recent_views(history, model.config.validity.recent_poses),
                       ahead(route, history), current);
}

}  // namespace gnbv
