#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "bench/compare/comparison.hpp"

namespace gnbv {

std::optional<double> RunMetric::value(const MissionRow& mission) const {
  const auto figure = mission.find(key);
  return figure ? std::optional(factor * *figure) : std::nullopt;
}

std::vector<RunMetric> metrics_of(std::span<const MissionRow> missions) {
  constexpr bool kLess = false;
  constexpr bool kTold = false;
  std::vector<RunMetric> metrics = {
      {std::string(kCoverageMetric), "within_coverage_0.05", 100.0},
      {"coverage at 0.10 m (%)", "within_coverage_0.10", 100.0},
      {"coverage at 0.50 m (%)", "within_coverage_0.50", 100.0},
      {"accurate coverage at 0.05 m (%)", "within_accurate_coverage_0.05", 100.0},
      {"share of ceiling at 0.05 m (%)", "within_share_of_ceiling", 100.0},
      {"mean coverage over views (%)", "mean_coverage_views", 100.0},
      {"mean coverage over metres (%)", "mean_coverage_metres", 100.0},
      {"mean coverage over seconds (%)", "mean_coverage_seconds", 100.0},
      {"F at 0.05 m (%)", "f_0.05", 100.0, true, 1, true, {}, true},
      {"Chamfer distance (mm)", "chamfer_m", 1000.0, kLess, 2, true, {}, true},
      {"density (points/voxel)", "density_points_per_voxel", 1.0, true, 1, kTold},
      {"entropy reduction (nat)", "entropy_reduction", 1.0, true, 0, kTold},
      {"views", "within_iterations", 1.0, kLess, 1, kTold},
      {std::string(kDistanceMetric), "within_distance_m", 1.0, kLess, 1, kTold},
      {"flight time (s)", "flight_time_s", 1.0, kLess, 1, kTold},
  };
  for (const std::string_view share : kReachNames) {
    const auto add = [&](std::string_view unit, Effort effort, std::string_view from) {
      metrics.push_back({fmt::format("{} to {} % of ceiling{}", unit, share.substr(2), from),
                         figure_to_reach(effort, share), 1.0, kLess, 1, true,
                         fmt::format("budget_{}", name_of(effort))});
    };
    add("views", Effort::views, "");
    add("metres", Effort::metres, "");
    add("metres", Effort::metres_with_profile, ", from take-off");
    add("seconds", Effort::seconds_with_profile, ", from take-off");
    add("Wh", Effort::wh_with_profile, ", from take-off");
    metrics.push_back({fmt::format("to {} % of ceiling on one battery (%)", share.substr(2)),
                       fmt::format("{}{}", kOneBatteryTo, share), 100.0});
  }
  std::vector<std::string> sizes;
  for (const MissionRow& mission : missions) {
    for (const auto& [size, figure] : with_prefix(mission.figures, "within_coverage_")) {
      const bool is_papers = size == "0.05" || size == "0.10" || size == "0.50";
      if (!is_papers && std::ranges::count(sizes, size) == 0) sizes.push_back(size);
    }
  }
  std::ranges::sort(sizes, {},
                    [](const std::string& s) { return std::strtod(s.c_str(), nullptr); });
  for (const std::string& size : sizes) {
    metrics.push_back(
        {fmt::format("coverage at {} m (%)", size), "within_coverage_" + size, 100.0});
  }
  return metrics;
}

}  // namespace gnbv
