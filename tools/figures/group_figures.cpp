#include "tools/figures/group_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/score/run_figures.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

constexpr double kBeyond = 1.01;  // of the longest run, so that its end shows

struct EffortWords {
  const char* label;
  const char* end;  // the last 15 % of what
  const char* unit;
};

constexpr std::array<EffortWords, kEfforts.size()> kEffortWords = {
    {{"views", "views", "views"},
     {"path since the first view, straight legs (m)", "the path, straight legs (m)", "m"},
     {"time since the first view (s)", "the time since the first view (s)", "s"},
     {"path from take-off, straight legs (m)", "the path from take-off (m)", "m"},
     {"time from take-off (s)", "the time from take-off (s)", "s"},
     {"energy from take-off (Wh)", "the energy from take-off (Wh)", "Wh"}}};

const EffortWords& words_of(Effort effort) {
  return kEffortWords.at(static_cast<std::size_t>(effort));
}

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
    if (one.mark == Mark::level) take(one.y[0]);
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
Axis percent_axis(double low, double high) {
  constexpr double kFarBelow = 70.0;
  constexpr double kNearZero = 30.0;
  Axis axis;
  axis.low = low < kNearZero ? 0.0 : std::min(10.0 * std::floor(low / 10.0), 90.0);
  axis.high = high < kFarBelow ? 10.0 * std::floor(high / 10.0 + 1.0) : 100.0;
  const double step = even_step(axis.high - axis.low, 7);
  const bool is_whole = std::fmod(axis.high - axis.low, step) == 0.0;
  axis.ticks = ticks_of(axis.low, axis.high, is_whole ? step : 10.0);
  return axis;
}

/// With its label; an axis that does not begin at 0 says so, as does one that no group's surface
/// from outside is on.
Axis coverage_axis(Axis axis, double size_m, std::span<const RunGroup> groups) {
  const bool of_samples = std::ranges::all_of(
      groups, [](const RunGroup& group) { return group.runs.front()->figures->area_samples > 0; });
  axis.label = fmt::format("coverage{} at {} m (%){}", of_samples ? " of area samples" : "",
                           size_name(size_m), axis.low > 0.0 ? ", axis cut" : "");
  return axis;
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
    const auto reached = entry_that_covers(figures.curve, share * *figures.ceiling);
    if (!reached) continue;
    arrivals.efforts.push_back(coverage_steps(figures, effort, kCoverageSizes_m[0])->x[*reached]);
  }
  std::sort(arrivals.efforts.begin(), arrivals.efforts.end());
  return arrivals;
}

}  // namespace

Figure coverage_figure(std::span<const RunGroup> groups, Effort effort, double size_m) {
  const EffortWords& words = words_of(effort);
  const std::vector<DrawnGroup> drawn = coverage_groups(groups, effort, size_m);
  Figure figure{.name = fmt::format("coverage-{}", name_of(effort)),
                .kind = "coverage",
                .title = common_scenario(groups)};
  FigurePanel panel{.series = coverage_levels(groups, size_m), .height_px = kTallPanel_px};
  add_groups(drawn, Mark::steps, panel, figure.notes);
  const auto [low, high] = range_from(panel.series, 0.0);
  panel.x = axis_from(effort == Effort::views ? "views (0: before the first)" : words.label, 0.0,
                      std::max(kBeyond * longest_of(drawn), 1e-6));
  panel.y = coverage_axis(percent_axis(low, high), size_m, groups);
  figure.panels = {std::move(panel)};
  return figure;
}

std::optional<Figure> coverage_end_figure(std::span<const RunGroup> groups, Effort effort,
                                          double size_m) {
  constexpr int kEndPercent = 15;  // of the longest run
  const EffortWords& words = words_of(effort);
  std::vector<DrawnGroup> drawn = coverage_groups(groups, effort, size_m);
  const double longest = longest_of(drawn);
  if (!(longest > 0.0)) return std::nullopt;
  const double from = (1.0 - 0.01 * kEndPercent) * longest;
  Figure figure{.name = fmt::format("coverage-{}-end", name_of(effort)),
                .kind = "coverage",
                .title = common_scenario(groups)};
  std::vector<std::string> ended;
  std::erase_if(drawn, [&](const DrawnGroup& group) {
    if (group.mean.longest_x >= from) return false;
    ended.push_back(fmt::format("{} ended before: {:.1f} % at {} {}", group.label, group.mean.end_y,
                                grouped(group.mean.end_x, 0), words.unit));
    return true;
  });
  FigurePanel panel{.height_px = kTallPanel_px};
  add_groups(drawn, Mark::steps, panel, figure.notes);
  figure.notes.insert(figure.notes.end(), ended.begin(), ended.end());
  const auto [low, high] = range_from(panel.series, from);
  panel.x =
      axis_from(fmt::format("last {} % of {}", kEndPercent, words.end), from, kBeyond * longest);
  // within a percent a curve is flat: it is not to look steep
  panel.y = coverage_axis(axis_around("", std::min(low, high - 1.0), high), size_m, groups);
  std::vector<Series> levels = coverage_levels(groups, size_m);
  // a key to a line that is not there would be a riddle
  std::erase_if(levels, [&](const Series& level) {
    return level.y[0] < panel.y.low || level.y[0] > panel.y.high;
  });
  panel.series.insert(panel.series.begin(), levels.begin(), levels.end());
  figure.panels = {std::move(panel)};
  return figure;
}

std::optional<Figure> reach_figure(std::span<const RunGroup> groups, Effort effort, double share) {
  const std::string title = common_scenario(groups);
  const double longest =
      std::max(1e-6, longest_of(coverage_groups(groups, effort, kCoverageSizes_m[0])));
  FigurePanel panel{.height_px = kTallPanel_px};
  for (const RunGroup& group : groups) {
    const auto [runs, efforts] = arrivals_of(group, effort, share);
    if (runs == 0) continue;
    const std::string name = label_below(title, group.label);
    // from nobody at no effort, a step for each arrival, to the end of the axis
    Series series{.name = name,
                  .label = fmt::format("{} ({} of {})", name, efforts.size(), runs),
                  .mark = Mark::steps,
                  .look = group.look,
                  .width_pt = kGroupWidth_pt,
                  .x = {0.0},
                  .y = {0.0}};
    for (const double spent : efforts) {
      series.x.push_back(spent);
      const auto there = static_cast<double>(series.y.size());
      series.y.push_back(100.0 * there / static_cast<double>(runs));
    }
    series.x.push_back(longest);
    series.y.push_back(series.y.back());
    panel.series.push_back(std::move(series));
  }
  if (panel.series.empty()) return std::nullopt;
  panel.x = axis_from(words_of(effort).label, 0.0, longest);
  panel.y = {.label = fmt::format("runs at {:.0f} % of the ceiling (%)", 100.0 * share),
             .low = 0.0,
             .high = 103.0,
             .ticks = ticks_of(0.0, 100.0, 20.0)};
  return Figure{.name = fmt::format("reach-{}", name_of(effort)),
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
  FigurePanel panel{.height_px = kTallPanel_px};
  add_groups(groups, Mark::line, panel, figure.notes);
  double highest = 0.0;
  for (const Series& series : panel.series) {
    highest = std::max(highest, *std::max_element(series.y.begin(), series.y.end()));
  }
  panel.x = axis_from("views", 0.0, kBeyond * longest_of(groups));
  panel.y = axis_around("density (points/voxel)", 0.0, 1.15 * highest);
  figure.panels = {std::move(panel)};
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
