#include "tools/figures/flight_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "bench/compare/statistics.hpp"
#include "sim/core/error.hpp"
#include "tools/figures/run_figures.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kSteps = 240;     // some 4 pixels of a column of a paper each
constexpr double kLeastError_m = 1e-5;  // what is less lies on the axis's end

/// Roll, pitch (nose down positive, as the body frame FLU turns) and yaw in degrees.
std::array<double, 3> attitude_deg(const Isometry& T_world_body) {
  const Eigen::Matrix3d R = T_world_body.linear();
  return {rad_to_deg(std::atan2(R(2, 1), R(2, 2))),
          rad_to_deg(std::asin(std::clamp(-R(2, 0), -1.0, 1.0))),
          rad_to_deg(std::atan2(R(1, 0), R(0, 0)))};
}

double tilt_deg(const Isometry& T_world_body) {
  return rad_to_deg(std::acos(std::clamp(T_world_body.linear()(2, 2), -1.0, 1.0)));
}

/// Distance to the nearest point of the way from the view before to that view.
double distance_to_leg_m(const Vec3& p_world_m, std::span<const ViewRecord> views,
                         std::size_t view) {
  const Decision& decision = views[view].decision;
  Vec3 from_m = views[view - 1].decision.view.p_world_m;
  double least_m = (p_world_m - from_m).norm();
  const auto take = [&](const Vec3& to_m) {
    least_m = std::min(least_m, distance_to_segment_m(p_world_m, from_m, to_m));
    from_m = to_m;
  };
  for (const Vec3& via_m : decision.via_world_m) take(via_m);
  take(decision.view.p_world_m);
  return least_m;
}

/// The samples between the first view and the last.
struct Flown {
  std::vector<double> times_s, errors_m, tilts_deg, speeds_m_s;
  std::array<std::vector<double>, 3> positions_m, attitudes_deg;
};

Flown flown_between_views(const RunRecord& record) {
  Flown flown;
  if (record.views.size() < 2) return flown;
  std::size_t view = 1;
  for (std::size_t i = 0; i < record.path.size(); ++i) {
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
    flown.tilts_deg.push_back(tilt_deg(sample.T_world_body));
    flown.speeds_m_s.push_back(step_s > 0.0 ? step_m / step_s : 0.0);
    const std::array<double, 3> attitude = attitude_deg(sample.T_world_body);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      flown.positions_m.at(axis).push_back(p_m[static_cast<Eigen::Index>(axis)]);
      flown.attitudes_deg.at(axis).push_back(attitude.at(axis));
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

Axis time_axis(const std::vector<double>& times_s) {
  const double room_s = times_s.front() == times_s.back() ? 0.5 : 0.0;
  return axis_from("mission time (s)", times_s.front() - room_s, times_s.back() + room_s);
}

/// A panel whose axis holds those series and zero, with few marks: panels are low.
FigurePanel low_panel(std::string heading, std::vector<Series> series, const Axis& x) {
  const auto [low, high] = range_of(series);
  return {.heading = std::move(heading),
          .x = x,
          .y = close_axis("", std::min(low, 0.0), std::max(high, 0.0)),
          .series = std::move(series),
          .height_px = 180};
}

std::string tracking_title(const RunRecord& record) {
  const WindConfig& wind = record.scenario.wind;
  const double gust_m_s = wind.gust_w20_m_s;
  return fmt::format("{}: wind {:.3g} m/s{}", run_and_seed(record), wind.mean_world_m_s.norm(),
                     gust_m_s > 0.0 ? fmt::format(", gusts of {:.3g} m/s at 20 ft", gust_m_s) : "");
}

}  // namespace

Traces::Traces(std::vector<double> times_s, double share)
    : times_s_(std::move(times_s)), share_(share) {
  GNBV_CHECK(!times_s_.empty() && share > 0.0 && share <= 1.0, "{} samples, {} of them",
             times_s_.size(), share);
  const double begin_s = times_s_.front();
  step_s_ = (times_s_.back() - begin_s) / static_cast<double>(kSteps);
  if (times_s_.size() <= 2 * kSteps || !(step_s_ > 0.0)) return;
  std::size_t last = kSteps;  // none yet
  for (std::size_t i = 0; i < times_s_.size(); ++i) {
    const std::size_t step =
        std::min(kSteps - 1, static_cast<std::size_t>((times_s_[i] - begin_s) / step_s_));
    if (step == last) continue;
    last = step;
    begins_.push_back(i);
    middles_s_.push_back(begin_s + (static_cast<double>(step) + 0.5) * step_s_);
  }
  begins_.push_back(times_s_.size());
}

std::vector<double> Traces::of_step(const std::vector<double>& values, std::size_t step) const {
  std::vector<double> of_step(values.begin() + static_cast<std::ptrdiff_t>(begins_[step]),
                              values.begin() + static_cast<std::ptrdiff_t>(begins_[step + 1]));
  std::sort(of_step.begin(), of_step.end());
  return of_step;
}

Series Traces::series(std::string name, const std::vector<double>& values,
                      std::size_t colour) const {
  Series series{.name = std::move(name), .look = {.colour = std::string(kPalette.at(colour))}};
  if (begins_.empty()) {
    series.x = times_s_;
    series.y = values;
    return series;
  }
  series.x = middles_s_;
  for (std::size_t step = 0; step < middles_s_.size(); ++step) {
    const std::vector<double> sorted = of_step(values, step);
    const double last = static_cast<double>(sorted.size() - 1);
    const auto at = [&](double share) {
      return sorted[static_cast<std::size_t>(std::lround(share * last))];
    };
    series.y.push_back(mean_of(sorted));
    series.low.push_back(at(0.5 - 0.5 * share_));
    series.high.push_back(at(0.5 + 0.5 * share_));
  }
  return series;
}

std::optional<Series> Traces::most(std::string name, const std::vector<double>& values,
                                   std::size_t colour) const {
  if (begins_.empty()) return std::nullopt;
  Series series{.name = std::move(name),
                .look = {.colour = std::string(kPalette.at(colour))},
                .width_pt = 0.4,
                .x = middles_s_};
  for (std::size_t step = 0; step < middles_s_.size(); ++step) {
    series.y.push_back(of_step(values, step).back());
  }
  return series;
}

std::string Traces::note() const {
  if (begins_.empty()) return "";
  const int beyond = static_cast<int>(std::lround(50.0 * (1.0 - share_)));
  return fmt::format(
      "line: mean of each {:.2g} s; band: {}", step_s_,
      beyond == 0 ? "least to most" : fmt::format("{} to {} %", beyond, 100 - beyond));
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
  const Traces traces(flown.times_s);
  const Axis x = time_axis(flown.times_s);
  std::vector<Series> positions;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name(1, static_cast<char>('x' + axis));
    positions.push_back(traces.series(name, flown.positions_m.at(axis), axis));
    positions.back().label = name;
  }
  FigurePanel yaw{.heading = "yaw (deg), each sample",
                  .x = x,
                  .y = {.low = -200.0, .high = 200.0, .ticks = ticks_of(-180.0, 180.0, 180.0)},
                  .series = {yaw_series(flown.times_s, flown.attitudes_deg[2])},
                  .height_px = 180};
  const auto panel = [&](std::string heading, std::string name, const std::vector<double>& values) {
    return low_panel(std::move(heading), {traces.series(std::move(name), values, 0)}, x);
  };
  Figure figure{.name = "flight", .kind = "flight", .title = run_and_seed(record)};
  if (!traces.note().empty()) figure.notes.push_back(traces.note());
  figure.panels = {low_panel("position (m)", std::move(positions), x),
                   std::move(yaw),
                   panel("roll (deg)", "roll", flown.attitudes_deg[0]),
                   panel("pitch (deg)", "pitch", flown.attitudes_deg[1]),
                   panel("speed (m/s)", "speed", flown.speeds_m_s),
                   panel("distance from planned leg (m)", "distance", flown.errors_m)};
  return figure;
}

