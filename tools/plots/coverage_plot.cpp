#include "tools/plots/coverage_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "bench/compare/paper_figures.hpp"
#include "bench/score/voxel_set.hpp"
#include "scenarios/papers_setting.hpp"
#include "tools/plots/gnuplot.hpp"
#include "tools/plots/script_parts.hpp"
#include "tools/run_files/words.hpp"

namespace gnbv {
namespace {

struct PaperLevel {
  double percent = 0.0;
  bool is_doubtful = false;
};

std::optional<PaperLevel> paper_level(const RunGroup& group, std::size_t size) {
  const RunFigures& figures = *group.runs.front()->figures;
  const PaperTable* const table = find_paper_table(figures.scenario);
  if (table == nullptr || !is_papers_structure(*table, figures.structure) ||
      !has_papers_setting(group.runs.front()->scenario)) {
    return std::nullopt;
  }
  const PaperRow* const row = find_row(*table, figures.utility);
  if (row == nullptr || !row->coverage_percent) return std::nullopt;
  return PaperLevel{(*row->coverage_percent)[size], is_doubtful(*row)};
}

/// Percent: effort, mean, low and high; the last two are the mean's own where there is no interval.
std::string group_data(const RunGroup& group, std::size_t index, Effort effort, std::size_t size) {
  std::vector<std::vector<double>> rows;
  for (const CoveragePoint& point : mean_coverage(group, effort, size)) {
    const double half = point.coverage.half_width.value_or(0.0);
    const double mean = point.coverage.mean;
    rows.push_back({point.effort, 100.0 * mean, 100.0 * (mean - half), 100.0 * (mean + half)});
  }
  const CoveragePoint end = mean_end(group, effort, size);
  return data_block(fmt::format("group{}", index), rows) +
         data_block(fmt::format("end{}", index), {{end.effort, 100.0 * end.coverage.mean}});
}

std::string label_of(const RunGroup& group) {
  if (group.runs.size() == 1) return group.label;
  return fmt::format("{} ({} seeds)", group.label, group.runs.size());
}

double longest_effort(std::span<const RunGroup> groups, Effort effort) {
  double longest = 0.0;
  for (const RunGroup& group : groups) {
    for (const RunRecord* run : group.runs) {
      longest = std::max(longest, whole_effort(run->figures->curve, effort));
    }
  }
  return longest;
}

/// Whether the lower right corner is free of curves: there a key of so many lines would stand, as
/// wide as its longest one, of so many characters.
bool is_corner_free(std::span<const RunGroup> groups, Effort effort, std::size_t size,
                    std::size_t entries, std::size_t characters) {
  const double height = static_cast<double>((entries + 1) * kKeyLine_px) / (0.8 * kOnePanel_px);
  const double left = 0.9 - 0.022 * static_cast<double>(characters);  // of the plot's width
  if (left < 0.0) return false;
  const double longest = longest_effort(groups, effort);
  return std::all_of(groups.begin(), groups.end(), [&](const RunGroup& group) {
    return std::all_of(group.runs.begin(), group.runs.end(), [&](const RunRecord* run) {
      return coverage_at(run->figures->curve, effort, size, left * longest) > height;
    });
  });
}

/// The entries of the plot command: curves above levels above bands, and what explains them.
struct Layers {
  std::string bands = {}, levels = {}, lines = {}, ends = {}, names = {}, keys = {};
  std::size_t entries = 0;
  std::size_t characters = 0;  // of the longest entry
};

void add_key(Layers& layers, std::string_view style, std::string_view text) {
  layers.keys += fmt::format("keyentry with {} title {}, ", style, gnuplot_text(text));
  layers.characters = std::max(layers.characters, text.size());
  ++layers.entries;
}

/// The mean of the ceilings that are known; the runs of other scenarios have others.
std::optional<double> ceiling_of(const RunGroup& group) {
  std::vector<double> known;
  for (const RunRecord* const run : group.runs) {
    if (run->figures->ceiling) known.push_back(100.0 * *run->figures->ceiling);
  }
  if (known.empty()) return std::nullopt;
  return estimate_mean(known).mean;
}

bool is_oracle_group(const RunGroup& group) {
  return group.runs.front()->figures->utility.starts_with("oracle");
}

void add_lines(Layers& layers, const RunGroup& group, std::size_t i, std::size_t slot) {
  const std::string_view colour = palette_colour(slot);
  if (group.runs.size() > 1) {
    layers.bands += fmt::format(
        "$group{} using 1:3:4 with filledcurves fc rgb '{}' fs transparent solid 0.18 noborder "
        "notitle, ",
        i, colour);
  }
  layers.characters = std::max(layers.characters, label_of(group).size());
  const std::string dashes =
      is_oracle_group(group) ? "(4,2)" : fmt::format("{}", 1 + slot / kPalette.size());
  layers.lines += fmt::format("$group{} using 1:2 with lines lw 1.3 dt {} lc rgb '{}' notitle, ", i,
                              dashes, colour);
  layers.ends += end_points(fmt::format("end{}", i), slot);
  layers.names +=
      fmt::format("keyentry with linespoints lw 1.3 dt {} pt {} ps 0.5 lc rgb '{}' title {}, ",
                  dashes, end_mark(slot), colour, gnuplot_text(label_of(group)));
}

constexpr Axis kAllPercent{0.0, 100.0, 20.0};

/// The part of the plane that a plot shows.
struct Window {
  Effort effort = Effort::views;
  double from = 0.0;  // of that effort
  Axis percent = kAllPercent;

