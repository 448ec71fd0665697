#include "tools/mission/replay.hpp"

#include <algorithm>
#include <utility>

#include "planner/model.hpp"
#include "planner/routes.hpp"
#include "planner/workbench.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

void need_same(const ViewRecord& now, const ViewRecord& recorded) {
  if (now.cloud_points == recorded.cloud_points && now.entropy_nat == recorded.entropy_nat) return;
  throw BadInput(
      fmt::format("view {}: flown again it left {} points and {} nat, recorded were {} and {}: "
                  "another version of the program or another mesh made this run; fly it anew",
                  now.iteration, now.cloud_points, now.entropy_nat, recorded.cloud_points,
                  recorded.entropy_nat));
}

/// Hooks that fly the first `count` views as recorded and refuse another outcome. They refer to
/// `mission`.
MissionHooks hooks_for(const RecordedMission& mission, std::size_t count) {
  MissionHooks hooks;
  for (const ViewRecord& view : mission.views.first(count)) hooks.replay.push_back(view.decision);
  if (is_oracle(mission.scenario.planner.utility.name)) {
    hooks.route.emplace();  // may be empty: a profile needs no views
    for (std::size_t i = 1; i < mission.views.size(); ++i) {
      hooks.route->push_back(mission.views[i].decision);
    }
  }
  // a profile takes about as long as sixty views
  const double steps = 60.0 + static_cast<double>(count);
  hooks.on_profile = [&mission, steps](double share) { mission.on_progress(60.0 * share / steps); };
  hooks.on_view = [&mission, steps](const ViewRecord& view) {
    const auto i = static_cast<std::size_t>(view.iteration);
    GNBV_CHECK(i < mission.views.size(), "view {} of {}", i, mission.views.size());
    need_same(view, mission.views[i]);
    mission.on_progress(std::min(1.0, (61.0 + view.iteration) / steps));
  };
  hooks.should_stop = [] { return true; };  // asked when the replayed views are flown
  return hooks;
}

MissionResult fly(const RecordedMission& mission, const MissionHooks& hooks) {
  return run_mission(mission.scenario, mission.world, mission.scene, hooks, mission.threads);
}

}  // namespace

std::vector<ProfileStage> replay_profile(const RecordedMission& mission,
                                         std::span<const std::size_t> waypoints) {
  const Scenario& scenario = mission.scenario;
  const ProfilingMethod method = scenario.planner.profiling.method;
  if (method == ProfilingMethod::saved || method == ProfilingMethod::none) return {};
  struct Mark {
    double time_s;
    std::size_t sweeps;
  };
  std::vector<Mark> marks;  // at the end of each waypoint
  std::vector<LidarScan> sweeps;
  bool is_over = false;
  MissionHooks hooks = hooks_for(mission, 0);
  hooks.on_profile = mission.on_progress;
  hooks.on_profile_belief = [&](const Belief&) { is_over = true; };
  hooks.should_stop = [&] { return is_over; };
  hooks.on_profile_sweeps = [&](double time_s, std::span<const LidarScan> so_far) {
    marks.push_back({time_s, so_far.size()});
    sweeps.assign(so_far.begin(), so_far.end());
  };
  const MissionResult result = fly(mission, hooks);

  std::vector<LidarModel> lidars;
  for (const LidarConfig& lidar : scenario.lidars) lidars.push_back(make_lidar_model(lidar));
  const PlannerModel model(scenario.planner, scenario.workspace_m, camera_models(scenario), lidars,
                           scenario.seed, no_fly_of(scenario));
  Workbench bench(model, mission.threads);
  std::vector<std::size_t> counts;
  for (const std::size_t count : waypoints) {
    if (count < marks.size()) counts.push_back(count);
  }
  if (!marks.empty()) counts.push_back(marks.size());
  std::vector<ProfileStage> stages;
  for (const std::size_t count : counts) {
    Belief belief(model);
    integrate_profile(model, std::span(sweeps).first(marks[count - 1].sweeps), bench, belief);
    const auto points = belief.cloud.points_world_m();
    stages.push_back({.waypoints = count, .points_world_m = {points.begin(), points.end()}});
    for (const TrajectorySample& sample : result.trajectory) {
      if (sample.time_s > marks[count - 1].time_s) break;
      stages.back().path_world_m.push_back(sample.T_world_body.translation());
    }
  }
  return stages;
}

Belief replay_belief(const RecordedMission& mission, std::size_t iteration) {
  GNBV_CHECK(iteration < mission.views.size(), "view {} of {}", iteration, mission.views.size());
  return fly(mission, hooks_for(mission, iteration + 1)).belief;
}

ReplayedDecision replay_decision(const RecordedMission& mission, std::size_t iteration) {
  GNBV_CHECK(iteration > 0 && iteration < mission.views.size(), "decision {} of {}", iteration,
             mission.views.size());
  MissionHooks hooks = hooks_for(mission, iteration);
  std::optional<Belief> belief;
  std::size_t views = 0;
  hooks.on_view_belief = [&](const Belief& after) {
    if (++views == iteration) belief = after;
  };
  Plan plan;
  hooks.on_candidates = [&](std::size_t, const Plan& made) { plan = made; };
  hooks.should_stop = [&] { return views > iteration; };  // the chosen view is checked, too
  fly(mission, hooks);
  GNBV_CHECK(belief.has_value(), "the mission ended after {} views", views);
  return {std::move(*belief), std::move(plan)};
}

}  // namespace gnbv
