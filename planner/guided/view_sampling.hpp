// Where candidate views are sampled (paper section 2.4): around the current one (AGVS, Fig. 5), or
// around thinly sampled surface (FVS, Fig. 6). When that changes: the local minimum.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/core/planner.hpp"
#include "planner/guided/cluster_sight.hpp"
#include "planner/map/frontiers.hpp"

namespace gnbv {

/// Adaptive Grid Viewpoint Sampling. Defaults: section 3.1.1 and the released scale rule.
struct AgvsConfig {
  double step_m = 1.0;
  double yaw_step_rad = deg_to_rad(45.0);
  bool rotation_only = true;           // offer the current position with other yaws, at scale 1 ...
  bool rotation_at_all_scales = true;  // ... or at every scale
  bool current_pose = true;            // offer the current pose itself, at scale 1
  bool look_again = false;             // no utility above 0: view what is in sight once more
  bool scales = true;                  // grow the grid at a local minimum
  double scale_factor = 1.5;
  double scale_max = 7.5;
  double utility_threshold = 0.1;  // local minimum: best utility below this ...
  int utility_window = 3;          // ... over this many views,
  int repeated_moves = 4;          // or so many moves back and forth; 0 = never,
  RepeatedBy repeated_by = RepeatedBy::utilities;
  double entropy_threshold_nat = 0.0;  // or largest entropy change per voxel below this ...
  int entropy_window = 4;              // ... over this many views; threshold 0 = never
};

/// What FVS answers: a burst of views that covers the nearest clusters (burst.hpp), or the one view
/// of the highest utility.
enum class FvsMode { burst, single };

/// Which clusters FVS looks at first; the nearer of equals.
enum class ClusterOrder { nearest, largest };

/// The voxels that an entropy change is divided by: those of all frusta up to range_max_m, or of a
/// quarter of the first camera's from range_min_m on (the authors' code).
enum class VoxelsInView { frusta, quarter_frustum };

/// Frontier Viewpoint Sampling. Defaults: the paper, with the figures of its code where it has
/// none; `tries`, `agvs_when_stuck` and `when_grid_finds_nothing` are our own, see FIDELITY.md.
struct FvsConfig {
  bool enabled = true;
  FvsMode mode = FvsMode::burst;
  double entropy_threshold_nat = 0.002;  // local minimum: largest entropy change per voxel below
  int entropy_window = 3;                // this over so many views,
  int entropy_lag = 1;                   // not counting the last ones
  VoxelsInView voxels_in_view = VoxelsInView::quarter_frustum;
  FrontierConfig frontier;
  // ---- burst
  int clusters = 1;             // that one burst covers
  int clusters_growth = 0;      // by which they grow, for good, after one without a view
  int retries = 0;              // of such bursts in all of a mission, before the grid's turn comes
  double share_to_cover = 0.8;  // of the points left, by one view
  Culling culling = Culling::map;
  double fov_margin_m = 0.0;         // from the centroid to the frustum's sides
  bool keeps_blind = false;          // of a bearing, all views up to the first that sees a point
  bool first_bearing_twice = false;  // 360 degrees, too (the authors' code)
  // ---- single
  ClusterOrder order = ClusterOrder::nearest;
  int tries = 50;              // clusters, in this order, until one has a valid view
  bool pool_clusters = false;  // the views of all these clusters compete (released code)
  int looks_max = 0;           // frontier views at a cluster before it is left; 0: any number
  // ---- both
  int views_per_layer = 4;
  double radius_m = 2.5;                // of the cylinder around the centroid
  double layer_step_m = 1.0;            // three layers: this below, at and above the centroid
  bool needs_visible_cluster = false;   // a view must see a voxel of the cluster, or a point left
  bool agvs_when_stuck = true;          // where no cluster has a valid view; else the mission ends
  bool when_grid_finds_nothing = true;  // else the mission ends without having looked for any
};

/// Sets what the two modes differ in, besides how they plan: `single` as it was before version 1.0.
void set_mode_switches(FvsConfig& config);

/// 3 x 3 x 3 positions in the body-yaw frame at step_m * scale, times 3 yaws, yaws innermost, in a
/// fixed order; the current position and pose only as AgvsConfig says.
/// Each with all `pitches_rad` of the gimbal, pitches innermost; by default the one it has.
std::vector<ViewPose> sample_agvs(const AgvsConfig& config, const ViewPose& current, double scale,
                                  std::span<const double> pitches_rad = {});

/// Three layers of views_per_layer views (and the first one again, if so configured) on a cylinder
/// around the vertical through the centroid, looking at that axis; the first stands to the east
/// (+x) of it. Each with all pitches as above, by default 0.
std::vector<ViewPose> sample_fvs(const FvsConfig& config, const Vec3& centroid_world_m,
                                 std::span<const double> pitches_rad = {});

/// Fills in the plan's frontier, and the clusters that a decision made at `from_world_m`, after
/// those made before, may try: in their order, FvsConfig::tries of them at most. A cluster that is
/// still there after looks_max views around it stays (glass, a slit, an edge) and is left out.
void find_clusters_to_try(const FvsConfig& fvs, const Belief& belief,
                          std::span<const Decision> decisions, const Vec3& from_world_m,
                          FrontierMarks& marks, Plan& plan);

/// How many voxels that is.
double voxels_in_view(VoxelsInView which, const PlannerModel& model);

/// Whether each of the last `window` changes of the total entropy, but for the last `lag` ones, is
/// below the threshold, per voxel in view.
bool is_entropy_still(double threshold_nat, int window, int lag, const History& history,
                      double view_voxels);

/// Scale for the next view: the last one grown by scale_factor (at most scale_max) at a local
/// minimum, else 1.
double next_agvs_scale(const AgvsConfig& config, const History& history, double view_voxels);

}  // namespace gnbv
