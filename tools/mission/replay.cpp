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

/// Where the vehicle was at the first sample that is no earlier.
Vec3 place_at(std::span<const TrajectorySample> path, double time_s) {
  GNBV_CHECK(!path.empty(), "no path");
  const auto after = std::find_if(path.begin(), path.end(), [&](const TrajectorySample& sample) {
    return sample.time_s >= time_s;
  });
  return (after == path.end() ? path.back() : *after).T_world_body.translation();
}

/// What was heard of the profile's flight.
struct ProfileLog {
  struct Mark {
    double time_s;
    std::size_t sweeps;
  };
  std::vector<Mark> marks = {};  // at the end of each waypoint
  std::vector<LidarScan> sweeps = {};

  void add(double time_s, std::span<const LidarScan> so_far) {
    marks.push_back({time_s, so_far.size()});
    sweeps.assign(so_far.begin(), so_far.end());
  }
};

std::vector<ProfileStage> stages_of(const RecordedMission& mission, const ProfileLog& log,
                                    std::span<const TrajectorySample> path,
                                    std::span<const std::size_t> waypoints) {
  const Scenario& scenario = mission.scenario;
  std::vector<LidarModel> lidars;
  for (const LidarConfig& lidar : scenario.lidars) lidars.push_back(make_lidar_model(lidar));
  const PlannerModel model(scenario.planner, scenario.workspace_m, camera_models(scenario), lidars,
                           scenario.seed, no_fly_of(scenario));
  Workbench bench(model, mission.threads);
  std::vector<std::size_t> counts;
  for (const std::size_t count : waypoints) {
    if (count < log.marks.size()) counts.push_back(count);
  }
  if (!log.marks.empty()) counts.push_back(log.marks.size());
  std::vector<ProfileStage> stages;
  for (const std::size_t count : counts) {
    Belief belief(model);
    const auto& last = log.marks[count - 1];
    integrate_profile(model, std::span(log.sweeps).first(last.sweeps), bench, belief);
    const auto points = belief.cloud.points_world_m();
    stages.push_back({.waypoints = count, .points_world_m = {points.begin(), points.end()}});
    for (const TrajectorySample& sample : path) {
      if (sample.time_s > last.time_s) break;
      stages.back().path_world_m.push_back(sample.T_world_body.translation());
    }
    for (std::size_t i = 0; i < count; ++i) {
      stages.back().waypoints_world_m.push_back(place_at(path, log.marks[i].time_s));
    }
  }
  return stages;
}

bool flies_profile(const Scenario& scenario) {
  const ProfilingMethod method = scenario.planner.profiling.method;
  return method != ProfilingMethod::saved && method != ProfilingMethod::none;
}

}  // namespace

Replayed replay(const RecordedMission& mission, const ReplayRequest& request) {
  for (const auto& view : {request.belief, request.decision}) {
    GNBV_CHECK(!view || *view < mission.views.size(), "view {} of {}", *view, mission.views.size());
  }
  GNBV_CHECK(request.decision != 0U, "the start was no decision");
  const bool has_views = request.belief || request.decision;
  const bool has_profile = request.has_profile && flies_profile(mission.scenario);
  if (!has_views && !has_profile) return {};
  // the chosen view is checked, too
  const std::size_t count =
      has_views ? 1 + std::max(request.belief.value_or(0), request.decision.value_or(0)) : 0;
  MissionHooks hooks = hooks_for(mission, count);
  const std::vector<Decision> recorded = hooks.replay;
  const bool plans = request.decision && request.plans;
  if (plans) hooks.replay.resize(*request.decision);  // the next one is made again

  Replayed out;
  Plan plan;
  std::optional<Belief> before;
  std::size_t views = 0;
  ProfileLog log;
  bool is_over = false;
  if (has_profile) {
    hooks.on_profile_sweeps = [&](double time_s, std::span<const LidarScan> so_far) {
      log.add(time_s, so_far);
    };
  }
  hooks.on_profile_belief = [&](const Belief&) { is_over = count == 0; };
  hooks.on_view_belief = [&](const Belief& after) {
    ++views;
    if (views == request.decision) before = after;
    if (request.belief && views == *request.belief + 1 && views < count) out.belief = after;
    is_over = views == count;
  };
  hooks.on_candidates = [&](std::size_t, const Plan& made) {
    plan = made;
    hooks.replay = recorded;  // the mission reads it decision by decision
  };
  hooks.should_stop = [&] { return is_over; };
  if (count == 0) hooks.on_profile = mission.on_progress;
  MissionResult result = fly(mission, hooks);
  GNBV_CHECK(views == count, "the mission ended after {} views of {}", views, count);
  if (has_profile) out.profile = stages_of(mission, log, result.trajectory, request.waypoints);
  if (request.belief && !out.belief) out.belief = std::move(result.belief);
  if (request.decision) out.decision = ReplayedDecision{std::move(*before), std::move(plan)};
  return out;
}

std::vector<ProfileStage> replay_profile(const RecordedMission& mission,
                                         std::span<const std::size_t> waypoints) {
  return replay(mission, {.waypoints = {waypoints.begin(), waypoints.end()}, .has_profile = true})
      .profile;
}

Belief replay_belief(const RecordedMission& mission, std::size_t iteration) {
  return std::move(*replay(mission, {.belief = iteration}).belief);
}

ReplayedDecision replay_decision(const RecordedMission& mission, std::size_t iteration) {
  return std::move(*replay(mission, {.decision = iteration}).decision);
}

}  // namespace gnbv
