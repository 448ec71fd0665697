// The planner that thinks further than one view: a tour of all that still lacks points, flown a few
// views at a time and made anew (ours; the paper decides view by view).
#pragma once

#include "planner/core/planner.hpp"
#include "planner/tour/tour_state.hpp"

namespace gnbv {

class TourPlanner final : public Planner {
 public:
  /// Keeps a reference to the model. `has_profile`: without one, it also looks for space unseen.
  TourPlanner(const TourConfig& config, const PlannerModel& model, bool has_profile)
      : model_(model), config_(config), has_profile_(has_profile), state_(config, model) {}

  /// A plan of one view: the next of the tour, made anew where that is due. No view when none that
  /// can be flown to pays any more: then the end says whether some pay, but cannot be flown to.
  Plan next(const Belief& belief, const History& history, const ViewPose& current,
            Scratch& scratch) override;
  /// Plans anew: it learns from what the views brought.
  Plan replay(std::span<const Decision> recorded, const Belief& belief, const History& history,
              const ViewPose& current, Scratch& scratch) override;
  /// A tour knows itself when the map has nothing more to tell.
  EndRules end_rules() const override { return {.entropy = false, .repetition = false}; }

 private:
  const PlannerModel& model_;
  const TourConfig config_;
  const bool has_profile_;
  TourState state_;
};

}  // namespace gnbv
