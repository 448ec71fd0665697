// Adaptive Grid Viewpoint Sampling (paper section 2.4, Fig. 5).
#pragma once

#include <span>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// Defaults: section 3.1.1, the scale rule of the released code, and the paper's own sign of a
/// local minimum, the entropy change per voxel of the view (section 2.4).
struct AgvsConfig {
  double step_m = 1.0;
  double yaw_step_rad = deg_to_rad(45.0);
  bool rotation_only = true;  // offer the current position with other yaws, at scale 1
  double scale_factor = 1.5;  // at each detected local minimum
  double scale_max = 7.5;
  double utility_threshold = 0.1;         // local minimum: best utility below this ...
  int utility_window = 3;                 // ... over this many views,
  double entropy_threshold_nat = 0.0002;  // or largest entropy change per voxel below this ...
  int entropy_window = 4;                 // ... over this many views; threshold 0 = never
};

/// 3 x 3 x 3 positions in the body-yaw frame at step_m * scale, times 3 yaws, yaws innermost, in a
/// fixed order; the current position only as AgvsConfig says, and never the current pose itself.
std::vector<ViewPose> sample_agvs(const AgvsConfig& config, const ViewPose& current, double scale);

/// What a local minimum shows in, oldest first.
struct Progress {
  std::vector<double> utilities;          // of the chosen views
  std::span<const double> entropies_nat;  // total, before and after each view
  double view_voxels = 1.0;               // of the cameras' frusta
};

/// Scale for the next view: the last one grown by scale_factor (at most scale_max) at a local
/// minimum, else 1.
double next_agvs_scale(const AgvsConfig& config, double last_scale, const Progress& progress);

}  // namespace gnbv
