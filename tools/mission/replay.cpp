#include "tools/mission/replay.hpp"

#include <algorithm>
#include <utility>

#include "planner/core/belief.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

void need_same(const ViewRecord& now, const ViewRecord& recorded) {
  if (now.cloud_points == recorded.cloud_points && now.entropy_nat == recorded.entropy_nat) return;
  throw BadInput(
      "view {}: flown again it left {} points and {} nat, recorded were {} and {}: another version "
      "of the program or another mesh made this run; fly it anew",
      now.iteration, now.cloud_points, now.entropy_nat, recorded.cloud_points,
      recorded.entropy_nat);
}

/// What flies the first `count` views as recorded.
MissionInputs inputs_for(const RecordedMission& mission, std::size_t count) {
  MissionInputs inputs;
  for (const ViewRecord& view : mission.views.first(count)) inputs.replay.push_back(view.decision);
  if (traits_of(mission.scenario.planner).knows_structure) {
    inputs.sources.route = [views = mission.views, next = std::size_t{1}](const SurfaceCloud&,
                                                                          const HeedStop&) mutable {
      std::vector<Decision> route;  // all at first; may be empty: a profile needs no views
      for (; next < views.size(); ++next) route.push_back(views[next].decision);
      return route;
    };
  }
  return inputs;
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
  const PlannerModel model = planner_model(mission.scenario);
  Scratch scratch(model, mission.threads);
  std::vector<std::size_t> counts;
  for (const std::size_t count : waypoints) {
    if (count < log.marks.size()) counts.push_back(count);
  }
  if (!log.marks.empty()) counts.push_back(log.marks.size());
  std::vector<ProfileStage> stages;
  for (const std::size_t count : counts) {
    Belief belief(model);
    const auto& last = log.marks[count - 1];
    integrate_profile(model, std::span(log.sweeps).first(last.sweeps), scratch, belief);
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

/// Refuses another outcome than the recorded one, and keeps what the request asks for.
class ReplayWatch final : public MissionObserver {
 public:
  ReplayWatch(const RecordedMission& mission, const ReplayRequest& request, bool has_profile,
              std::size_t count, MissionInputs& inputs)
      : mission_(mission),
        request_(request),
        has_profile_(has_profile),
        count_(count),
        // a profile takes about as long as sixty views
        steps_(60.0 + static_cast<double>(count)),
        recorded_(inputs.replay),
        inputs_(inputs) {}

  void on_profile(double share) override {
    mission_.on_progress(count_ == 0 ? share : 60.0 * share / steps_);
  }
  void on_profile_sweeps(double time_s, std::span<const LidarScan> so_far) override {
    if (has_profile_) log.add(time_s, so_far);
  }
  void on_profile_belief(const Belief&) override { is_over = count_ == 0; }
  void on_view(const ViewRecord& view, const Belief& after) override {
    const auto i = static_cast<std::size_t>(view.iteration);
    GNBV_CHECK(i < mission_.views.size(), "view {} of {}", i, mission_.views.size());
    need_same(view, mission_.views[i]);
    mission_.on_progress(std::min(1.0, (61.0 + view.iteration) / steps_));
    ++views;
    if (views == request_.decision) before = after;
    if (request_.belief && views == *request_.belief + 1 && views < count_) belief = after;
    is_over = views == count_;
  }
  void on_plan(std::size_t, const Plan& made) override {
    plan = made;
    inputs_.replay = recorded_;  // the mission reads it decision by decision
  }
  void on_replayed(std::size_t iteration, const Plan& made) override {
    if (iteration == request_.decision) plan = made;
  }

  bool is_over = false;
  std::size_t views = 0;
  ProfileLog log;
  Plan plan;
  std::optional<Belief> before = {};  // the decision
  std::optional<Belief> belief = {};

 private:
  const RecordedMission& mission_;
  const ReplayRequest& request_;
  const bool has_profile_;
  const std::size_t count_;
  const double steps_;
  const std::vector<Decision> recorded_;
  MissionInputs& inputs_;
};

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
  MissionInputs inputs = inputs_for(mission, count);
  ReplayWatch watch(mission, request, has_profile, count, inputs);
  if (request.decision && request.plans) {
    inputs.replay.resize(*request.decision);  // the next one is made again
  }
  inputs.observers = {&watch};
  inputs.should_stop = [&] { return watch.is_over; };
  MissionResult result =
      run_mission(mission.scenario, mission.world, mission.scene, inputs, mission.threads);
  GNBV_CHECK(watch.views == count, "the mission ended after {} views of {}", watch.views, count);
  Replayed out;
  if (has_profile)
    out.profile = stages_of(mission, watch.log, result.trajectory, request.waypoints);
  out.belief = std::move(watch.belief);
  if (request.belief && !out.belief) out.belief = std::move(result.belief);
  if (request.decision) {
    out.decision = ReplayedDecision{std::move(*watch.before), std::move(watch.plan)};
  }
  return out;
}

}  // namespace gnbv
