// What a planner answers: the views to fly and why they were chosen, or why the mission ends; and
// what else there was to choose from.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "planner/map/frontiers.hpp"
#include "planner/motion/paths.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

/// Why a mission is over. Files hold the name.
enum class Termination {
  max_iterations,
  max_distance,     // the way to the next view would be too long
  max_flight_time,  // ends in flight
  entropy_change,
  low_gain,       // too few new voxels a metre
  no_new_points,  // views that add nothing to the cloud
  no_valid_view,
  repeated_motion,   // goes back and forth between two places
  battery,           // what is left is needed to land, or to come home and land
  route_flown,       // every view of a given route was taken
  off_course,        // carried out of the workspace
  tour_complete,     // tour: no view pays any more
  coverage_reached,  // told by the truth, for benchmarks
  utility_failed,    // a utility of the user's own raised, or returned what are no scores
  interrupted,
  collision
};
std::string_view name_of(Termination reason);

/// Where a view comes from. Files hold the name; whoever needs more asks traits_of().
enum class Sampler { start, fvs, agvs, route, oracle, tour };

struct SamplerTraits {
  std::string_view name = {};   // in files
  std::string_view words = {};  // under pictures: "104 of the grid"; empty: nothing is sampled
  bool is_scored = false;       // its views compete by a utility
  bool on_grid = false;         // its views lie on a grid around the current one
  bool at_frontier = false;     // its views look at a cluster of frontier voxels
};
const SamplerTraits& traits_of(Sampler sampler);
/// Nothing for a text that is no sampler's name.
std::optional<Sampler> sampler_named(std::string_view name);

/// What a view is worth, with the terms it is made of. Terms that a formula lacks are 0, the
/// distance factor 1.
struct Score {
  double value = 0.0;
  double information = 0.0;  // E hat of Eq. (2), or the gain before any discount
  double density = 0.0;      // D hat
  double prediction = 0.0;   // P hat
  double distance = 1.0;     // exp(-lambda d)
};

/// What a vehicle that does not stop at a view is to pass after it.
struct Onward {
  ViewPose pose;
  bool is_view = true;  // false: a point on the way to the next one
};

/// A chosen view and why.
struct Decision {
  ViewPose view;
  Sampler sampler = Sampler::start;
  double scale = 1.0;
  int candidates = 0;  // sampled
  int valid = 0;       // of them not rejected
  Score score = {};
  std::vector<Vec3> via_world_m = {};  // points on the way there; none: straight
  int plan_view = 1;                   // its number in its plan: from 2 on nothing was decided
  std::vector<Onward> then = {};       // meant to be flown after it, by straight legs; not in files
};

/// A sampled view with what became of it.
struct Candidate {
  ViewPose view;
  Sampler sampler;
  double scale = 1.0;                      // of the AGVS grid
  int cluster = -1;                        // FVS: the cluster it looks at, 0 = the first tried
  std::optional<Rejection> rejected = {};  // nothing: it competed with `score`
  std::vector<Vec3> via_world_m = {};      // points on the way there
  double path_m = 0.0;                     // length of the way
  std::optional<int> covers = {};          // burst: points left of its cluster's that it sees
  Score score = {};
};

struct PlannerModel;
/// Fills in whether the candidate may be flown to and the gimbal can, and the way there.
void check(ViewChecker& checker, const PlannerModel& model, Candidate& candidate);

struct TourNotes;  // planner/tour/gains.hpp

/// One or more views to be flown in order, or why there is none; and all candidates of this
/// decision in the order in which they were sampled.
struct Plan {
  std::vector<Decision> views = {};
  Termination end = Termination::no_valid_view;  // where there is no view: why the mission ends
  std::vector<std::size_t> chosen = {};          // of the candidates: one for each view
  std::vector<Candidate> candidates = {};
  std::vector<FrontierCluster> clusters = {};  // FVS: those it may try, by Candidate::cluster
  std::vector<VoxelIndex> frontier = {};       // FVS: of all clusters that there were, ascending
  std::shared_ptr<const TourNotes> tour = {};  // of a tour

  bool has_view() const { return !views.empty(); }
  /// The view that is flown next. Requires has_view().
  const Decision& next() const { return views.front(); }
  /// Whether the candidate of this index is one of the views.
  bool is_chosen(std::size_t candidate) const;
  /// Whether the views are kept for the points that they cover, and compete by no utility.
  bool is_burst() const { return !chosen.empty() && candidates[chosen.front()].covers.has_value(); }
  /// Whether one of them is a view of the cluster of this number.
  bool looks_at(int cluster) const;
};

/// How many views each reason refused. One that was checked more than once, as those of a cluster
/// that is tried again on ways around, counts by what was found last.
std::map<Rejection, int> rejections_of(const Plan& plan);

/// Makes it a plan of one view: the candidate of that index, as it is.
void choose(Plan& plan, std::size_t candidate, int sampled, int valid);

}  // namespace gnbv
