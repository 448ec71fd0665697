
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/compare/statistics.hpp"
#include "sim/core/error.hpp"
#include "tools/figures/run_figures.hpp"

namespace gnbv {
namespace {

constexpr double kLeastError_m = 1e-5;  // what is less lies on the axis's end

/// Distance to the nearest point of the way from the view before to that view.
double distance_to_leg_m(const Vec3& p_world_m, std::span<const ViewRecord> views,
                         std::size_t view) {
  Vec3 from_m = views[view - 1].decision.view.p_world_m;
  double least_m = (p_world_m - from_m).norm();
  std::vector<Vec3> stops_m = views[view].decision.via_world_m;
  stops_m.push_back(views[view].decision.view.p_world_m);
  for (const Vec3& to_m : stops_m) {
    least_m = std::min(least_m, distance_to_segment_m(p_world_m, from_m, to_m));
    from_m = to_m;
  }
  return least_m;
}

/// The samples between the first view and the last. Pitch is positive nose down, as the body frame
/// FLU turns.
struct Flown {
  using Values = std::vector<double>;
  Values times_s, errors_m, tilts_deg, speeds_m_s, rolls_deg, pitches_deg, yaws_deg;
  std::array<Values, 3> positions_m;
};

Flown flown_between_views(const RunRecord& record) {
  Flown flown;
  std::size_t view = 1;
  for (std::size_t i = 0; i < record.path.size() && record.views.size() > 1; ++i) {
    const TrajectorySample& sample = record.path[i];
    if (sample.time_s < record.views.front().time_s) continue;
    while (view < record.views.size() && record.views[view].time_s < sample.time_s) ++view;
    if (view == record.views.size()) break;
    const Vec3 p_m = sample.T_world_body.translation();
    const TrajectorySample& before = record.path[i == 0 ? 0 : i - 1];
    const double step_s = sample.time_s - before.time_s;
    const double step_m = (p_m - before.T_world_body.translation()).norm();
    flown.times_s.push_back(sample.time_s);
    flown.errors_m.push_back(distance_to_leg_m(p_m, record.views, view));
    flown.speeds_m_s.push_back(step_s > 0.0 ? step_m / step_s : 0.0);
    const Eigen::Matrix3d R = sample.T_world_body.linear();
    const auto clamped = [](double x) { return std::clamp(x, -1.0, 1.0); };
    flown.tilts_deg.push_back(rad_to_deg(std::acos(clamped(R(2, 2)))));
    flown.rolls_deg.push_back(rad_to_deg(std::atan2(R(2, 1), R(2, 2))));
    flown.pitches_deg.push_back(rad_to_deg(std::asin(clamped(-R(2, 0)))));
    flown.yaws_deg.push_back(rad_to_deg(std::atan2(R(1, 0), R(0, 0))));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      flown.positions_m.at(axis).push_back(p_m[static_cast<Eigen::Index>(axis)]);
    }
  }
  return flown;
}

/// Lowest and highest of what is drawn.
std::array<double, 2> range_of(std::span<const Series> all) {
  std::array<double, 2> range{std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity()};
  for (const Series& series : all) {
    for (const auto* const values : {&series.y, &series.low, &series.high}) {
      for (const double value : *values) {
        range = {std::min(range[0], value), std::max(range[1], value)};
      }
    }
  }
  return range;
}

/// A panel whose axis holds those series and zero, with few ticks: panels are low.
FigurePanel low_panel(std::string heading, std::vector<Series> series,
                      std::span<const double> times_s) {
  const auto [low, high] = range_of(series);
  const double room_s = times_s.front() == times_s.back() ? 0.5 : 0.0;
  return {.heading = std::move(heading),
          .x = axis_from("mission time (s)", times_s.front() - room_s, times_s.back() + room_s),
          .y = axis_around("", std::min(low, 0.0), std::max(high, 0.0), 3),
          .series = std::move(series),
          .height_px = 180};
}

/// Where each of 240 even steps of time begins among many samples, and their end; nothing of few,
/// which are drawn as they are.
std::vector<std::size_t> steps_of(std::span<const double> times_s) {
  constexpr double kSteps = 240.0;  // some 4 pixels of a column of a paper each
  const double step_s = (times_s.back() - times_s.front()) / kSteps;
  std::vector<std::size_t> begins;
  if (static_cast<double>(times_s.size()) <= 2.0 * kSteps || !(step_s > 0.0)) return begins;
  double last = -1.0;
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    const double step = std::min(kSteps - 1.0, std::floor((times_s[i] - times_s[0]) / step_s));
    if (step > last) begins.push_back(i);
    last = step;
  }
  begins.push_back(times_s.size());
  return begins;
}

