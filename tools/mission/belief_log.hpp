// What a mission that keeps its candidates also keeps: what it believed where it meant to look.
#pragma once

#include "planner/map/frontiers.hpp"
#include "planner/model.hpp"
#include "scenarios/scenario.hpp"
#include "tools/mission/mission.hpp"
#include "tools/run_files/beliefs_jsonl.hpp"

namespace gnbv {

/// The voxels of beliefs.jsonl of a decision that was made on that belief.
BelievedVoxels believed_voxels(const PlannerModel& model, const Belief& belief, const Plan& plan,
                               FrontierMarks& marks);

/// Writes beliefs.jsonl while the mission flies. Decides nothing and changes nothing.
class BeliefLog {
 public:
  /// As BeliefsFile.
  BeliefLog(const Scenario& scenario, const std::filesystem::path& folder,
            std::size_t first_iteration);

  /// Listens, after those who already do. `hooks` may be called as long as this lives.
  void connect(MissionHooks& hooks);
  void finish() { file_.finish(); }

 private:
  PlannerModel model_;
  FrontierMarks marks_;
  BeliefsFile file_;
  const Belief* belief_ = nullptr;  // after the latest view: the mission's own
};

}  // namespace gnbv
