#include "tools/plots/tracking_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/plots/script_parts.hpp"
#include "tools/plots/traces.hpp"

namespace gnbv {
namespace {

constexpr double kLeast_m = 1e-5;  // what is less lies on the axis's end

double tilt_rad(const Isometry& T_world_body) {
  return std::acos(std::clamp(T_world_body.linear()(2, 2), -1.0, 1.0));
}

/// Time, distance from the leg (m) and tilt (deg) of every sample between first and last view.
std::vector<std::vector<double>> tracking_rows(const RunRecord& record) {
  std::vector<std::vector<double>> rows;
  std::size_t view = 1;
  for (const TrajectorySample& sample : record.path) {
    if (sample.time_s < record.views.front().time_s) continue;
    while (view < record.views.size() && record.views[view].time_s < sample.time_s) ++view;
    if (view == record.views.size()) break;
    const std::vector<Vec3> way_m = way_to_view(record.views, view);
    rows.push_back({sample.time_s, distance_to_way_m(sample.T_world_body.translation(), way_m),
                    rad_to_deg(tilt_rad(sample.T_world_body))});
  }
  return rows;
}

/// A logarithmic axis on whole powers of ten around both, each a mark: how far it strays and how
/// far it may differ by two of them.
std::string distance_axis(double least_m, double most_m) {
  const int from = static_cast<int>(std::floor(std::log10(least_m)));
  const int to = static_cast<int>(std::ceil(std::log10(most_m)));
  std::string tics;
  for (int power = from; power <= to; ++power) {
    tics += fmt::format("{}'{:.{}f}' 1e{}", power > from ? ", " : "", std::pow(10.0, power),
                        std::max(0, -power), power);
  }
  return fmt::format("set logscale y\nset yrange [1e{}:1e{}]\nset ytics ({})\n", from, to, tics);
}

std::string tracking_title(const RunRecord& record) {
  const WindConfig& wind = record.scenario.wind;
  const double gust_m_s = wind.gust_w20_m_s;
  return fmt::format("{}: wind {:.3g} m/s{}", run_and_seed(record), wind.mean_world_m_s.norm(),
                     gust_m_s > 0.0 ? fmt::format(", gusts of {:.3g} m/s at 20 ft", gust_m_s) : "");
}

}  // namespace

std::vector<Vec3> way_to_view(std::span<const ViewRecord> views, std::size_t view) {
  std::vector<Vec3> way_m = {views[view - 1].decision.view.p_world_m};
  const Decision& decision = views[view].decision;
  way_m.insert(way_m.end(), decision.via_world_m.begin(), decision.via_world_m.end());
  way_m.push_back(decision.view.p_world_m);
  return way_m;
}

double distance_to_way_m(const Vec3& p_world_m, std::span<const Vec3> way_world_m) {
  double least_m = (p_world_m - way_world_m.front()).norm();
  for (std::size_t i = 1; i < way_world_m.size(); ++i) {
    least_m =
        std::min(least_m, distance_to_segment_m(p_world_m, way_world_m[i - 1], way_world_m[i]));
  }
  return least_m;
}

std::optional<Plot> tracking_plot(const RunRecord& record) {
  if (record.views.size() < 2) return std::nullopt;
  const std::vector<std::vector<double>> rows = tracking_rows(record);
  if (rows.empty()) return std::nullopt;
  const double margin_m = record.scenario.planner.validity.collision_radius_m -
                          record.scenario.vehicle.airframe.hull_radius_m;
  std::vector<std::vector<double>> shown = rows;
  double most_m = margin_m;
  for (auto& row : shown) {
    row[1] = std::max(row[1], kLeast_m);
    most_m = std::max(most_m, row[1]);
  }
  const Traces traces(shown, 0.9);
  const bool has_margin = margin_m > kLeast_m;
  std::vector<KeyEntry> key = traces.key();
  if (!key.empty()) {
    key.push_back({.colour = kPalette[0], .text = "largest error", .line = 0.5});
  }
  if (has_margin) {
    key.push_back({.colour = kPalette[1],
                   .text = fmt::format("safety margin, {:.2f} m", margin_m),
                   .line = 1.0,
                   .dashes = "2"});
  }
  Panels panels(2, tracking_title(record), "mission time (s)", {rows.front()[0], rows.back()[0]},
                key);
  std::string text = traces.data() +
                     panels.next("tracking error (distance from the planned leg, m)") +
                     distance_axis(traces.range(1, 1).first, most_m) + "plot ";
  if (has_margin) {
    text += fmt::format("{:.3f} with lines lw 1.0 dt 2 lc rgb '{}', ", margin_m, kPalette[1]);
  }
  text += traces.drawn_most(1) + traces.drawn(1, 1) + "\nunset logscale y\n" +
          panels.next("tilt (angle of the body from upright, deg)") +
          y_axis(0.0, traces.range(2, 2).second) + "plot " + traces.drawn(2, 2) + "\n";
  return Plot{"tracking", text + "unset multiplot\n", panels.height_px()};
}

}  // namespace gnbv
