// A mission that is drawn by flying it again, beside what happened when it was flown.
#pragma once

#include <map>

#include "tests/support/flown.hpp"
#include "tests/support/watch.hpp"
#include "tools/mission/replay.hpp"
#include "tools/scene/run_source.hpp"

namespace gnbv {

/// The iteration that is asked for.
constexpr std::size_t kAsked = 3;

/// A mission of five views, each decided by itself, with what was believed and planned on the way.
struct Watched {
  explicit Watched(const Scenario& scenario) : flown(scenario, inputs()) {}

  MissionInputs inputs() {
    watch.view = [this](const ViewRecord&, const Belief& belief) { beliefs.push_back(belief); };
    watch.plan = [this](std::size_t iteration, const Plan& plan) { plans[iteration] = plan; };
    return {.observers = {&watch}};
  }
  RecordedMission recorded() const {
    return {.scenario = flown.scenario,
            .world = flown.world,
            .scene = flown.scene,
            .views = flown.result.views,
            .threads = 2};
  }

  /// That chose the view.
  const Plan& plan_of(std::size_t view) const {
    return plans.at(flown.result.views[view].planned_at());
  }

  Watch watch = {};
  std::vector<Belief> beliefs = {};
  std::map<std::size_t, Plan> plans = {};  // by the iteration of the first view of each
  Flown flown;
};

inline const Watched& watched() {
  static const Watched all(
      smoke({"planner.termination.max_iterations=5", "planner.fvs.mode=single"}));
  return all;
}

/// A mission that goes over to bursts as soon as it may.
inline const Watched& watched_bursts() {
  static const Watched all(
      smoke({"planner.termination.max_iterations=8", "planner.fvs.mode=burst",
             "planner.fvs.entropy_threshold_nat=1", "planner.fvs.entropy_window=1"}));
  return all;
}

inline RunSource source(const std::filesystem::path& folder = {}) {
  const Flown& flown = watched().flown;
  return {RunRecord{.folder = folder, .scenario = flown.scenario, .views = flown.result.views},
          flown.world};
}

inline std::vector<ProfileStage> replay_profile(const RecordedMission& mission,
                                                std::span<const std::size_t> waypoints) {
  return replay(mission, {.waypoints = {waypoints.begin(), waypoints.end()}, .has_profile = true})
      .profile;
}

}  // namespace gnbv
