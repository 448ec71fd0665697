#include "tools/plots/coverage_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "bench/paper_figures.hpp"
#include "bench/voxel_set.hpp"
#include "tools/plots/gnuplot.hpp"
#include "tools/plots/script_parts.hpp"

namespace gnbv {
namespace {

std::string_view x_label(Effort effort) {
  switch (effort) {
    case Effort::views:
      return "views";
    case Effort::metres:
      return "path between views (m)";
    case Effort::seconds:
      return "time after the profile (s)";
  }
  return "";
}

std::string_view name_of(Effort effort) {
  return effort == Effort::views ? "views" : effort == Effort::metres ? "metres" : "seconds";
}

struct PaperLevel {
  double percent = 0.0;
  bool is_doubtful = false;
};

std::optional<PaperLevel> paper_level(const RunGroup& group, std::size_t size) {
  const RunFigures& figures = *group.runs.front()->figures;
  const PaperTable* const table = find_paper_table(figures.scenario);
  if (table == nullptr || !is_papers_structure(*table, figures.structure)) return std::nullopt;
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
  return data_block(fmt::format("group{}", index), rows);
}

std::string label_of(const RunGroup& group) {
  if (group.runs.size() == 1) return group.label;
  return fmt::format("{} ({} seeds)", group.label, group.runs.size());
}

/// Whether the lower right corner, where `entries` lines of a key would stand, is free of curves.
bool is_corner_free(std::span<const RunGroup> groups, Effort effort, std::size_t size,
                    std::size_t entries) {
  constexpr double kEntry = 0.07;   // of the plot's height
  constexpr double kCorner = 0.35;  // begins here, as a share of the plot's width
  double longest = 0.0;
  for (const RunGroup& group : groups) {
    for (const RunRecord* run : group.runs) {
      longest = std::max(longest, whole_effort(run->figures->curve, effort));
    }
  }
  return std::all_of(groups.begin(), groups.end(), [&](const RunGroup& group) {
    return std::all_of(group.runs.begin(), group.runs.end(), [&](const RunRecord* run) {
      return coverage_at(run->figures->curve, effort, size, kCorner * longest) >
             kEntry * static_cast<double>(entries + 1);
    });
  });
}

/// The entries of the plot command: curves above levels above bands, and what explains them.
struct Layers {
  std::string bands = {}, levels = {}, lines = {}, keys = {};
  std::size_t entries = 0;
};

Layers layers_of(std::span<const RunGroup> groups, std::size_t size) {
  Layers layers{.entries = groups.size()};
  bool has_doubtful = false;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::string_view colour = kPalette[i % kPalette.size()];
    if (groups[i].runs.size() > 1) {
      layers.bands += fmt::format(
          "$group{} using 1:3:4 with filledcurves fc rgb '{}' fs transparent solid 0.18 noborder "
          "notitle, ",
          i, colour);
    }
    layers.lines +=
        fmt::format("$group{} using 1:2 with lines lw 1.3 dt {} lc rgb '{}' title {}, ", i,
                    1 + i / kPalette.size(), colour, gnuplot_text(label_of(groups[i])));
    if (const auto level = paper_level(groups[i], size)) {
      layers.levels += fmt::format("{} with lines lw 0.9 dt (6,5) lc rgb '{}' notitle, ",
                                   level->percent, colour);
      has_doubtful = has_doubtful || level->is_doubtful;
    }
  }
  if (!layers.bands.empty()) {
    layers.keys += "keyentry with boxes fs solid noborder fc rgb '#d5d9de' title ";
    layers.keys += "'95 % interval of the mean', ";
    ++layers.entries;
  }
  if (!layers.levels.empty()) {
    layers.keys +=
        fmt::format("keyentry with lines lw 0.9 dt (6,5) lc rgb '#5c6470' title {}, ",
                    gnuplot_text(has_doubtful ? "paper, at the end (its column is doubtful)"
                                              : "paper, at the end"));
    ++layers.entries;
  }
  return layers;
}

}  // namespace

Plot coverage_plot(std::span<const RunGroup> groups, Effort effort, std::size_t size) {
  std::string data;
  for (std::size_t i = 0; i < groups.size(); ++i) data += group_data(groups[i], i, effort, size);
  const Layers layers = layers_of(groups, size);
  std::string entries = layers.bands + layers.levels + layers.lines + layers.keys;
  entries.resize(entries.size() - 2);
  const char* const key = is_corner_free(groups, effort, size, layers.entries)
                              ? "set key inside bottom right vertical\n"
                              : "set key outside top center vertical\n";
  const std::string y_label = fmt::format("coverage at {:.2f} m (%)", kCoverageSizes_m[size]);
  return {fmt::format("coverage-{}", name_of(effort)),
          data + key + "set yrange [0:100]\nset xrange [0:*] noextend\nset rmargin 3\n" +
              fmt::format("set xlabel {}\nset ylabel {} offset 0.6,0\nplot {}\n",
                          gnuplot_text(x_label(effort)), gnuplot_text(y_label), entries)};
}

}  // namespace gnbv
