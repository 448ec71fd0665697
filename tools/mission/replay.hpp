// A recorded mission flown once more, up to where something of it is asked for: what the planner
// believed on the way stands in no file.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "tools/mission/mission.hpp"

namespace gnbv {

/// What to fly again. Everything referred to stays with the caller.
struct RecordedMission {
  const Scenario& scenario;
  const World& world;
  const RayScene& scene;
  std::span<const ViewRecord> views;  // as recorded
  int threads = 1;
  std::function<void(double share_done)> on_progress = [](double) {};  // 0 to 1
};

/// The profile after some of its waypoints: the stations where it scans up or down.
struct ProfileStage {
  std::size_t waypoints = 0;
  std::vector<Vec3f> points_world_m = {};    // of all sweeps so far, as the cloud takes them
  std::vector<Vec3> path_world_m = {};       // flown so far, from the start of the mission
  std::vector<Vec3> waypoints_world_m = {};  // where each of them was left
};

/// A decision, and the belief on which it was made.
struct ReplayedDecision {
  Belief belief;
  Plan
      plan;  // made again; without candidates for a mission that was handed its views (an oracle's)
};

/// What one flight is to bring back.
struct ReplayRequest {
  /// The profile after each of those numbers of waypoints (ascending, from 1) as far as they are
  /// less than it has, and after its last one. Nothing of a mission that took up a saved profile,
  /// flew none, or ended before its first waypoint.
  std::vector<std::size_t> waypoints = {};
  bool has_profile = false;
  std::optional<std::size_t> belief = {};    // what was believed after this view
  std::optional<std::size_t> decision = {};  // whose first view this is, not the start
  bool plans =
      true;  // the decision again; else its plan is what a mission that is resumed makes of it
};

struct Replayed {
  std::vector<ProfileStage> profile = {};
  std::optional<Belief> belief = {};
  std::optional<ReplayedDecision> decision = {};
};

/// All of that from one flight; no view is flown for a profile. Requires views of the mission.
/// Throws BadInput when the flight does not come out as recorded: then another program made the
/// record.
Replayed replay(const RecordedMission& mission, const ReplayRequest& request);

}  // namespace gnbv
