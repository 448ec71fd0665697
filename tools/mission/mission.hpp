// THE mission: profile, then view after view until it is over (paper, Fig. 1).
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "planner/decision.hpp"
#include "scenarios/scenario.hpp"
#include "sensors/frames.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/mesh/world.hpp"
#include "tools/run_files/mission_result.hpp"

namespace gnbv {

struct MissionHooks {
  std::function<void(double share_done)> on_profile = [](double) {};  // 0 to 1
  /// All sweeps so far, when the profile leaves a station where it scanned, and at its end.
  std::function<void(double time_s, std::span<const LidarScan>)> on_profile_sweeps =
      [](double, std::span<const LidarScan>) {};
  std::function<void(const Belief&)> on_profile_belief = [](const Belief&) {};  // at its end
  std::function<void(const ViewRecord&)> on_view = [](const ViewRecord&) {};
  /// What is believed after the latest view, before the next is decided.
  std::function<void(const Belief&)> on_view_belief = [](const Belief&) {};
  /// The frames of a view, camera by camera, before they are believed. Colour is captured only when
  /// this is set.
  std::function<void(std::size_t iteration, double time_s, std::span<const DepthFrame>,
                     std::span<const ColourFrame>)>
      on_frames;
  /// All candidates of a decision, before the chosen one is flown to; `iteration` is the view that
  /// it chooses. Not called for replayed decisions.
  std::function<void(std::size_t iteration, const Plan&)> on_candidates = [](std::size_t,
                                                                             const Plan&) {};
  /// What each view measured, as believed: the vehicle's pose and the frames, camera by camera.
  std::function<void(const Isometry& T_world_body, std::span<const DepthFrame>)> on_sensed =
      [](const Isometry&, std::span<const DepthFrame>) {};
  /// One more view for a mission that flies given ones and has used up those of its scenario;
  /// nothing: there are no more.
  std::function<std::optional<ViewPose>()> next_given = [] { return std::nullopt; };
  /// A given view, by its index, that cannot be flown.
  std::function<void(std::size_t index, Rejection)> on_refused = [](std::size_t, Rejection) {};
  /// Scores of an own utility; without it, it is started when first asked.
  OwnScores own_scores;
  /// Asked at every tick of a leg but on the way home, after each leg of the profile, at its end,
  /// and after each view.
  std::function<bool()> should_stop = [] { return false; };
  /// Asked after each view, of the truth: whether a benchmark has seen enough of the structure.
  std::function<bool(const Belief&)> is_covered = [](const Belief&) { return false; };
  std::vector<Decision> replay;  // decisions of an interrupted run: flown again, not planned again
  /// Views that someone else chose, flown after the start instead of planning. The mission ends as
  /// route_flown after the last of them; of the planner's rules of termination only the limits of
  /// views, metres and seconds hold.
  std::optional<std::vector<Decision>> route;
};

std::vector<CameraModel> camera_models(const Scenario& scenario);

/// Runs the mission. The result is the same at any number of threads, replayed or not. An oracle's
/// mission (is_oracle()) needs its route.
MissionResult run_mission(const Scenario& scenario, const World& world, const RayScene& scene,
                          const MissionHooks& hooks, int threads);

}  // namespace gnbv