  bool is_all() const { return percent.low == 0.0 && percent.high == 100.0; }
  bool shows(double level) const { return percent.low <= level && level <= percent.high; }
  bool shows(const RunGroup& group) const { return longest_effort({&group, 1}, effort) >= from; }
};

/// What lies within the window: a key to a line that is not there would be a riddle.
Layers layers_of(std::span<const RunGroup> groups, std::optional<std::size_t> papers_size,
                 const Window& window) {
  Layers layers;
  std::array<bool, 2> has_level = {false, false};  // trusted, doubtful
  std::set<std::size_t> level_slots;
  bool has_mean_end = false;
  std::vector<double> ceilings;
  const std::vector<std::size_t> slots = method_slots(methods_of(groups));
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (!window.shows(groups[i])) continue;
    add_lines(layers, groups[i], i, slots[i]);
    ++layers.entries;
    has_mean_end = has_mean_end || groups[i].runs.size() > 1;
    if (!papers_size) continue;
    const std::optional<double> ceiling = *papers_size == 0 ? ceiling_of(groups[i]) : std::nullopt;
    const auto is_same = [&](double other) { return std::abs(other - *ceiling) < 0.05; };
    if (ceiling && window.shows(*ceiling) &&
        std::none_of(ceilings.begin(), ceilings.end(), is_same)) {
      ceilings.push_back(*ceiling);
      layers.levels += fmt::format("{} with lines lw 0.9 lc rgb '#262c36' notitle, ", *ceiling);
    }
    if (const auto level = paper_level(groups[i], *papers_size);
        level && window.shows(level->percent)) {
      layers.levels +=
          fmt::format("{} with lines lw 0.9 dt {} lc rgb '{}' notitle, ", level->percent,
                      level->is_doubtful ? "(2,6)" : "(6,5)", palette_colour(slots[i]));
      level_slots.insert(slots[i]);
      has_level[level->is_doubtful ? 1 : 0] = true;
    }
  }
  if (!layers.bands.empty()) {
    add_key(layers, "boxes fs solid noborder fc rgb '#d5d9de'", "95 % interval of the mean");
  }
  if (has_mean_end)
    add_key(layers, "points pt 7 ps 0.5 lc rgb '#5c6470'", "mean length of the seeds");
  // each of its planner's colour
  const std::string_view of_paper =
      level_slots.size() == 1 ? palette_colour(*level_slots.begin()) : "#5c6470";
  if (has_level[0]) {
    add_key(layers, fmt::format("lines lw 0.9 dt (6,5) lc rgb '{}'", of_paper),
            "paper, at the end");
  }
  if (has_level[1]) {
    add_key(layers, fmt::format("lines lw 0.9 dt (2,6) lc rgb '{}'", of_paper),
            "paper, at the end (doubtful)");
  }
  if (!ceilings.empty()) add_key(layers, "lines lw 0.9 lc rgb '#262c36'", "ceiling");
  return layers;
}

/// `size` is an index of the curves' sizes; the paper has it when it is `papers_size`, too. The key
/// stands inside where there is room, on an axis of all percent.
Plot plot_of(std::span<const RunGroup> groups, const Window& window, std::size_t size,
             std::optional<std::size_t> papers_size, const std::string& size_text) {
  const Effort effort = window.effort;
  std::string data;
  for (std::size_t i = 0; i < groups.size(); ++i) data += group_data(groups[i], i, effort, size);
  const Layers layers = layers_of(groups, papers_size, window);
  std::string entries =
      layers.bands + layers.levels + layers.lines + layers.ends + layers.names + layers.keys;
  entries.resize(entries.size() - 2);
  const bool is_inside =
      window.is_all() && is_corner_free(groups, effort, size, layers.entries, layers.characters);
  const int height_px = is_inside ? kOnePanel_px : height_with_key_px(layers.entries);
  const std::string key =
      is_inside ? "set key inside bottom right vertical\n" : key_above(layers.entries);
  const std::string title = title_at_right(common_scenario(groups), height_px);
  const double longest = std::max(longest_effort(groups, effort), 1e-6);
  const std::string y_label = fmt::format("coverage at {} m (%)", size_text);
  return {fmt::format("coverage-{}", effort_name(effort)),
          data + key + title + "set yrange [0:100]\nset xrange [0:*] noextend\nset rmargin 3\n" +
              x_tics(0.0, longest, even_step(longest)) +
              fmt::format("set xlabel {}\nset ylabel {} offset 0.6,0\nplot {}\n",
                          gnuplot_text(effort_label(effort)), gnuplot_text(y_label), entries),
          height_px};
}

}  // namespace

