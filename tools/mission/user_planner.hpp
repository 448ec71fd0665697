// A planner of the user's own, in this process: it is asked for view after view and told what
// became of them. The mission flies them as given views, so that the run repeats without the
// planner.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "planner/core/belief.hpp"
#include "tools/mission/mission.hpp"
#include "tools/run/run_directory.hpp"

namespace gnbv {

struct UserPlanner {
  /// The next view, or nothing when the mission is to end. The belief is that after the latest
  /// view; it changes with the next one.
  std::function<std::optional<ViewPose>(const Belief&)> plan;
  /// A view was taken.
  std::function<void(const ViewRecord&)> on_view = [](const ViewRecord&) {};
  /// The view that was planned last cannot be flown; plan() is asked again.
  std::function<void(Rejection)> on_refused = [](Rejection) {};
};

/// Lets a mission of --utility route ask the planner. The run directory keeps each view as soon as
/// it is planned.
class UserPlannerLink final : public MissionObserver {
 public:
  /// Everything referred to stays with the caller.
  UserPlannerLink(const UserPlanner& planner, const Scenario& scenario, RunDirectory& directory);

  /// Lets the mission ask here. `inputs` is good as long as this lives.
  void connect(MissionInputs& inputs);
  const Scenario& scenario() const { return scenario_; }

  void on_view(const ViewRecord& view, const Belief& belief) override;

 private:
  std::optional<ViewPose> next(const std::function<bool()>& should_stop);

  const UserPlanner& planner_;
  Scenario scenario_;
  RunDirectory& directory_;
  const Belief* belief_ = nullptr;  // the mission's
};

}  // namespace gnbv