/// What line and band are, where samples are drawn as those of steps.
void note_steps(std::span<const double> times_s, std::string_view band, Figure& figure) {
  const std::size_t steps = steps_of(times_s).size();
  if (steps == 0) return;
  const double step_s = (times_s.back() - times_s.front()) / static_cast<double>(steps - 1);
  figure.notes.push_back(fmt::format("line: mean of each {:.2g} s; band: {}", step_s, band));
}

/// Else the way from view to view is no straight line, and stands in no file.
bool flies_legs(const RunRecord& record) {
  return record.scenario.guidance.trajectory == Trajectory::legs;
}

/// How far off its legs the vehicle was, beside the safety margin.
FigurePanel error_panel(const RunRecord& record, const Flown& flown) {
  std::vector<double> errors_m = flown.errors_m;
  for (double& error_m : errors_m) error_m = std::max(error_m, kLeastError_m);
  const double margin_m = record.scenario.planner.validity.collision_radius_m -
                          record.scenario.vehicle.airframe.hull_radius_m;
  std::vector<Series> errors;
  if (margin_m > kLeastError_m) {
    errors.push_back({.name = "safety margin",
                      .label = fmt::format("safety margin, {:.2f} m", margin_m),
                      .mark = Mark::level,
                      .look = {.colour = std::string(kPalette[1]), .dashes = {4.0, 3.0}},
                      .y = {margin_m}});
  }
  Series error = trace("tracking error", flown.times_s, errors_m, 0, 0.05, 0.95);
  if (!error.low.empty()) {
    Series most = trace("largest error", flown.times_s, errors_m, 0);
    most.y = std::move(most.high);
    most.high.clear();
    most.low.clear();
    most.width_pt = 0.4;
    errors.push_back(std::move(most));
  }
  errors.push_back(std::move(error));
  const auto [least_m, most_m] = range_of(errors);
  FigurePanel panel = low_panel("tracking error (distance from the planned leg, m)",
                                std::move(errors), flown.times_s);
  panel.y = log_axis("", least_m, std::max(most_m, 1.001 * least_m));
  return panel;
}

}  // namespace

Series trace(std::string name, const std::vector<double>& times_s,
             const std::vector<double>& values, std::size_t colour, double from, double to) {
  Series series{.name = std::move(name), .look = {.colour = std::string(kPalette.at(colour))}};
  const std::vector<std::size_t> begins = steps_of(times_s);
  if (begins.empty()) {
    series.x = times_s;
    series.y = values;
  }
  for (std::size_t step = 0; step + 1 < begins.size(); ++step) {
    const auto of_step = [&](const std::vector<double>& all) {
      return std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(begins[step]),
                                 all.begin() + static_cast<std::ptrdiff_t>(begins[step + 1]));
    };
    std::vector<double> sorted = of_step(values);
    std::sort(sorted.begin(), sorted.end());
    const auto at = [&](double share) {
      const double place = share * static_cast<double>(sorted.size() - 1);
      return sorted[static_cast<std::size_t>(std::lround(place))];
    };
    series.x.push_back(mean_of(of_step(times_s)));
    series.y.push_back(mean_of(sorted));
    series.low.push_back(at(from));
    series.high.push_back(at(to));
  }
  return series;
}

