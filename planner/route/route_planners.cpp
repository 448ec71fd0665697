#include "planner/route/route_planners.hpp"

namespace gnbv {

void RoutePlanner::begin(const Belief& profile, const ViewPose& start) {
  if (!route_.lay) return;
  route_.views = route_.lay(profile.grid, start);
  tried_ = 0;
}

/// Takes the first of the views left that may be flown to into the plan; all before it are
/// candidates with their reason of rejection.
void RoutePlanner::try_known(const Belief& belief, const History& history, const ViewPose& current,
                             const Scratch& scratch, Plan& plan) {
  const std::vector<ViewPose> recent =
      recent_views(history, route_.lay ? model_.validity.recent_poses : 0);
  ViewChecker checker(model_.validity_around, model_.navigation_m, model_.no_fly, belief.grid,
                      recent, current, [&scratch] { scratch.heed_stop(); });
  for (; !plan.has_view() && tried_ < route_.views.size(); ++tried_) {
    plan.candidates.push_back({.view = route_.views[tried_], .sampler = Sampler::route});
    check(checker, model_, plan.candidates.back());
    const std::optional<Rejection> rejected = plan.candidates.back().rejected;
    if (!rejected) choose(plan, plan.candidates.size() - 1, 1, 1);
    if (rejected && route_.on_refused) route_.on_refused(tried_, *rejected);
  }
}

Plan RoutePlanner::next(const Belief& belief, const History& history, const ViewPose& current,
                        Scratch& scratch) {
  Plan plan;
  try_known(belief, history, current, scratch, plan);
  while (!plan.has_view() && route_.next_view) {
    const std::optional<ViewPose> view = route_.next_view();
    if (!view) break;
    route_.views.push_back(*view);
    try_known(belief, history, current, scratch, plan);
  }
  if (route_.lay) return plan;
  const bool is_stopped = scratch.should_stop && scratch.should_stop();
  plan.end = is_stopped ? Termination::interrupted : Termination::route_flown;
  return plan;
}

Plan RoutePlanner::replay(std::span<const Decision> recorded, const Belief& belief,
                          const History& history, const ViewPose& current, Scratch& scratch) {
  Plan plan;
  try_known(belief, history, current, scratch, plan);
  need_as_recorded(plan, recorded, history.decisions.size());
  return plan;
}

Plan KnownRoutePlanner::next(const Belief&, const History& history, const ViewPose&, Scratch&) {
  const std::size_t next = history.decisions.size() - 1;  // decision 0 is the start
  Plan plan{.end = Termination::route_flown};
  if (next < route_.size()) plan.views = {route_[next]};
  return plan;
}

}  // namespace gnbv
