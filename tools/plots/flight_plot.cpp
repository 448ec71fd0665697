#include "tools/plots/flight_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/plots/script_parts.hpp"
#include "tools/plots/traces.hpp"
#include "tools/plots/tracking_plot.hpp"

namespace gnbv {
namespace {

/// Roll, pitch (nose down positive, as the body frame FLU turns) and yaw in degrees.
std::array<double, 3> attitude_deg(const Isometry& T_world_body) {
  const Eigen::Matrix3d R = T_world_body.linear();
  return {rad_to_deg(std::atan2(R(2, 1), R(2, 2))),
          rad_to_deg(std::asin(std::clamp(-R(2, 0), -1.0, 1.0))),
          rad_to_deg(std::atan2(R(1, 0), R(0, 0)))};
}

/// Time, x, y, z (m), roll, pitch, yaw (deg), speed (m/s) and distance from the leg (m) of every
/// sample between the first view and the last.
std::vector<std::vector<double>> flight_rows(const RunRecord& record) {
  std::vector<std::vector<double>> rows;
  std::size_t view = 1;
  for (std::size_t i = 1; i < record.path.size(); ++i) {
    const TrajectorySample& sample = record.path[i];
    if (sample.time_s < record.views.front().time_s) continue;
    while (view < record.views.size() && record.views[view].time_s < sample.time_s) ++view;
    if (view == record.views.size()) break;
    const Vec3 p_m = sample.T_world_body.translation();
    const double step_m = (p_m - record.path[i - 1].T_world_body.translation()).norm();
    const double step_s = sample.time_s - record.path[i - 1].time_s;
    const auto [roll, pitch, yaw] = attitude_deg(sample.T_world_body);
    rows.push_back({sample.time_s, p_m.x(), p_m.y(), p_m.z(), roll, pitch, yaw,
                    step_s > 0.0 ? step_m / step_s : 0.0,
                    distance_to_way_m(p_m, way_to_view(record.views, view))});
  }
  return rows;
}

/// An axis that holds those values and zero, with few marks: panels are low.
std::string axis_of(const Traces& traces, std::size_t first, std::size_t last) {
  const auto [low, high] = traces.range(first, last);
  return tight_y_axis(std::min(low, 0.0), std::max(high, 0.0), 3);
}

}  // namespace

std::optional<Plot> flight_plot(const RunRecord& record) {
  if (record.views.size() < 2) return std::nullopt;
  const std::vector<std::vector<double>> rows = flight_rows(record);
  if (rows.empty()) return std::nullopt;
  const Traces traces(rows);
  Panels panels(5, fmt::format("{}, seed {}", run_title(record), record.scenario.seed),
                traces.time_label(), {rows.front()[0], rows.back()[0]});
  const auto panel = [&](std::string_view heading, std::size_t first, std::size_t last,
                         const std::vector<KeyEntry>& key = {}) {
    return panels.next(heading, key) + axis_of(traces, first, last) + "plot " +
           traces.drawn(first, last) + "\n";
  };
  std::string text =
      traces.data() +
      panel("position (m)", 1, 3, {{kPalette[0], "x"}, {kPalette[1], "y"}, {kPalette[2], "z"}});
  // broken wherever yaw goes past 180 degrees: it would cross the panel there
  text +=
      panels.next("yaw (deg)") + fmt::format(
                                     "set yrange [-180:180]\nset ytics 90\nset format y '% .0f'\n"
                                     "yaw = 0\nplot $samples using 1:(step = $7 - yaw, yaw = $7, "
                                     "abs(step) > 180 ? NaN : yaw) with lines lw 1.0 lc rgb '{}'\n",
                                     kPalette[0]);
  text += panel("roll, pitch (deg)", 4, 5, {{kPalette[0], "roll"}, {kPalette[1], "pitch"}});
  text += panel("speed (m/s)", 7, 7);
  text += panel("off the leg (m)", 8, 8);
  return Plot{"flight", text + "unset multiplot\n", panels_height_px(5)};
}

}  // namespace gnbv
