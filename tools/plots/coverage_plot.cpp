#include "tools/plots/coverage_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/score/voxel_set.hpp"
#include "tools/plots/coverage_levels.hpp"
#include "tools/plots/gnuplot.hpp"
#include "tools/plots/script_parts.hpp"

namespace gnbv {
namespace {

constexpr int kEndPercent = 15;  // of the longest run, in the plots of its end

using Curve = std::vector<CoveragePoint>;

/// A group as it is drawn.
struct GroupCurves {
  std::string label;
  std::size_t slot = 0;
  Curve mean;
  std::vector<Curve> seeds = {};  // where they are too few for an interval
  bool has_band = false;
  CoveragePoint end;
  double longest = 0.0;           // effort of its longest run
  bool has_several_ends = false;  // its runs' differ by more than a hundredth
};

/// Several views from one place take no metres: of what begins there the last is drawn, no stub.
Curve without_stub(Curve curve) {
  const auto moves = std::find_if(curve.begin(), curve.end(), [&](const CoveragePoint& point) {
    return point.effort > curve.front().effort;
  });
  curve.erase(curve.begin(), moves - 1);
  return curve;
}

GroupCurves curves_of(const RunGroup& group, Effort effort, std::size_t size) {
  GroupCurves curves{.label = group.label,
                     .mean = without_stub(mean_coverage(group, effort, size)),
                     .has_band = group.runs.size() >= kLeastSeedsOfBand,
                     .end = mean_end(group, effort, size)};
  double shortest = whole_effort(group.runs.front()->figures->curve, effort);
  for (const RunRecord* const run : group.runs) {
    const double whole = whole_effort(run->figures->curve, effort);
    shortest = std::min(shortest, whole);
    curves.longest = std::max(curves.longest, whole);
    if (curves.has_band || group.runs.size() < 2) continue;
    const RunGroup alone{.label = "", .runs = {run}};
    curves.seeds.push_back(without_stub(mean_coverage(alone, effort, size)));
  }
  curves.has_several_ends = curves.longest - shortest > 0.01 * curves.end.effort;
  return curves;
}

/// Half of the band's height, in percent; none without a band.
double half_percent(const GroupCurves& curves, const CoveragePoint& point) {
  return curves.has_band ? 100.0 * point.coverage.half_width.value_or(0.0) : 0.0;
}

/// Percent: effort, mean, low and high of the band; of each of few seeds effort and coverage.
std::string group_data(const GroupCurves& curves, std::size_t index) {
  std::vector<std::vector<double>> rows;
  for (const CoveragePoint& point : curves.mean) {
    const double half = half_percent(curves, point);
    const double mean = 100.0 * point.coverage.mean;
    rows.push_back({point.effort, mean, mean - half, mean + half});
  }
  std::string text = data_block(fmt::format("group{}", index), rows);
  for (std::size_t k = 0; k < curves.seeds.size(); ++k) {
    rows.clear();
    for (const CoveragePoint& point : curves.seeds[k]) {
      rows.push_back({point.effort, 100.0 * point.coverage.mean});
    }
    text += data_block(fmt::format("group{}seed{}", index, k), rows);
  }
  return text + data_block(fmt::format("end{}", index),
                           {{curves.end.effort, 100.0 * curves.end.coverage.mean}});
}

/// The part of the plane that a plot shows.
struct Window {
  Effort effort = Effort::views;
  double from = 0.0;  // of that effort
  double to = 0.0;
  Axis percent = {};

