// THE mission: profile, then view after view until it is over (paper, Fig. 1).
#pragma once

#include <functional>
#include <vector>

#include "scenarios/scenario.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/world.hpp"
#include "tools/mission/mission_result.hpp"

namespace gnbv {

struct MissionHooks {
  std::function<void(double share_done)> on_profile = [](double) {};  // 0 to 1
  std::function<void(const ViewRecord&)> on_view = [](const ViewRecord&) {};
  std::function<bool()> should_stop = [] { return false; };  // asked after each view
  std::vector<Decision> replay;  // decisions of an interrupted run: flown again, not planned again
};

/// Runs the mission. The result is the same at any number of threads, replayed or not.
MissionResult run_mission(const Scenario& scenario, const World& world, const RayScene& scene,
                          const MissionHooks& hooks, int threads);

}  // namespace gnbv