std::optional<Figure> tracking_figure(const RunRecord& record) {
  Flown flown = flown_between_views(record);
  if (flown.times_s.empty()) return std::nullopt;
  for (double& error_m : flown.errors_m) error_m = std::max(error_m, kLeastError_m);
  const double margin_m = record.scenario.planner.validity.collision_radius_m -
                          record.scenario.vehicle.airframe.hull_radius_m;
  const Traces traces(flown.times_s, 0.9);
  const Axis x = time_axis(flown.times_s);
  FigurePanel error{.heading = "tracking error (distance from the planned leg, m)", .x = x};
  if (margin_m > kLeastError_m) {
    error.series.push_back({.name = "safety margin",
                            .label = fmt::format("safety margin, {:.2f} m", margin_m),
                            .mark = Mark::level,
                            .look = {.colour = std::string(kPalette[1]), .dashes = {4.0, 3.0}},
                            .y = {margin_m}});
  }
  Figure figure{.name = "tracking", .kind = "tracking", .title = tracking_title(record)};
  if (!traces.note().empty()) figure.notes.push_back(traces.note() + "; thin: largest error");
  if (auto most = traces.most("largest error", flown.errors_m, 0)) {
    error.series.push_back(std::move(*most));
  }
  error.series.push_back(traces.series("tracking error", flown.errors_m, 0));
  const auto [least_m, most_m] = range_of(error.series);
  error.y = log_axis("", least_m, std::max(most_m, 1.001 * least_m));
  FigurePanel tilt{.heading = "tilt (angle of the body from upright, deg)", .x = x};
  tilt.series = {traces.series("tilt", flown.tilts_deg, 0)};
  tilt.y = axis_around("", 0.0, range_of(tilt.series)[1]);
  error.height_px = tilt.height_px = 360;
  figure.panels = {std::move(error), std::move(tilt)};
  return figure;
}

}  // namespace gnbv