  bool shows(double level) const { return percent.low <= level && level <= percent.high; }
};

/// The lowest and the highest of what is drawn from that effort on; low > high where nothing is.
std::pair<double, double> range_of(std::span<const GroupCurves> all, double from) {
  std::pair<double, double> range{100.0, 0.0};
  const auto take = [&](double percent) {
    range = {std::min(range.first, percent), std::max(range.second, percent)};
  };
  const auto take_curve = [&](const GroupCurves& curves, const Curve& curve) {
    for (std::size_t i = 0; i < curve.size(); ++i) {
      // that before the window is where its line comes from
      if (i + 1 < curve.size() && curve[i + 1].effort < from) continue;
      take(100.0 * curve[i].coverage.mean - half_percent(curves, curve[i]));
      take(100.0 * curve[i].coverage.mean + half_percent(curves, curve[i]));
    }
  };
  for (const GroupCurves& curves : all) {
    if (curves.longest < from) continue;
    take_curve(curves, curves.mean);
    for (const Curve& seed : curves.seeds) take_curve(curves, seed);
    if (curves.end.effort >= from) take(100.0 * curves.end.coverage.mean);
  }
  return range;
}

/// From the tens below all that is shown, or from 0 where that is near, to 100 %, or to the tens
/// above it where that is far below.
Axis percent_axis(double low, double high) {
  constexpr double kFarBelow = 70.0;
  constexpr double kNearZero = 30.0;
  const double from = low < kNearZero ? 0.0 : std::min(10.0 * std::floor(low / 10.0), 90.0);
  const double to = high < kFarBelow ? 10.0 * std::floor(high / 10.0 + 1.0) : 100.0;
  const double step = even_step(to - from, 7);
  return {from, to, std::fmod(to - from, step) == 0.0 ? step : 10.0};
}

/// The entries of the plot command: curves above levels above bands, and what explains them.
struct Layers {
  std::string bands = {}, levels = {}, lines = {}, ends = {};
  std::vector<KeyEntry> key = {};

  std::string entries() const {
    const std::string all = bands + levels + lines + ends;
    return all.substr(0, all.size() - 2);
  }
};

void add_curves(Layers& layers, const GroupCurves& curves, std::size_t i) {
  const std::string_view colour = palette_colour(curves.slot);
  const std::string_view dashes = method_dashes(curves.slot);
  if (curves.has_band) {
    layers.bands += fmt::format(
        "$group{} using 1:3:4 with filledcurves fc rgb '{}' fs transparent solid 0.18 noborder, ",
        i, colour);
  }
  for (std::size_t k = 0; k < curves.seeds.size(); ++k) {
    layers.lines +=
        fmt::format("$group{}seed{} using 1:2 with lines lw 0.5 lc rgb '{}', ", i, k, colour);
  }
  layers.lines +=
      fmt::format("$group{} using 1:2 with lines lw 1.3 dt {} lc rgb '{}', ", i, dashes, colour);
  layers.ends += end_points(fmt::format("end{}", i), curves.slot);
  layers.key.push_back({.colour = colour,
                        .text = curves.label,
                        .line = 1.3,
                        .dashes = dashes,
                        .point = end_mark(curves.slot),
                        .has_band = curves.has_band});
}

/// What lies within the window: a key to a line that is not there would be a riddle.
Layers layers_of(std::span<const GroupCurves> all, std::span<const CoverageLevel> levels,
                 const Window& window) {
  Layers layers;
  bool has_seeds = false;
  bool has_several_ends = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].longest < window.from) continue;
    add_curves(layers, all[i], i);
    has_seeds = has_seeds || !all[i].seeds.empty();
    has_several_ends = has_several_ends || all[i].has_several_ends;
  }
  if (has_seeds) layers.key.push_back(key_of_seeds());
  if (has_several_ends) {
    layers.key.push_back({.colour = kPlotGrey, .text = "mean end of the seeds", .point = 7});
  }
  for (const CoverageLevel& level : levels) {
    if (!window.shows(level.percent)) continue;
    layers.levels += fmt::format("{} with lines lw {} dt {} lc rgb '{}', ", level.percent,
                                 level.key.line, level.key.dashes, level.key.colour);
    const bool is_said = std::any_of(layers.key.begin(), layers.key.end(), [&](const auto& entry) {
      return entry.text == level.key.text;
    });
    if (!is_said) layers.key.push_back(level.key);
  }
  return layers;
}

