// Which views may be flown to, and how (paper section 2.4 and 3, Fig. 7).
#pragma once

#include <optional>
#include <span>
#include <utility>

#include "planner/motion/path_search.hpp"

namespace gnbv {

/// Checks views from one place, one after another; those of one position share its checks.
class ViewChecker {
 public:
  /// Keeps references to all of them. `heed_stop` is called now and then, and may throw.
  ViewChecker(const ValidityConfig& config, const Box3& navigation_m, const NoFly& no_fly,
              const OccupancyGrid& grid, std::span<const ViewPose> recent, const ViewPose& current,
              std::function<void()> heed_stop = {})
      : config_(config),
        space_{grid, navigation_m, no_fly, config.collision_radius_m, config.allow_unknown},
        recent_(recent),
        current_(current),
        heed_stop_(std::move(heed_stop)) {}

  /// Whether the view may be flown to, and the way there.
  FoundPath check(const ViewPose& view);
  /// What forbids the view whatever way leads to it.
  std::optional<Rejection> rejection_there(const ViewPose& view) const;
  /// Length of a way from here.
  double length_m(const FoundPath& path, const ViewPose& view) const {
    return path_length_m(current_.p_world_m, path.via_world_m, view.p_world_m);
  }

 private:
  FoundPath path_to(const Vec3& p_world_m) const;

  const ValidityConfig& config_;
  const FreeSpace space_;
  std::span<const ViewPose> recent_;
  const ViewPose& current_;
  const std::function<void()> heed_stop_;
  std::optional<Vec3> checked_m_;  // the position at hand, and what was found there
  FoundPath at_position_;
};

}  // namespace gnbv
