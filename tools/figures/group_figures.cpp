#include "tools/figures/group_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/score/run_figures.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/figures/coverage_levels.hpp"

namespace gnbv {
namespace {

constexpr int kPanel_px = 790;
constexpr double kBeyond = 1.01;  // of the longest run, so that its end shows

std::vector<DrawnGroup> coverage_groups(std::span<const RunGroup> groups, Effort effort,
                                        double size_m) {
  const std::string title = common_scenario(groups);
  std::vector<DrawnGroup> drawn;
  for (const RunGroup& group : groups) {
    std::vector<StepCurve> curves;
    for (const RunRecord* const run : group.runs) {
      std::optional<StepCurve> steps = coverage_steps(*run->figures, effort, size_m);
      GNBV_CHECK(steps, "{} was not scored at {} m", run->folder.string(), size_m);
      curves.push_back(std::move(*steps));
    }
    drawn.emplace_back(label_below(title, group.label), group.look, std::move(curves));
  }
  return drawn;
}

double longest_of(std::span<const DrawnGroup> groups) {
  double longest = 0.0;
  for (const DrawnGroup& group : groups) longest = std::max(longest, group.mean.longest_x);
  return longest;
}

/// The lowest and the highest of what is drawn from that effort on; low > high where nothing is.
std::array<double, 2> range_from(std::span<const Series> series, double from) {
  std::array<double, 2> range{100.0, 0.0};
  const auto take = [&](double y) { range = {std::min(range[0], y), std::max(range[1], y)}; };
  for (const Series& one : series) {
    for (std::size_t i = 0; i < one.x.size(); ++i) {
      if (i + 1 < one.x.size() && one.x[i + 1] <= from) continue;  // that before it stays into it
      take(one.low.empty() ? one.y[i] : one.low[i]);
      take(one.high.empty() ? one.y[i] : one.high[i]);
    }
    if (one.end && (*one.end)[0] >= from) take((*one.end)[1]);
  }
  return range;
}

/// From the tens below all that is shown, or from 0 where that is near, to 100 %, or to the tens
/// above it where that is far below.
Axis percent_axis(const std::string& label, double low, double high) {
  constexpr double kFarBelow = 70.0;
  constexpr double kNearZero = 30.0;
  const double from = low < kNearZero ? 0.0 : std::min(10.0 * std::floor(low / 10.0), 90.0);
  const double to = high < kFarBelow ? 10.0 * std::floor(high / 10.0 + 1.0) : 100.0;
  const double step = even_step(to - from, 7);
  const bool is_whole = std::fmod(to - from, step) == 0.0;
  return {
      .label = label, .low = from, .high = to, .ticks = ticks_of(from, to, is_whole ? step : 10.0)};
}

/// An axis that does not begin at 0 says so.
void say_where_cut(Axis& y) {
  if (y.low > 0.0) y.label += ", axis cut";
}

std::string percent_label(double size_m) {
  return fmt::format("coverage at {} m (%)", size_name(size_m));
}

std::string_view effort_name(Effort effort) {
  return effort == Effort::views ? "views" : effort == Effort::metres ? "metres" : "seconds";
}

std::string effort_label(Effort effort) {
  return effort == Effort::views    ? "views"
         : effort == Effort::metres ? "path since the first view, straight legs (m)"
                                    : "time since the first view (s)";
}

std::string end_label(Effort effort, int percent) {
  const std::string_view of = effort == Effort::views    ? "views"
                              : effort == Effort::metres ? "the path, straight legs (m)"
                                                         : "the time since the first view (s)";
  return fmt::format("last {} % of {}", percent, of);
}

std::string_view effort_unit(Effort effort) {
  return effort == Effort::views ? "views" : effort == Effort::metres ? "m" : "s";
}

/// A group's runs whose ceiling is known: how many, and what those that got there had spent.
struct Arrivals {
  std::size_t runs = 0;
  std::vector<double> efforts = {};  // ascending
};

Arrivals arrivals_of(const RunGroup& group, Effort effort, double share) {
  Arrivals arrivals;
  for (const RunRecord* const run : group.runs) {
    const RunFigures& figures = *run->figures;
    if (!figures.ceiling) continue;
    ++arrivals.runs;
    const auto spent = effort_to_reach(figures.curve, figures.before, share * *figures.ceiling);
    if (!spent) continue;
    const StepCurve steps = *coverage_steps(figures, effort, kCoverageSizes_m[0]);
    arrivals.efforts.push_back(steps.x[static_cast<std::size_t>(spent->views)]);
  }
  std::sort(arrivals.efforts.begin(), arrivals.efforts.end());
  return arrivals;
}

/// From nobody at no effort, a step for each arrival, to the end of the axis.
Series steps_of(const Arrivals& arrivals, double longest) {
  Series series{
      .name = "", .mark = Mark::steps, .width_pt = kGroupWidth_pt, .x = {0.0}, .y = {0.0}};
  for (std::size_t i = 0; i < arrivals.efforts.size(); ++i) {
    series.x.push_back(arrivals.efforts[i]);
    series.y.push_back(100.0 * static_cast<double>(i + 1) / static_cast<double>(arrivals.runs));
  }
  series.x.push_back(longest);
  series.y.push_back(series.y.back());
  return series;
}

}  // namespace

Figure coverage_figure(std::span<const RunGroup> groups, Effort effort, double size_m) {
  const std::vector<DrawnGroup> drawn = coverage_groups(groups, effort, size_m);
  Figure figure{.name = fmt::format("coverage-{}", effort_name(effort)),
                .kind = "coverage",
                .title = common_scenario(groups)};
  FigurePanel panel{.series = coverage_levels(groups, size_m), .height_px = kPanel_px};
  const std::size_t levels = panel.series.size();
  add_groups(drawn, Mark::steps, panel, figure.notes);
  auto [low, high] = range_from(std::span(panel.series).subspan(levels), 0.0);
  for (std::size_t i = 0; i < levels; ++i) {
    low = std::min(low, panel.series[i].y[0]);
    high = std::max(high, panel.series[i].y[0]);
  }
  panel.x =
      axis_from(effort == Effort::views ? "views (0: the profile alone)" : effort_label(effort),
                0.0, std::max(kBeyond * longest_of(drawn), 1e-6));
  panel.y = percent_axis(percent_label(size_m), low, high);
  say_where_cut(panel.y);
  figure.panels.push_back(std::move(panel));
  return figure;
}

std::optional<Figure> coverage_end_figure(std::span<const RunGroup> groups, Effort effort,
                                          double size_m) {
  constexpr int kEndPercent = 15;  // of the longest run
  std::vector<DrawnGroup> drawn = coverage_groups(groups, effort, size_m);
  const double longest = longest_of(drawn);
  if (!(longest > 0.0)) return std::nullopt;
  const double from = (1.0 - 0.01 * kEndPercent) * longest;
  Figure figure{.name = fmt::format("coverage-{}-end", effort_name(effort)),
                .kind = "coverage",
                .title = common_scenario(groups)};
  std::vector<std::string> ended;
  std::erase_if(drawn, [&](const DrawnGroup& group) {
    if (group.mean.longest_x >= from) return false;
    ended.push_back(fmt::format("{} ended before: {:.1f} % at {} {}", group.label, group.mean.end_y,
                                grouped(group.mean.end_x, 0), effort_unit(effort)));
    return true;
  });
  FigurePanel panel{.height_px = kPanel_px};
  add_groups(drawn, Mark::steps, panel, figure.notes);
  figure.notes.insert(figure.notes.end(), ended.begin(), ended.end());
  const auto [low, high] = range_from(panel.series, from);
  panel.x = axis_from(end_label(effort, kEndPercent), from, kBeyond * longest);
  // within a percent a curve is flat: it is not to look steep
  panel.y = axis_around(percent_label(size_m), std::min(low, high - 1.0), high);
  say_where_cut(panel.y);
  std::vector<Series> levels = coverage_levels(groups, size_m);
  // a key to a line that is not there would be a riddle
  std::erase_if(levels, [&](const Series& level) {
    return level.y[0] < panel.y.low || level.y[0] > panel.y.high;
  });
  panel.series.insert(panel.series.begin(), levels.begin(), levels.end());
  figure.panels.push_back(std::move(panel));
  return figure;
}

std::optional<Figure> reach_figure(std::span<const RunGroup> groups, Effort effort, double share) {
  const std::string title = common_scenario(groups);
  double longest = 1e-6;
  for (const RunGroup& group : groups) {
    for (const RunRecord* const run : group.runs) {
      const StepCurve steps = *coverage_steps(*run->figures, effort, kCoverageSizes_m[0]);
      longest = std::max(longest, steps.x.back());
    }
  }
  FigurePanel panel{.height_px = kPanel_px};
  for (const RunGroup& group : groups) {
    const Arrivals arrivals = arrivals_of(group, effort, share);
    if (arrivals.runs == 0) continue;
    Series series = steps_of(arrivals, longest);
    series.name = label_below(title, group.label);
    series.label =
        fmt::format("{} ({} of {})", series.name, arrivals.efforts.size(), arrivals.runs);
    series.look = group.look;
    panel.series.push_back(std::move(series));
  }
  if (panel.series.empty()) return std::nullopt;
  panel.x = axis_from(effort_label(effort), 0.0, longest);
  panel.y = {.label = fmt::format("runs at {:.0f} % of the ceiling (%)", 100.0 * share),
             .low = 0.0,
             .high = 103.0,
             .ticks = ticks_of(0.0, 100.0, 20.0)};
  return Figure{.name = fmt::format("reach-{}", effort_name(effort)),
                .kind = "reach",
                .title = title,
                .panels = {std::move(panel)}};
}

std::optional<DrawnGroup> density_group(std::string label, SeriesLook look,
                                        std::vector<std::vector<double>> missions) {
  std::vector<StepCurve> curves;
  for (std::vector<double>& mission : missions) {
    if (!mission.empty()) curves.push_back(steps_over_views(std::move(mission)));
  }
  if (curves.empty()) return std::nullopt;
  return DrawnGroup(std::move(label), std::move(look), std::move(curves));
}

Figure mean_density_figure(std::span<const DrawnGroup> groups, std::string_view title) {
  Figure figure{.name = "density", .kind = "density", .title = std::string(title)};
  FigurePanel panel{.height_px = kPanel_px};
  add_groups(groups, Mark::line, panel, figure.notes);
  double highest = 0.0;
  for (const Series& series : panel.series) {
    highest = std::max(highest, *std::max_element(series.y.begin(), series.y.end()));
  }
  panel.x = axis_from("views", 0.0, kBeyond * longest_of(groups));
  panel.y = axis_around("density (points/voxel)", 0.0, 1.15 * highest);
  figure.panels.push_back(std::move(panel));
  return figure;
}

std::optional<Figure> density_figure(std::span<const RunGroup> groups) {
  const std::string title = common_scenario(groups);
  std::vector<DrawnGroup> drawn;
  for (const RunGroup& group : groups) {
    std::vector<std::vector<double>> missions;
    for (const RunRecord* const run : group.runs) {
      missions.emplace_back();
      for (const ViewRecord& view : run->views) {
        missions.back().push_back(view.density_points_per_voxel);
      }
    }
    auto densities = density_group(label_below(title, group.label), group.look, missions);
    if (densities) drawn.push_back(std::move(*densities));
  }
  if (drawn.empty()) return std::nullopt;
  return mean_density_figure(drawn, title);
}

}  // namespace gnbv
