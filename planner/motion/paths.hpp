// Which views may be flown to, and by which way (paper section 2.4 and 3, Fig. 7).
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "planner/motion/free_space.hpp"

namespace gnbv {

/// A way, or why there is none.
struct FoundPath {
  std::optional<Rejection> rejected = {};  // nothing: there is a way
  std::vector<Vec3> via_world_m = {};      // points between its ends; none: straight
};

/// A* on a lattice through `from` with a step of the radius (at least a voxel), 26 neighbours a
/// node, over legs that may be flown (FreeSpace::is_leg_free) inside the navigation box; then
/// straightened greedily. path_blocked where all was searched, search_limit where the search ended
/// before. Deterministic: of equal nodes the one found first is looked at first.
FoundPath find_path(const PathSearchConfig& config, const FreeSpace& space,
                    const Vec3& from_world_m, const Vec3& to_world_m, const HeedStop& stop = {});

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

/// Checks views from one place, one after another; those of one position share its checks.
class ViewChecker {
 public:
  /// Keeps references to all but `stop`.
  ViewChecker(const ValidityConfig& config, const Box3& navigation_m, const NoFly& no_fly,
              const OccupancyGrid& grid, std::span<const ViewPose> recent, const ViewPose& current,
              HeedStop stop = {})
      : config_(config),
        space_{grid,
               navigation_m,
               no_fly,
               config.collision_radius_m,
               config.allow_unknown,
               leg_radius_m(config)},
        recent_(recent),
        current_(current),
        stop_(std::move(stop)) {}

  /// Whether the view may be flown to, and the way there.
  FoundPath check(const ViewPose& view);
  /// What forbids the view whatever way leads to it.
  std::optional<Rejection> rejection_there(const ViewPose& view) const;
  /// Length of a way from here.
  double length_m(const FoundPath& path, const ViewPose& view) const {
    return path_length_m(current_.p_world_m, path.via_world_m, view.p_world_m);
  }

 private:
  bool is_recent(const ViewPose& view) const;
  FoundPath path_to(const Vec3& p_world_m) const;

  const ValidityConfig& config_;
  const FreeSpace space_;
  std::span<const ViewPose> recent_;
  const ViewPose& current_;
  const HeedStop stop_;
  std::optional<Vec3> checked_m_;  // the position at hand, and what was found there
  FoundPath at_position_;
};

}  // namespace gnbv
