// The initial rough scan: where to fly it (paper section 2.2, Fig. 4).
#pragma once

#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

enum class ProfilingMethod { bounding_box, none };

struct ProfilingConfig {
  ProfilingMethod method = ProfilingMethod::bounding_box;
  bool scan_in_transit = true;  // LIDAR on between the descents too
};

/// One straight leg of the profile.
struct ProfileLeg {
  ViewPose goal;
  bool is_descent = false;  // flown at profiling speed; otherwise a transit
};

/// Eight descents on the faces of the navigation box: four corners and four side middles, from top
/// to bottom, facing the centre, in order around the box from the one nearest to `start`, in the
/// direction of the nearer neighbour.
std::vector<ProfileLeg> bounding_box_profile(const Box3& navigation_m, const ViewPose& start);

}  // namespace gnbv