std::vector<GroupCurves> curves_of(std::span<const RunGroup> groups, Effort effort,
                                   std::size_t size) {
  const std::string title = common_scenario(groups);
  const std::vector<std::size_t> slots = method_slots(methods_of(groups));
  std::vector<GroupCurves> all;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    all.push_back(curves_of(groups[i], effort, size));
    all.back().label = seeds_label(label_below(title, groups[i].label), groups[i].runs.size());
    all.back().slot = slots[i];
  }
  return all;
}

double longest_of(std::span<const GroupCurves> all) {
  double longest = 0.0;
  for (const GroupCurves& curves : all) longest = std::max(longest, curves.longest);
  return longest;
}

Plot plot_of(std::span<const GroupCurves> all, std::span<const CoverageLevel> levels,
             const Window& window, std::string_view title, const std::string& x_label,
             const std::string& size_text) {
  std::string data;
  for (std::size_t i = 0; i < all.size(); ++i) data += group_data(all[i], i);
  const Layers layers = layers_of(all, levels, window);
  const std::string y_label = fmt::format("coverage at {} m (%){}", size_text,
                                          window.percent.low > 0.0 ? ", axis cut" : "");
  return {fmt::format("coverage-{}", effort_name(window.effort)),
          data + key_above(title, layers.key) + axis_settings(window.percent) +
              fmt::format("set xrange [{}:{}] noextend\nset rmargin 3\n", window.from, window.to) +
              x_tics(window.from, window.to, even_step(window.to - window.from)) +
              fmt::format("set xlabel {}\nset ylabel {} offset 0.6,0\nplot {}\n",
                          gnuplot_text(x_label), gnuplot_text(y_label), layers.entries()),
          height_with_key_px(title, layers.key.size())};
}

Plot whole_plot(std::span<const RunGroup> groups, Effort effort, std::size_t size,
                std::span<const CoverageLevel> levels, const std::string& size_text) {
  const std::vector<GroupCurves> all = curves_of(groups, effort, size);
  auto [low, high] = range_of(all, 0.0);
  for (const CoverageLevel& level : levels) {
    low = std::min(low, level.percent);
    high = std::max(high, level.percent);
  }
  const Window window{.effort = effort,
                      .from = 0.0,
                      .to = std::max(1.01 * longest_of(all), 1e-6),
                      .percent = percent_axis(low, high)};
  const std::string x_label =
      effort == Effort::views ? "views (0: the profile alone)" : std::string(effort_label(effort));
  return plot_of(all, levels, window, common_scenario(groups), x_label, size_text);
}

}  // namespace

Plot coverage_plot(std::span<const RunGroup> groups, Effort effort, std::size_t size) {
  return whole_plot(groups, effort, size, coverage_levels(groups, size),
                    size_name(kCoverageSizes_m[size]));
}

std::optional<Plot> coverage_end_plot(std::span<const RunGroup> groups, Effort effort,
                                      std::size_t size) {
  const std::vector<GroupCurves> all = curves_of(groups, effort, size);
  const double longest = longest_of(all);
  const double from = (1.0 - 0.01 * kEndPercent) * longest;
  auto [low, high] = range_of(all, from);
  if (!(longest > 0.0) || low > high) return std::nullopt;
  // within a percent a curve is flat: it is not to look steep
  low = std::min(low, high - 1.0);
  Plot plot = plot_of(
      all, coverage_levels(groups, size), {effort, from, 1.01 * longest, axis_around(low, high)},
      common_scenario(groups), end_label(effort, kEndPercent), size_name(kCoverageSizes_m[size]));
  plot.name += "-end";
  return plot;
}

Plot coverage_plot_at(std::span<const RunGroup> groups, Effort effort, double size_m) {
  return whole_plot(groups, effort, 0, {}, size_name(size_m));
}

}  // namespace gnbv
