// `--candidates`: every decision's candidates, and what was believed where it meant to look.
#pragma once

#include "planner/core/belief.hpp"
#include "scenarios/scenario.hpp"
#include "tools/mission/mission.hpp"
#include "tools/run/decision_lines.hpp"

namespace gnbv {

/// The voxels of beliefs.jsonl of a decision that was made on that belief.
BelievedVoxels believed_voxels(const PlannerModel& model, const Belief& belief, const Plan& plan);

/// Writes candidates.jsonl and beliefs.jsonl while the mission flies.
class DecisionLog final : public MissionObserver {
 public:
  /// As CandidatesFile and BeliefsFile.
  DecisionLog(const Scenario& scenario, const std::filesystem::path& folder,
              std::size_t first_iteration);

  void on_view(const ViewRecord&, const Belief& belief) override { belief_ = &belief; }
  void on_plan(std::size_t iteration, const Plan& plan) override;
  void finish();

 private:
  PlannerModel model_;
  CandidatesFile candidates_;
  BeliefsFile beliefs_;
  const Belief* belief_ = nullptr;  // after the latest view: the mission's own
};

}  // namespace gnbv
