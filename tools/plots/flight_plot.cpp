#include "tools/plots/flight_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/plots/script_parts.hpp"
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

/// An axis that holds those columns.
std::string axis_of(const std::vector<std::vector<double>>& rows, std::size_t first,
                    std::size_t last) {
  double low = 0.0;
  double high = 0.0;
  for (const auto& row : rows) {
    for (std::size_t c = first; c <= last; ++c) {
      low = std::min(low, row[c]);
      high = std::max(high, row[c]);
    }
  }
  return y_axis(low, high);
}

std::string lines_of(std::size_t first, std::size_t last) {
  std::string text = "plot ";
  for (std::size_t c = first; c <= last; ++c) {
    text += fmt::format("{}$samples using 1:{} with lines lw 1.0 lc rgb '{}'",
                        c == first ? "" : ", ", c + 1, kPalette[c - first]);
  }
  return text + "\n";
}

}  // namespace

std::optional<Plot> flight_plot(const RunRecord& record) {
  if (record.views.size() < 2) return std::nullopt;
  const std::vector<std::vector<double>> rows = flight_rows(record);
  if (rows.empty()) return std::nullopt;
  const std::string title = fmt::format("{}, seed {}", run_title(record), record.scenario.seed);
  Panels panels(4, title, "time since the mission began (s)");
  std::string text = data_block("samples", rows) +
                     fmt::format("set xrange [{}:{}]\n", rows.front()[0], rows.back()[0]);
  text +=
      panels.next("position (m)", {{kPalette[0], "x"}, {kPalette[1], "y"}, {kPalette[2], "z"}}) +
      axis_of(rows, 1, 3) + lines_of(1, 3);
  text += panels.next("attitude (deg)",
                      {{kPalette[0], "roll"}, {kPalette[1], "pitch"}, {kPalette[2], "yaw"}}) +
          axis_of(rows, 4, 6) + lines_of(4, 6);
  text += panels.next("speed (m/s)") + axis_of(rows, 7, 7) + lines_of(7, 7);
  text += panels.next("off the leg (m)") + axis_of(rows, 8, 8) + lines_of(8, 8);
  return Plot{"flight", text + "unset multiplot\n", panels_height_px(4)};
}

}  // namespace gnbv
