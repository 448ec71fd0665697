// Planners whose views are laid out beforehand or come from outside: which of them comes next.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "planner/core/planner.hpp"

namespace gnbv {

constexpr std::size_t kMostUserViews = 100000;
constexpr int kMostLaidViews = 10'000;  // ordering them takes the square of it

struct RouteConfig {
  double standoff_m = 4.0;  // from the occupied voxels of the profile: half of the cameras' range
  double overlap = 0.3;     // lawnmower: of neighbouring images
  std::vector<ViewPose> views = {};  // route: body poses, in the order in which they are flown
};

/// All views of a mission around what the profile's map holds, in the order in which they are flown
/// from `start`; empty where nothing is occupied. A gimbal looks at what the view does. The first
/// camera's footprint spaces the rows; `count` is for the hemisphere, kMostLaidViews at most.
using LayViews = std::vector<ViewPose> (*)(const RouteConfig& config, const PlannerModel& model,
                                           const OccupancyGrid& map, const ViewPose& start,
                                           int count);

/// Directions spread evenly over the upper half space, each view where a line from the structure's
/// centre comes out of its surroundings. It looks at the centre.
std::vector<ViewPose> lay_hemisphere(const RouteConfig& config, const PlannerModel& model,
                                     const OccupancyGrid& map, const ViewPose& start, int count);

/// Rows back and forth on four sides, looking level, and above, looking down. Throws BadInput when
/// it would need more than kMostLaidViews.
std::vector<ViewPose> lay_lawnmower(const RouteConfig& config, const PlannerModel& model,
                                    const OccupancyGrid& map, const ViewPose& start, int count);

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

/// Baselines that lay all their views at once around what the profile saw, and ask no utility: what
/// a planner that decides view by view has to beat. What cannot be flown to is passed over, and so
/// is what was flown to lately.
class LaidRoutePlanner final : public Planner {
 public:
  /// Keeps a reference to the model.
  LaidRoutePlanner(LayViews lay, const RouteConfig& config, int count, const PlannerModel& model)
      : lay_(lay), config_(config), count_(count), model_(model) {}

  void begin(const Belief& profile, const ViewPose& start) override;
  Plan next(const Belief& belief, const History& history, const ViewPose& current,
            Scratch& scratch) override;
  Plan replay(std::span<const Decision> recorded, const Belief& belief, const History& history,
              const ViewPose& current, Scratch& scratch) override;

 private:
  const LayViews lay_;
  const RouteConfig config_;
  const int count_;
  const PlannerModel& model_;
  std::vector<ViewPose> ahead_;  // what of the route is left
};

/// One more view from outside; nothing: there are no more.
using NextView = std::function<std::optional<ViewPose>()>;
/// A view from outside, by its index, that cannot be flown to.
using OnRefused = std::function<void(std::size_t index, Rejection)>;

constexpr EndRules kToTheEnd = {.entropy = false, .gain = false, .repetition = false};

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
  EndRules end_rules() const override { return kToTheEnd; }

 private:
  const std::vector<Decision> route_;
};

}  // namespace gnbv