Series yaw_series(std::span<const double> times_s, std::span<const double> yaws_deg) {
  constexpr double kBeyond_deg = 10.0;
  Series series{.name = "yaw", .look = {.colour = std::string(kPalette[0])}};
  double before_deg = 0.0;
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    // the turn that is nearest to what was drawn
    const double near_deg = yaws_deg[i] + 360.0 * std::round((before_deg - yaws_deg[i]) / 360.0);
    const bool is_near = std::abs(near_deg) <= 180.0 + kBeyond_deg;
    const double drawn_deg = is_near ? near_deg : yaws_deg[i];
    if (i > 0 && std::abs(drawn_deg - before_deg) > 180.0) {
      series.x.push_back(times_s[i]);
      series.y.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    series.x.push_back(times_s[i]);
    series.y.push_back(drawn_deg);
    before_deg = drawn_deg;
  }
  return series;
}

std::optional<Figure> flight_figure(const RunRecord& record) {
  const Flown flown = flown_between_views(record);
  if (flown.times_s.empty()) return std::nullopt;
  Figure figure{.name = "flight", .kind = "flight", .title = run_and_seed(record)};
  note_steps(flown.times_s, "least to most", figure);
  const auto add = [&](std::string heading, std::vector<Series> series) {
    figure.panels.push_back(low_panel(std::move(heading), std::move(series), flown.times_s));
  };
  std::vector<Series> positions;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name(1, static_cast<char>('x' + axis));
    positions.push_back(trace(name, flown.times_s, flown.positions_m.at(axis), axis));
    positions.back().label = name;
  }
  add("position (m)", std::move(positions));
  add("yaw (deg), each sample", {yaw_series(flown.times_s, flown.yaws_deg)});
  figure.panels.back().y = {.low = -200.0, .high = 200.0, .ticks = ticks_of(-180.0, 180.0, 180.0)};
  add("roll (deg)", {trace("roll", flown.times_s, flown.rolls_deg, 0)});
  add("pitch (deg)", {trace("pitch", flown.times_s, flown.pitches_deg, 0)});
  add("speed (m/s)", {trace("speed", flown.times_s, flown.speeds_m_s, 0)});
  if (flies_legs(record)) {
    add("distance from planned leg (m)", {trace("distance", flown.times_s, flown.errors_m, 0)});
  }
  return figure;
}

std::optional<Figure> tracking_figure(const RunRecord& record) {
  const Flown flown = flown_between_views(record);
  if (flown.times_s.empty()) return std::nullopt;
  const WindConfig& wind = record.scenario.wind;
  Figure figure{.name = "tracking", .kind = "tracking"};
  figure.title = fmt::format(
      "{}: wind {:.3g} m/s{}", run_and_seed(record), wind.mean_world_m_s.norm(),
      wind.gust_w20_m_s > 0.0 ? fmt::format(", gusts of {:.3g} m/s at 20 ft", wind.gust_w20_m_s)
                              : "");
  if (flies_legs(record)) {
    note_steps(flown.times_s, "5 to 95 %; thin: largest error", figure);
    figure.panels.push_back(error_panel(record, flown));
  } else {
    note_steps(flown.times_s, "5 to 95 %", figure);
    figure.notes.emplace_back(
        "the smooth way past the views stands in no file; path_error_m of summary.json says how "
        "far off it the vehicle was");
  }
  figure.panels.push_back(low_panel("tilt (angle of the body from upright, deg)",
                                    {trace("tilt", flown.times_s, flown.tilts_deg, 0, 0.05, 0.95)},
                                    flown.times_s));
  for (FigurePanel& panel : figure.panels) panel.height_px = 360;
  return figure;
}

}  // namespace gnbv
