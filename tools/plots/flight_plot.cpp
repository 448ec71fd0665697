#include "tools/plots/flight_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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
  return axis_settings(close_axis(std::min(low, 0.0), std::max(high, 0.0)));
}

}  // namespace

std::string yaw_block(std::span<const std::array<double, 2>> time_yaw) {
  constexpr double kBeyond_deg = 10.0;
  std::string text = "$yaw << EOD\n";
  double before_deg = 0.0;
  for (const auto& [time_s, yaw_deg] : time_yaw) {
    // the turn that is nearest to what was drawn
    const double near_deg = yaw_deg + 360.0 * std::round((before_deg - yaw_deg) / 360.0);
    const bool is_near = std::abs(near_deg) <= 180.0 + kBeyond_deg;
    const double drawn_deg = is_near ? near_deg : yaw_deg;
    const bool is_jump =
        &time_yaw.front()[0] != &time_s && std::abs(drawn_deg - before_deg) > 180.0;
    text += fmt::format("{}{} {}\n", is_jump ? "\n" : "", time_s, drawn_deg);
    before_deg = drawn_deg;
  }
  return text + "EOD\n";
}

std::optional<Plot> flight_plot(const RunRecord& record) {
  if (record.views.size() < 2) return std::nullopt;
  const std::vector<std::vector<double>> rows = flight_rows(record);
  if (rows.empty()) return std::nullopt;
  const Traces traces(rows);
  std::vector<std::array<double, 2>> time_yaw;
  for (const auto& row : rows) time_yaw.push_back({row[0], row[6]});
  Panels panels(6, run_and_seed(record), "mission time (s)", {rows.front()[0], rows.back()[0]},
                traces.key());
  const auto panel = [&](std::string_view heading, std::size_t first, std::size_t last,
                         const std::vector<KeyEntry>& key = {}) {
    return panels.next(heading, key) + axis_of(traces, first, last) + "plot " +
           traces.drawn(first, last) + "\n";
  };
  std::string text = traces.data() + yaw_block(time_yaw);
  text += panel("position (m)", 1, 3,
                {{.colour = kPalette[0], .text = "x"},
                 {.colour = kPalette[1], .text = "y"},
                 {.colour = kPalette[2], .text = "z"}});
  text += panels.next("yaw (deg), each sample") +
          fmt::format(
              "set yrange [-200:200]\nset ytics 180\nset format y '% .0f'\n"
              "plot $yaw using 1:2 with lines lw 1.0 lc rgb '{}'\n",
              kPalette[0]);
  text += panel("roll (deg)", 4, 4);
  text += panel("pitch (deg)", 5, 5);
  text += panel("speed (m/s)", 7, 7);
  text += panel("distance from planned leg (m)", 8, 8);
  return Plot{"flight", text + "unset multiplot\n", panels.height_px()};
}

}  // namespace gnbv
