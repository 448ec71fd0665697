// Where candidate views are sampled (paper section 2.4): around the current one (AGVS, Fig. 5), or
// around thinly sampled surface (FVS, Fig. 6). When that changes: the local minimum.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/core/planner.hpp"
#include "planner/map/frontiers.hpp"

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

/// The clusters of density frontiers that a decision made at `from_world_m`, after those made
/// before, may try: in their order, FvsConfig::tries of them at most. A cluster that is still there
/// after looks_max views around it stays (glass, a slit, an edge) and is left out.
std::vector<FrontierCluster> clusters_to_try(const FvsConfig& fvs, const Belief& belief,
                                             std::span<const Decision> decisions,
                                             const Vec3& from_world_m, FrontierMarks& marks);

/// cluster_outside_fov when no camera has the centroid in its frustum; cluster_hidden when none
/// sees a voxel of the cluster, if `needs_visible_cluster`; else nothing.
std::optional<Rejection> cluster_rejection(std::span<const CameraModel> cameras,
                                           const OccupancyGrid& grid,
                                           const FrontierCluster& cluster, const ViewPose& view,
                                           bool needs_visible_cluster);

/// Whether each of the last `window` changes of the total entropy is below the threshold, per voxel
/// of PlannerModel::view_voxels.
bool is_entropy_still(double threshold_nat, int window, const History& history, double view_voxels);

/// Scale for the next view: the last one grown by scale_factor (at most scale_max) at a local
/// minimum, else 1.
double next_agvs_scale(const AgvsConfig& config, const History& history, double view_voxels);

}  // namespace gnbv
