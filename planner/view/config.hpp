// The settings of what is counted of a view.
#pragma once

namespace gnbv {

/// Depth of the shadow band behind a hit, along its ray. Default: the launch file of the released
/// code of Delmerico et al.
struct ShadowConfig {
  double shadow_depth_m = 0.3;
};

/// The depth is at most this: a ray of such a length takes fewer than 256 steps along three axes.
constexpr double kMaxShadow_voxels = 80.0;

}  // namespace gnbv
