// Why a view may not be flown to.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace gnbv {

enum class Rejection {
  out_of_bounds,
  not_free,
  collision,
  path_blocked,
  recently_visited,
  cluster_outside_fov,  // FVS: the centroid of the cluster is in no camera's frustum
  cluster_hidden,       // FVS: no voxel of the cluster is visible
  sees_no_surface,      // refused by the utility
  no_fly,               // in or too near to a box where nobody may fly
  beyond_gimbal,        // a given view: no gimbal reaches its pitch
  search_limit          // the search for a way around ended at its limit and found none
};

constexpr std::array<std::string_view, 11> kRejectionNames = {
    "out_of_bounds",       "not_free",       "collision",       "path_blocked", "recently_visited",
    "cluster_outside_fov", "cluster_hidden", "sees_no_surface", "no_fly",       "beyond_gimbal",
    "search_limit"};

constexpr std::string_view name_of(Rejection reason) {
  return kRejectionNames[static_cast<std::size_t>(reason)];
}

}  // namespace gnbv
