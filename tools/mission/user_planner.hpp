// A planner of the user's own: it is asked for view after view and told what became of them. The
// mission flies them as given views. A mission that is resumed asks it again from the first view
// on, and refuses other answers than those that were recorded.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "planner/core/belief.hpp"
#include "scenarios/scenario.hpp"
#include "tools/mission/mission.hpp"

namespace gnbv {

struct UserPlanner {
  /// The next view, or nothing when the mission is to end. The belief is that after the latest
  /// view; it changes with the next one.
  std::function<std::optional<ViewPose>(const Belief&)> plan;
  /// A view was taken.
  std::function<void(const ViewRecord&)> on_view = [](const ViewRecord&) {};
  /// What the cameras saw at a view, before it is believed.
  std::function<void(const SensedView&)> on_sensed = [](const SensedView&) {};
  /// The view that was planned last cannot be flown; plan() is asked again.
  std::function<void(Rejection)> on_refused = [](Rejection) {};
};

/// Lets a mission ask the planner.
class UserPlannerLink final : public MissionObserver {
 public:
  /// Everything referred to stays with the caller. `rounds`: angles become the nearest ones that
  /// files hold, in degrees, so that who flies the views alone flies the same, bit by bit.
  UserPlannerLink(const UserPlanner& planner, const Scenario& scenario, bool rounds = false);

  /// Lets the mission ask here. `inputs` is good as long as this lives.
  void connect(MissionInputs& inputs);
  /// What repeats a mission that ended so: with its views, where the scenario does not hold the
  /// planner itself; of one that is to be resumed as it was given.
  Scenario repeatable(Termination reason) const;

  void on_sensed(const SensedView& view) override { planner_.on_sensed(view); }
  void on_view(const ViewRecord& view, const Belief& belief) override;

 private:
  std::optional<ViewPose> next(const std::function<bool()>& should_stop);

  const UserPlanner& planner_;
  const bool rounds_;
  Scenario scenario_;  // with all views
  const std::vector<ViewPose> given_;
  const Belief* belief_ = nullptr;  // the mission's
};

// ---- user_child.cpp: functions of the user's own in a file run in a Python of their own, a child
// process: $GNBV_PYTHON, or python3, which needs NumPy.

/// Scores by the function. Throws BadInput when Python cannot be started or the source does not
/// define the function. Nothing for utilities of the program, and for planners. The function ends
/// with the thread that starts it, so who asks is to be who started.
UserScores start_user_utility(const UtilityConfig& config);

/// The same, started with the first question.
UserScores lazy_user_utility(const UtilityConfig& config);

/// Plans by the function, which asks the belief through the pipe; what it raises comes as
/// UserUtilityFailed. Throws likewise. Nothing for all that is no planner in a file.
std::unique_ptr<UserPlanner> start_user_planner(const Scenario& scenario, int threads);

}  // namespace gnbv
