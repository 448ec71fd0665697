#include "tools/mission/user_planner.hpp"

#include "scenarios/values.hpp"
#include "sim/core/error.hpp"

namespace gnbv {

UserPlannerLink::UserPlannerLink(const UserPlanner& planner, const Scenario& scenario, bool rounds)
    : planner_(planner),
      rounds_(rounds),
      scenario_(scenario),
      given_(scenario.planner.routes.views) {}

void UserPlannerLink::connect(MissionInputs& inputs) {
  inputs.observers.push_back(this);
  inputs.sources.next_view = [this, should_stop = inputs.should_stop] { return next(should_stop); };
  inputs.sources.on_refused = [this](std::size_t, Rejection reason) {
    planner_.on_refused(reason);
  };
}

void UserPlannerLink::on_view(const ViewRecord& view, const Belief& belief) {
  planner_.on_view(view);
  belief_ = &belief;
}

std::optional<ViewPose> UserPlannerLink::next(const std::function<bool()>& should_stop) {
  std::vector<ViewPose>& views = scenario_.planner.routes.views;
  if (should_stop() || views.size() >= kMostUserViews) return std::nullopt;
  GNBV_CHECK(belief_ != nullptr, "asked before the first view");
  std::optional<ViewPose> view = planner_.plan(*belief_);
  if (view && rounds_) {
    view->yaw_rad = written_angle_rad(view->yaw_rad);
    view->gimbal_pitch_rad = written_angle_rad(view->gimbal_pitch_rad);
  }
  if (view) views.push_back(*view);
  return view;
}

Scenario UserPlannerLink::repeatable(Termination reason) const {
  const bool has_views =
      reason != Termination::interrupted && !is_user_planner(scenario_.planner.utility);
  Scenario scenario = scenario_;
  if (!has_views) scenario.planner.routes.views = given_;
  return scenario;
}

}  // namespace gnbv
