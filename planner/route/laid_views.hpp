// Baselines that plan all their views at once from the profile, and ask no utility: what a planner
// that decides view by view has to beat.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

struct CameraModel;
class OccupancyGrid;

constexpr std::size_t kMostUserViews = 100000;

struct RouteConfig {
  double standoff_m = 4.0;  // from the occupied voxels of the profile: half of the cameras' range
  double overlap = 0.3;     // lawnmower: of neighbouring images
  std::vector<ViewPose> views = {};  // route: body poses, in the order in which they are flown
};

/// What a route is laid around.
struct RouteProblem {
  const OccupancyGrid& grid;
  const Box3& navigation_m;
  const CameraModel& camera;  // whose footprint spaces the rows
  ViewPose start;
  int views = 1;  // uniform_hemisphere: how many, kMostLaidViews at most
};
constexpr int kMostLaidViews = 10'000;  // ordering them takes the square of it

/// All views of a mission in the order in which they are to be flown; empty where nothing is
/// occupied. A gimbal looks at what the view does.
using LayViews = std::vector<ViewPose> (*)(const RouteConfig&, const RouteProblem&);

/// Directions spread evenly over the upper half space, each view where a line from the structure's
/// centre comes out of its surroundings. It looks at the centre.
std::vector<ViewPose> lay_hemisphere(const RouteConfig& config, const RouteProblem& problem);

/// Rows back and forth on four sides, looking level, and above, looking down. Throws BadInput when
/// it would need more than kMostLaidViews.
std::vector<ViewPose> lay_lawnmower(const RouteConfig& config, const RouteProblem& problem);

}  // namespace gnbv
