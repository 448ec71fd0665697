// When the mission is over (paper section 2.6).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "sim/core/pose.hpp"

namespace gnbv {

/// Defaults: Table 1 with the released window; max_iterations is the paper's longest aircraft run.
/// What the paper does not have is off.
struct TerminationConfig {
  int max_iterations = 635;
  double entropy_change_percent = 0.001;  // of the total entropy, per view; 0 switches it off
  int entropy_window = 5;                 // consecutive views
  int repeated_moves = 10;                // back and forth, in a row; 0 switches it off
  double max_distance_m = 0.0;            // planned, from the first view on; 0 switches it off
  double max_flight_time_s = 0.0;         // simulated, since the mission began; 0 switches it off
  double min_new_voxels_per_m = 0.0;      // over the window; 0 switches it off
  int new_voxels_window = 10;             // consecutive views
  int max_views_without_new_points = 0;   // in a row; 0 switches it off
};

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

/// Whether each of the last entropy_window views changed the total entropy by less than the
/// threshold: 100 |E_n - E_n-1| / mean(E_n, E_n-1) < entropy_change_percent.
/// `entropies_nat`: total entropy before the first view with a depth return and after each view
/// from then on, oldest first; an unarmed rule sees fewer than entropy_window + 1 values.
bool entropy_has_settled(const TerminationConfig& config, std::span<const double> entropies_nat);

/// What is believed after a view, as far as the rules of gain look at it.
struct MapProgress {
  std::size_t occupied_voxels = 0;  // of the map
  std::size_t cloud_points = 0;     // one a leaf
  double straight_m = 0.0;          // planned, from the first view on
};

/// Whether the last new_voxels_window views together made fewer voxels occupied than
/// min_new_voxels_per_m times the planned metres between them. Views that only turn have no metres
/// and end nothing. `progress`: after each view, oldest first; the rule needs window + 1 of them.
bool gain_is_low(const TerminationConfig& config, std::span<const MapProgress> progress);

/// Whether none of the last max_views_without_new_points views added a point to the cloud.
bool points_have_dried_up(const TerminationConfig& config, std::span<const MapProgress> progress);

/// Whether a next leg of `leg_m` would make the planned way longer than max_distance_m.
bool is_too_far(const TerminationConfig& config, double straight_m, double leg_m);

/// Whether each of the last `moves` moves only undoes the one before: the position is that of two
/// views ago (within a centimetre), and another than that of the view before.
bool is_back_and_forth(std::span<const Vec3> positions_m, int moves);

/// Which of the rules that read the belief end a mission; its planner says.
struct EndRules {
  bool entropy = true;     // entropy_change_percent
  bool gain = true;        // min_new_voxels_per_m, max_views_without_new_points
  bool repetition = true;  // repeated_moves
};

/// The first of the rules of belief that holds after a view, in the order of the enumeration.
std::optional<Termination> believed_end(const TerminationConfig& config, const EndRules& rules,
                                        std::span<const double> entropies_nat,
                                        std::span<const MapProgress> progress,
                                        std::span<const Vec3> positions_m);

}  // namespace gnbv
