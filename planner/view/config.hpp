// The settings of what a view is looked at with.
#pragma once

namespace gnbv {

/// Depth of the shadow band behind a hit, along its ray. Default: the launch file of the released
/// code of Delmerico et al.
struct ShadowConfig {
  double shadow_depth_m = 0.3;
};

/// The band is no deeper: three axes of so many steps fit a byte.
constexpr double kMaxShadow_voxels = 80.0;

}  // namespace gnbv
