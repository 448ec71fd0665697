// Open tours of a vehicle that passes its views: what they can be expected to bring, with what the
// frames between them see, against the seconds that they take.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "planner/tour/orienteering.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

struct TravelConfig;

/// The views of an orienteering problem, whose way is counted in seconds, with their poses.
struct TimedProblem {
  const OrienteeringProblem* views = nullptr;
  std::span<const ViewPose> poses;  // of the views
  ViewPose start;
  const TravelConfig* travel = nullptr;
  /// The view that a frame at a pose on the way stands for; nothing where none does. Empty: there
  /// are no frames on the way.
  std::function<std::optional<std::uint32_t>(const ViewPose&)> view_at = {};
};

/// The tour with the greatest worth that a search met (tour_search.hpp), begun with `from` in its
/// order. The views in the order of the tour.
std::vector<std::uint32_t> solve(const TimedProblem& problem, std::span<const std::uint32_t> from,
                                 int iterations, std::uint64_t seed);

}  // namespace gnbv
