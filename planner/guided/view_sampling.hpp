// Where candidate views are sampled (paper section 2.4): around the current one (AGVS, Fig. 5), or
// around thinly sampled surface (FVS, Fig. 6).
#pragma once

#include <span>
#include <vector>

#include "planner/map/config.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

/// Adaptive Grid Viewpoint Sampling. Defaults: section 3.1.1 and the released scale rule.
struct AgvsConfig {
  double step_m = 1.0;
  double yaw_step_rad = deg_to_rad(45.0);
  bool rotation_only = true;  // offer the current position with other yaws, at scale 1
  bool scales = true;         // grow the grid at a local minimum
  double scale_factor = 1.5;
  double scale_max = 7.5;
  double utility_threshold = 0.1;      // local minimum: best utility below this ...
  int utility_window = 3;              // ... over this many views,
  int repeated_moves = 4;              // or so many moves back and forth; 0 = never,
  double entropy_threshold_nat = 0.0;  // or largest entropy change per voxel below this ...
  int entropy_window = 4;              // ... over this many views; threshold 0 = never
};

/// Which clusters FVS looks at first; the nearer of equals.
enum class ClusterOrder { nearest, largest };

/// Frontier Viewpoint Sampling. Defaults: the paper, with the released figures where it has none;
/// `tries`, `agvs_when_stuck` and `when_grid_finds_nothing` are our own, see FIDELITY.md.
struct FvsConfig {
  bool enabled = true;
  double entropy_threshold_nat = 0.002;  // local minimum: largest entropy change per voxel below
  int entropy_window = 4;                // this over so many views
  FrontierConfig frontier;
  ClusterOrder order = ClusterOrder::nearest;
  int tries = 50;              // clusters, in this order, until one has a valid view
  bool pool_clusters = false;  // the views of all these clusters compete (released code)
  int looks_max = 0;           // frontier views at a cluster before it is left; 0: any number
  int views_per_layer = 4;
  double radius_m = 3.5;              // of the cylinder around the centroid
  double layer_step_m = 1.0;          // three layers: this below, at and above the centroid
  bool needs_visible_cluster = true;  // a view must see a voxel of the cluster (occlusion culling)
  bool agvs_when_stuck = true;        // where no cluster has a valid view; else the mission ends
  bool when_grid_finds_nothing = true;  // else the mission ends without having looked for any
};

/// 3 x 3 x 3 positions in the body-yaw frame at step_m * scale, times 3 yaws, yaws innermost, in a
/// fixed order; the current position only as AgvsConfig says, and never the current pose itself.
/// Each with all `pitches_rad` of the gimbal, pitches innermost; by default the one it has.
std::vector<ViewPose> sample_agvs(const AgvsConfig& config, const ViewPose& current, double scale,
                                  std::span<const double> pitches_rad = {});

/// Three layers of views_per_layer views on a cylinder around the vertical through the centroid,
/// looking at that axis; the first stands to the east (+x) of it. Each with all pitches as above,
/// by default 0.
std::vector<ViewPose> sample_fvs(const FvsConfig& config, const Vec3& centroid_world_m,
                                 std::span<const double> pitches_rad = {});

/// Whether a view of sample_fvs() was one of this centroid's, or of one no further than
/// `apart_m` from it.
bool looks_at(const FvsConfig& config, const ViewPose& view, const Vec3& centroid_world_m,
              double apart_m);

/// What a local minimum shows in, oldest first.
struct Progress {
  std::vector<double> utilities = {};          // of the chosen views
  std::vector<Vec3> positions_m = {};          // of all views so far
  std::span<const double> entropies_nat = {};  // total, before and after each view
  double view_voxels = 1.0;                    // of the cameras' frusta
};

/// Whether each of the last `window` changes of the total entropy is below the threshold per voxel.
bool is_entropy_still(double threshold_nat, int window, const Progress& progress);

/// Scale for the next view: the last one grown by scale_factor (at most scale_max) at a local
/// minimum, else 1.
double next_agvs_scale(const AgvsConfig& config, double last_scale, const Progress& progress);

}  // namespace gnbv