Plot coverage_plot(std::span<const RunGroup> groups, Effort effort, std::size_t size) {
  return plot_of(groups, {.effort = effort}, size, size, size_name(kCoverageSizes_m[size]));
}

std::optional<Plot> coverage_end_plot(std::span<const RunGroup> groups, Effort effort,
                                      std::size_t size) {
  const double longest = longest_effort(groups, effort);
  const double from = 0.85 * longest;
  double low = 100.0;
  double high = 0.0;
  for (const RunGroup& group : groups) {
    if (longest_effort({&group, 1}, effort) < from) continue;
    const std::vector<CoveragePoint> points = mean_coverage(group, effort, size);
    for (std::size_t i = 0; i < points.size(); ++i) {
      // that before the window is where its line comes from
      if (i + 1 < points.size() && points[i + 1].effort < from) continue;
      const double half = points[i].coverage.half_width.value_or(0.0);
      low = std::min(low, 100.0 * (points[i].coverage.mean - half));
      high = std::max(high, 100.0 * (points[i].coverage.mean + half));
    }
    const CoveragePoint end = mean_end(group, effort, size);
    if (end.effort < from) continue;
    low = std::min(low, 100.0 * end.coverage.mean);
    high = std::max(high, 100.0 * end.coverage.mean);
  }
  if (!(longest > 0.0) || low > high) return std::nullopt;
  Plot plot = plot_of(groups, {effort, from, axis_around(low, high)}, size, size,
                      size_name(kCoverageSizes_m[size]));
  plot.name += "-end";
  // the last word on both axes, before anything is drawn
  const std::size_t at = plot.body.rfind("\nplot ") + 1;
  plot.body.insert(at, fmt::format("set xrange [{}:{}] noextend\n", from, 1.01 * longest) +
                           x_tics(from, 1.01 * longest, even_step(0.16 * longest)) +
                           y_axis(low, high));
  return plot;
}

Plot coverage_plot_at(std::span<const RunGroup> groups, Effort effort, double size_m) {
  return plot_of(groups, {.effort = effort}, 0, std::nullopt, size_name(size_m));
}

}  // namespace gnbv
