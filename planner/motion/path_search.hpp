// Ways around what blocks the straight leg.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "planner/motion/config.hpp"
#include "planner/motion/free_space.hpp"

namespace gnbv {

/// A way, or why there is none.
struct FoundPath {
  std::optional<Rejection> rejected = {};  // nothing: there is a way
  std::vector<Vec3> via_world_m = {};  // points between its ends; none: the straight leg will do
};

/// A* on a lattice through `from` with a step of the radius (at least a voxel), 26 neighbours a
/// node, over legs that may be flown (FreeSpace::is_leg_free) inside the navigation box; then
/// straightened greedily. path_blocked where no way is left to look at, search_limit where the
/// search ended before. Deterministic: of equal nodes the one found first is looked at first.
/// `heed_stop` is called for every node that is looked at, and may throw.
FoundPath find_path(const PathSearchConfig& config, const FreeSpace& space,
                    const Vec3& from_world_m, const Vec3& to_world_m,
                    const std::function<void()>& heed_stop = {});

/// Nodes that find_path() looks at before it gives up: max_expansions; in a navigation box of more
/// than 40,000 nodes as many times that as it has more.
int search_limit(const PathSearchConfig& config, const FreeSpace& space);

/// A shortest way by corners of the boxes grown by the margin, inside the navigation box (the
/// visibility graph of these): the points between the ends, none where the straight leg will do.
/// `is_clear` may forbid further legs. Nothing where there is no such way. Deterministic: of
/// equally short ways the one by the corner of the lower number.
std::optional<std::vector<Vec3>> way_around(
    const NoFly& no_fly, const Box3& navigation_m, const Vec3& from_world_m, const Vec3& to_world_m,
    const std::function<bool(const Vec3& from_m, const Vec3& to_m)>& is_clear = {});

/// Length of the way from one end by the points between them to the other.
double path_length_m(const Vec3& from_world_m, std::span<const Vec3> via_world_m,
                     const Vec3& to_world_m);

}  // namespace gnbv
