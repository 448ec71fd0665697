// The paper's planner: sample views, check them, score them, choose (sections 2.4 and 2.5, Fig. 1).
#pragma once

#include "planner/core/planner.hpp"
#include "planner/guided/burst.hpp"
#include "planner/guided/utility.hpp"
#include "planner/guided/view_sampling.hpp"

namespace gnbv {

struct GuidedConfig {
  AgvsConfig agvs = {};
  FvsConfig fvs = {};
  UtilityConfig utility = {};
};

class GuidedPlanner final : public Planner {
 public:
  /// Keeps a reference to the model. `user_scores` are asked where the utility is the user's own.
  GuidedPlanner(GuidedConfig config, const PlannerModel& model, UserScores user_scores = {});

  /// A plan of one view, the best of those sampled, or of a burst. No view when none is valid: at a
  /// local minimum FVS is asked first, then (FvsConfig::agvs_when_stuck) AGVS at growing scales.
  /// Where AGVS finds nothing (FvsConfig::when_grid_finds_nothing) FVS is asked, too, at last for
  /// views that can be reached on a way around.
  Plan next(const Belief& belief, const History& history, const ViewPose& current,
            Scratch& scratch) override;
  /// Bursts are planned anew, since they leave something behind them; views of the grid are not.
  Plan replay(std::span<const Decision> recorded, const Belief& belief, const History& history,
              const ViewPose& current, Scratch& scratch) override;

 private:
  const GuidedConfig config_;
  const PlannerModel& model_;
  const UserScores user_scores_;
  BurstMemory bursts_;
};

}  // namespace gnbv
