// Baselines that plan all their views at once from the profile, and ask no utility: what a planner
// that decides view by view has to beat.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

struct CameraModel;
class OccupancyGrid;

/// uniform_hemisphere: directions spread evenly over the upper half space, each view where a line
/// from the structure's centre comes out of its surroundings. lawnmower: rows back and forth on
/// four sides and above. Both look at what they pass from the same distance.
constexpr std::array<std::string_view, 2> kRouteNames = {"uniform_hemisphere", "lawnmower"};
bool is_route(std::string_view utility_name);

/// Routes by someone who knows the true structure (bench/limits/oracle.hpp): fewest views, fewest
/// metres. The planner only knows their names; the mission is given their views.
constexpr std::array<std::string_view, 2> kOracleNames = {"oracle_views", "oracle_metres"};
bool is_oracle(std::string_view utility_name);

/// The user's own views: RouteConfig::views, and what comes through the pipe.
constexpr std::string_view kGivenRouteName = "route";
bool is_given_route(std::string_view utility_name);
constexpr std::size_t kMostGivenViews = 100000;

/// Whether no candidate is ever scored: the views are laid out, known or given.
bool asks_no_utility(std::string_view utility_name);

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

/// The views in the order in which they are to be flown; empty where nothing is occupied. A gimbal
/// looks at what the view does: on a hemisphere at its centre, of a lawnmower level from the sides
/// and down from above.
/// Requires is_route(name). Throws BadInput when a lawnmower would need more than kMostLaidViews.
std::vector<ViewPose> plan_route(std::string_view name, const RouteConfig& config,
                                 const RouteProblem& problem);

}  // namespace gnbv
