#include "tools/mission/own_planner.hpp"

#include "sim/core/error.hpp"

namespace gnbv {

OwnPlannerHooks::OwnPlannerHooks(const OwnPlanner& planner, const Scenario& scenario,
                                 RunDirectory& directory)
    : planner_(planner), scenario_(scenario), directory_(directory) {}

void OwnPlannerHooks::connect(MissionHooks& hooks) {
  hooks.next_given = [this, should_stop = hooks.should_stop] { return next(should_stop); };
  hooks.on_refused = [this](std::size_t, Rejection reason) { planner_.on_refused(reason); };
  hooks.on_view = [this, before = hooks.on_view](const ViewRecord& view) {
    before(view);
    planner_.on_view(view);
  };
  hooks.on_view_belief = [this, before = hooks.on_view_belief](const Belief& belief) {
    before(belief);
    belief_ = &belief;
  };
}

std::optional<ViewPose> OwnPlannerHooks::next(const std::function<bool()>& should_stop) {
  std::vector<ViewPose>& views = scenario_.planner.routes.views;
  if (should_stop() || views.size() >= kMostGivenViews) return std::nullopt;
  GNBV_CHECK(belief_ != nullptr, "asked before the first view");
  const std::optional<ViewPose> view = planner_.plan(*belief_);
  if (!view) return std::nullopt;
  views.push_back(*view);
  directory_.keep(scenario_);
  return view;
}

}  // namespace gnbv
