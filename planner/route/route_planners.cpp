#include "planner/route/route_planners.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace gnbv {
namespace {

ValidityConfig with_ways_around(ValidityConfig validity) {
  if (validity.path == PathCheck::straight) validity.path = PathCheck::astar;
  return validity;
}

/// The first of the views, in their order, that may be flown to; all before it are candidates with
/// their reason of rejection.
Plan first_flyable(const PlannerModel& model, const Belief& belief,
                   std::span<const ViewPose> recent, std::span<const ViewPose> views,
                   const ViewPose& current, const Scratch& scratch) {
  UserViewChecker checker(model, belief, recent, current, [&scratch] { scratch.heed_stop(); });
  Plan plan{.end = Termination::no_valid_view};
  for (const ViewPose& view : views) {
    plan.candidates.push_back({.view = view, .sampler = Sampler::route});
    checker.check(plan.candidates.back());
    if (plan.candidates.back().rejected) continue;
    choose(plan, plan.candidates.size() - 1, 1, 1);
    break;
  }
  return plan;
}

}  // namespace

UserViewChecker::UserViewChecker(const PlannerModel& model, const Belief& belief,
                                 std::span<const ViewPose> recent, const ViewPose& current,
                                 std::function<void()> heed_stop)
    : model_(model),
      validity_(with_ways_around(model.validity)),
      checker_(validity_, model.navigation_m, model.no_fly, belief.grid, recent, current,
               std::move(heed_stop)) {}

void UserViewChecker::check(Candidate& candidate) {
  gnbv::check(checker_, candidate);
  if (!model_.can_pitch(candidate.view.gimbal_pitch_rad)) {
    candidate.rejected = Rejection::beyond_gimbal;
  }
}

// ---- laid around the profile

void LaidRoutePlanner::begin(const Belief& profile, const ViewPose& start) {
  ahead_ = lay_(config_, model_, profile.grid, start, count_);
}

Plan LaidRoutePlanner::next(const Belief& belief, const History& history, const ViewPose& current,
                            Scratch& scratch) {
  Plan plan = first_flyable(model_, belief, recent_views(history, model_.validity.recent_poses),
                            ahead_, current, scratch);
  const auto tried = static_cast<std::ptrdiff_t>(plan.candidates.size());
  ahead_.erase(ahead_.begin(), ahead_.begin() + tried);
  return plan;
}

Plan LaidRoutePlanner::replay(std::span<const Decision> recorded, const Belief& belief,
                              const History& history, const ViewPose& current, Scratch& scratch) {
  Plan plan = next(belief, history, current, scratch);
  need_as_recorded(plan, recorded, history.decisions.size());
  return plan;
}

// ---- given by a user

UserRoutePlanner::UserRoutePlanner(std::vector<ViewPose> views, NextView next_view,
                                   OnRefused on_refused, const PlannerModel& model)
    : views_(std::move(views)),
      next_view_(std::move(next_view)),
      on_refused_(std::move(on_refused)),
      model_(model) {}

Plan UserRoutePlanner::try_known(const Belief& belief, const ViewPose& current,
                                 const Scratch& scratch) {
  Plan plan =
      first_flyable(model_, belief, {}, std::span(views_).subspan(tried_), current, scratch);
  for (const Candidate& candidate : plan.candidates) {
    const std::size_t index = tried_++;
    if (candidate.rejected && on_refused_) on_refused_(index, *candidate.rejected);
  }
  return plan;
}

Plan UserRoutePlanner::next(const Belief& belief, const History&, const ViewPose& current,
                            Scratch& scratch) {
  Plan plan = try_known(belief, current, scratch);
  while (!plan.has_view() && next_view_) {
    const std::optional<ViewPose> view = next_view_();
    if (!view) break;
    views_.push_back(*view);
    Plan more = try_known(belief, current, scratch);
    for (std::size_t& chosen : more.chosen) chosen += plan.candidates.size();
    std::move(more.candidates.begin(), more.candidates.end(), std::back_inserter(plan.candidates));
    plan.chosen = std::move(more.chosen);
    plan.views = std::move(more.views);
  }
  const bool is_stopped = scratch.should_stop && scratch.should_stop();
  plan.end = is_stopped ? Termination::interrupted : Termination::route_flown;
  return plan;
}

Plan UserRoutePlanner::replay(std::span<const Decision> recorded, const Belief& belief,
                              const History& history, const ViewPose& current, Scratch& scratch) {
  Plan plan = try_known(belief, current, scratch);
  need_as_recorded(plan, recorded, history.decisions.size());
  return plan;
}

// ---- by who knows the structure

Plan KnownRoutePlanner::next(const Belief&, const History& history, const ViewPose&, Scratch&) {
  const std::size_t next = history.decisions.size() - 1;  // decision 0 is the start
  Plan plan{.end = Termination::route_flown};
  if (next < route_.size()) plan.views = {route_[next]};
  return plan;
}

}  // namespace gnbv
