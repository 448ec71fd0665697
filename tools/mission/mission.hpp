// THE mission: profile, then view after view until it is over (paper, Fig. 1).
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "planner/planners.hpp"
#include "scenarios/scenario.hpp"
#include "sensors/frames.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/mesh/world.hpp"
#include "tools/run/mission_result.hpp"

namespace gnbv {

/// The frames and sweeps of a view, sensor by sensor, before they are believed.
struct SensedView {
  std::size_t iteration = 0;
  double time_s = 0.0;
  const Isometry& T_world_body;  // as believed
  std::span<const DepthFrame> depth;
  std::span<const ColourFrame> colour;     // empty unless somebody wants them
  std::span<const LidarScan> sweeps = {};  // of the LIDARs that look
};

/// Watches a mission. Decides nothing and changes nothing of it.
class MissionObserver {
 public:
  virtual ~MissionObserver() = default;
  virtual void on_profile(double /*share_done*/) {}  // 0 to 1
  /// All sweeps so far, when the profile leaves a station where it scanned, and at its end.
  virtual void on_profile_sweeps(double /*time_s*/, std::span<const LidarScan>) {}
  virtual void on_profile_belief(const Belief&) {}  // at its end
  virtual bool wants_colour() const { return false; }
  virtual void on_sensed(const SensedView&) {}
  /// A view that was taken, and what is believed after it, before the next is decided.
  virtual void on_view(const ViewRecord&, const Belief&) {}
  /// A decision, before its views are flown; `iteration`: of the first of them.
  virtual void on_plan(std::size_t /*iteration*/, const Plan&) {}
  /// Instead, a decision that is replayed: what of it was planned anew (Planner::replay).
  virtual void on_replayed(std::size_t /*iteration*/, const Plan&) {}
};

/// A mission at a pause; nothing in it changes. Memory: that of its belief.
struct MissionMoment;
using KeptMoment = std::shared_ptr<const MissionMoment>;
const Belief& belief_of(const MissionMoment& moment);

/// Where a mission can be kept: after its profile, and before each decision until that is made,
/// also from another thread while the mission waits for a view from outside.
struct MissionPause {
  std::size_t views = 0;  // taken so far
  std::function<KeptMoment()>
      keep;  // throws std::runtime_error where the vehicle touches something
};

/// What a mission is given beside scenario and world.
struct MissionInputs {
  std::vector<MissionObserver*> observers = {};  // told in this order; they stay with the caller
  /// Asked at every tick of a leg but on the way home, after each leg of the profile, at its end,
  /// after each view, and several times a second while the planner works.
  std::function<bool()> should_stop = [] { return false; };
  /// Asked after each view, of the truth: whether a benchmark has seen enough of the structure.
  std::function<bool(const Belief&)> is_covered = [](const Belief&) { return false; };
  std::vector<Decision> replay = {};  // of an interrupted run: flown again, not planned again
  /// Flies on from there instead of from the start, bit by bit as the kept mission would have; of
  /// the same scenario, which after a profile may have another seed unless profile_reads_seed().
  /// After more than that the planner has to be one that takes views.
  KeptMoment from = {};
  std::function<void(const MissionPause&)> on_pause = {};
  /// What comes to the planner from outside. A utility of the user's own is started when first
  /// asked, unless it is here.
  PlannerSources sources = {};
};

std::vector<CameraModel> camera_models(const Scenario& scenario);
/// What the planner of this scenario knows.
PlannerModel planner_model(const Scenario& scenario);

/// Whether anything up to the first view depends on the scenario's seed.
bool profile_reads_seed(const Scenario& scenario);

/// Runs the mission. The result is the same at any number of threads, replayed or not. The mission
/// of a planner that knows the structure needs its route.
MissionResult run_mission(const Scenario& scenario, const World& world, const RayScene& scene,
                          const MissionInputs& inputs, int threads);

}  // namespace gnbv
