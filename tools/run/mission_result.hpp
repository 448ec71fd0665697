// What a mission leaves behind.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/score/mission_score.hpp"
#include "planner/core/belief.hpp"
#include "planner/core/plan.hpp"
#include "planner/core/planner.hpp"
#include "planner/symmetry/symmetry.hpp"
#include "scenarios/scenario.hpp"
#include "sim/flight/flight.hpp"
#include "tools/run/tour_files.hpp"

namespace gnbv {

/// Wall time spent, by what it was spent on. Never part of a result.
struct WallTimes {
  double profile_s = 0.0;
  double symmetry_s = 0.0;
  double sense_s = 0.0;
  double map_s = 0.0;
  double plan_s = 0.0;
  double fly_s = 0.0;
  double score_s = 0.0;
};

struct TrajectorySample {
  double time_s = 0.0;
  Isometry T_world_body = Isometry::Identity();
};

/// One view that was taken; a row of iterations.csv.
struct ViewRecord {
  int iteration = 0;  // from 0, the start
  Decision decision = {};
  double entropy_nat = 0.0;  // total, after the view
  double density_points_per_voxel = 0.0;
  std::size_t cloud_points = 0;
  double straight_m = 0.0;               // from the first view to this one, along the planned legs
  double flown_m = 0.0;                  // the same, as flown
  double time_s = 0.0;                   // simulated, since the start of the mission
  std::optional<double> energy_wh = {};  // drawn since then; not known of runs of older versions
  WallTimes wall = {};                   // of this view alone

  /// The iteration of the first view of its plan: what tells of the decision tells of that one.
  std::size_t planned_at() const {
    return static_cast<std::size_t>(iteration + 1 - decision.plan_view);
  }
};

/// A view that a user gave, and what became of it. Neither: the mission ended before.
struct UserView {
  ViewPose view;
  std::optional<Rejection> rejected = {};
  std::optional<std::size_t> iteration = {};  // that took it
};

struct MissionDistances {
  double profile_m = 0.0;  // planned legs of the profile, its approach included
  double profile_flown_m = 0.0;
  double transfer_m = 0.0;  // from the end of the profile to the first view, planned
  double straight_m = 0.0;  // planned legs from view to view
  double flown_m = 0.0;     // the same legs, as flown
};

/// How far the vehicle truly was from the straight legs it was to fly, tick by tick.
struct PathError {
  double squares_m2 = 0.0;
  std::int64_t ticks = 0;
  double max_m = 0.0;

  void add(double distance_m) {
    squares_m2 += distance_m * distance_m;
    ++ticks;
    max_m = std::max(max_m, distance_m);
  }
  double rms_m() const {
    return ticks == 0 ? 0.0 : std::sqrt(squares_m2 / static_cast<double>(ticks));
  }
};

/// Camera frames that were due, at views and in flight.
struct FrameCounts {
  std::int64_t taken = 0;
  std::int64_t dropped = 0;  // not among the taken
};

/// How the mission came home.
struct HomeFlight {
  bool reached = false;  // home, in the air
  bool landed = false;   // there, or where the battery left off
  double flown_m = 0.0;  // with the landing
};

/// Whether the profile has a mirror image, and what it predicts.
struct Prediction {
  Symmetry symmetry;  // its mirrored points are dropped
  std::size_t predicted_voxels = 0;
};

struct MissionResult {
  MissionResult(const ViewPose& start_pose, const PlannerModel& planner)
      : start(start_pose), belief(planner) {}

  ViewPose start;  // of the mission, and of the first view
  Termination termination = Termination::interrupted;
  std::string failure;                       // of utility_failed: what was wrong
  std::map<Rejection, int> last_rejections;  // of the decision that found no valid view
  std::vector<ViewRecord> views;
  std::vector<UserView> user_views;          // in their order, of a mission that flies such
  std::vector<ViewOutcome> gain_outcomes;    // of a tour
  std::vector<MadePlan> tour_plans;          // likewise, each time it was made anew
  std::vector<TrajectorySample> trajectory;  // true motion at 10 Hz
  MissionDistances distance;
  double profile_end_s = 0.0;
  double flight_time_s = 0.0;
  double energy_wh = 0.0;
  VehicleState final_state;  // true, when the mission ended: after a collision, where and how fast
  double entropy_after_profile_nat = 0.0;
  Prediction prediction;
  int legs_timed_out = 0;
  PathError path_error;
  FrameCounts frames;
  std::optional<HomeFlight> home;  // of missions that end there
  std::vector<Vec3f> profile_points_world_m;
  Belief belief;
  WallTimes wall;
};

/// Of scenarios whose battery is never empty: a 3DR Iris+ has 5.1 Ah at 11.1 V.
constexpr double kUsualBattery_wh = 56.6;

/// How far the mission was after each view, and whether on one battery: whether what it had drawn,
/// a straight leg home at path speed in still air and the landing there are no more than the
/// battery without its reserve (vehicle.power.battery_wh and reserve_share; where it is never
/// empty, kUsualBattery_wh). Home is the first view. A mission with return_home takes no view from
/// which the ways that it knows, which are longer, would take more.
std::vector<ViewMark> view_marks(const Scenario& scenario, std::span<const ViewRecord> views);

/// What a score needs of a mission.
ScoredCloud scored_cloud(const Scenario& scenario, const MissionResult& result);

/// A line for a flight that truly was farther from its legs than planner.validity.
/// collision_radius_m leaves beyond the hull, so that only luck kept it from the structure; nothing
/// for others.
std::string margin_note(const Scenario& scenario, const PathError& error);

/// SHA-256 over all that the mission measured, decided and believed: flight, views, map, cloud.
std::string result_sha256(const MissionResult& result);

}  // namespace gnbv
