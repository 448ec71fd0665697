// Which candidate views may be flown to (paper section 2.4 and 3, Fig. 7).
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "planner/map/occupancy_grid.hpp"

namespace gnbv {

/// Defaults: section 3.1.1, and the released configuration where the paper is silent.
struct ValidityConfig {
  double collision_radius_m = 1.5;
  double z_min_m = 0.7;  // floor of the navigation box
  int recent_poses = 50;
  double recent_distance_m = 0.05;
  double recent_yaw_rad = 0.1;
};

enum class Rejection { out_of_bounds, not_free, collision, path_blocked, recently_visited };
std::string_view name_of(Rejection reason);

/// The workspace, with its floor raised to z_min_m.
Box3 navigation_box_m(const ValidityConfig& config, const Box3& workspace_m);

/// Whether a sphere at the point touches no occupied voxel (a cube).
bool is_sphere_clear(const OccupancyGrid& grid, const Vec3& p_world_m, double radius_m);

/// Whether a sphere swept along the straight path touches no occupied voxel. A voxel that it
/// touches at the start already, because it was only seen from there, may be left but not
/// approached.
bool is_path_clear(const OccupancyGrid& grid, const Vec3& from_world_m, const Vec3& to_world_m,
                   double radius_m);

/// Why the view may not be flown to from `current`; nothing when it may.
std::optional<Rejection> rejection(const ValidityConfig& config, const Box3& navigation_m,
                                   const OccupancyGrid& grid, std::span<const ViewPose> recent,
                                   const ViewPose& current, const ViewPose& candidate);

}  // namespace gnbv
