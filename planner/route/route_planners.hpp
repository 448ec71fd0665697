// Planners whose views are laid out beforehand or come from outside: which of them comes next.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "planner/core/planner.hpp"
#include "planner/route/laid_views.hpp"

namespace gnbv {

struct PlannerModel;

/// Whether views that are given may be flown to. Whoever flies them has nowhere else to go: what
/// blocks the straight way is flown around. Those that are as good as one of `recent` are rejected.
class UserViewChecker {
 public:
  /// Everything referred to stays with the caller.
  UserViewChecker(const PlannerModel& model, const Belief& belief, std::span<const ViewPose> recent,
                  const ViewPose& current, std::function<void()> heed_stop = {});
  UserViewChecker(const UserViewChecker&) = delete;  // the checker refers to the rules beside it
  UserViewChecker& operator=(const UserViewChecker&) = delete;
  /// As ViewChecker::check(), and whether the gimbal can.
  void check(Candidate& candidate);

 private:
  const PlannerModel& model_;
  const ValidityConfig validity_;
  ViewChecker checker_;
};

/// Lays all its views around what the profile saw, once, and flies them in that order; what cannot
/// be flown to is passed over, and so is what was flown to lately.
class LaidRoutePlanner final : public Planner {
 public:
  /// `views`: uniform_hemisphere: how many. Keeps a reference to the model.
  LaidRoutePlanner(LayViews lay, const RouteConfig& config, int views, const PlannerModel& model);

  void begin(const Belief& profile, const ViewPose& start) override;
  Plan next(const Belief& belief, const History& history, const ViewPose& current,
            Scratch& scratch) override;
  Plan replay(std::span<const Decision> recorded, const Belief& belief, const History& history,
              const ViewPose& current, Scratch& scratch) override;

 private:
  const LayViews lay_;
  const RouteConfig config_;
  const int views_;
  const PlannerModel& model_;
  std::vector<ViewPose> ahead_;  // what of the route is left
};

/// One more view from outside; nothing: there are no more.
using NextView = std::function<std::optional<ViewPose>()>;
/// A view from outside, by its index, that cannot be flown to.
using OnRefused = std::function<void(std::size_t index, Rejection)>;

/// Flies the views that a user gave, those of RouteConfig first. None is taken for a repetition of
/// another: who gives a view twice wants it twice. A mission that is flown again decides anew, and
/// what it decides has to be what it did.
class UserRoutePlanner final : public Planner {
 public:
  /// Keeps a reference to the model.
  UserRoutePlanner(std::vector<ViewPose> views, NextView next_view, OnRefused on_refused,
                   const PlannerModel& model);

  Plan next(const Belief& belief, const History& history, const ViewPose& current,
            Scratch& scratch) override;
  Plan replay(std::span<const Decision> recorded, const Belief& belief, const History& history,
              const ViewPose& current, Scratch& scratch) override;
  EndRules end_rules() const override { return kToTheEnd; }

  static constexpr EndRules kToTheEnd = {.entropy = false, .gain = false, .repetition = false};

 private:
  Plan try_known(const Belief& belief, const ViewPose& current, const Scratch& scratch);

  std::vector<ViewPose> views_;
  std::size_t tried_ = 0;
  const NextView next_view_;
  const OnRefused on_refused_;
  const PlannerModel& model_;
};

/// Flies decisions that somebody made who knows the structure, and checks none of them.
class KnownRoutePlanner final : public Planner {
 public:
  explicit KnownRoutePlanner(std::vector<Decision> route) : route_(std::move(route)) {}

  Plan next(const Belief& belief, const History& history, const ViewPose& current,
            Scratch& scratch) override;
  EndRules end_rules() const override { return UserRoutePlanner::kToTheEnd; }

 private:
  const std::vector<Decision> route_;
};

}  // namespace gnbv
