#include "tools/plots/coverage_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "bench/compare/paper_figures.hpp"
#include "bench/score/voxel_set.hpp"
#include "scenarios/papers_setting.hpp"
#include "tools/plots/gnuplot.hpp"
#include "tools/plots/script_parts.hpp"

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
  return data_block(fmt::format("group{}", index), rows);
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

constexpr int kHeight_px = 1050;  // of the picture, whose width is 1512
constexpr int kKeyLine_px = 60;

/// Whether the lower right corner is free of curves: there a key of so many lines would stand, as
/// wide as its longest one, of so many characters.
bool is_corner_free(std::span<const RunGroup> groups, Effort effort, std::size_t size,
                    std::size_t entries, std::size_t characters) {
  const double height = static_cast<double>((entries + 1) * kKeyLine_px) / (0.8 * kHeight_px);
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
  std::string bands = {}, levels = {}, lines = {}, keys = {};
  std::size_t entries = 0;
  std::size_t characters = 0;  // of the longest entry
};

void add_key(Layers& layers, std::string_view style, std::string_view text) {
  layers.keys += fmt::format("keyentry with {} title {}, ", style, gnuplot_text(text));
  layers.characters = std::max(layers.characters, text.size());
  ++layers.entries;
}

Layers layers_of(std::span<const RunGroup> groups, std::optional<std::size_t> papers_size) {
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
    layers.characters = std::max(layers.characters, label_of(groups[i]).size());
    layers.lines +=
        fmt::format("$group{} using 1:2 with lines lw 1.3 dt {} lc rgb '{}' title {}, ", i,
                    1 + i / kPalette.size(), colour, gnuplot_text(label_of(groups[i])));
    if (!papers_size) continue;
    if (const auto level = paper_level(groups[i], *papers_size)) {
      layers.levels += fmt::format("{} with lines lw 0.9 dt (6,5) lc rgb '{}' notitle, ",
                                   level->percent, colour);
      has_doubtful = has_doubtful || level->is_doubtful;
    }
  }
  if (!layers.bands.empty()) {
    add_key(layers, "boxes fs solid noborder fc rgb '#d5d9de'", "95 % interval of the mean");
  }
  if (!layers.levels.empty()) {
    add_key(layers, "lines lw 0.9 dt (6,5) lc rgb '#5c6470'",
            has_doubtful ? "paper, at the end (doubtful)" : "paper, at the end");
  }
  return layers;
}

/// `size` is an index of the curves' sizes; the paper has it when it is `papers_size`, too.
Plot plot_of(std::span<const RunGroup> groups, Effort effort, std::size_t size,
             std::optional<std::size_t> papers_size, const std::string& size_text) {
  std::string data;
  for (std::size_t i = 0; i < groups.size(); ++i) data += group_data(groups[i], i, effort, size);
  const Layers layers = layers_of(groups, papers_size);
  std::string entries = layers.bands + layers.levels + layers.lines + layers.keys;
  entries.resize(entries.size() - 2);
  const bool is_inside = is_corner_free(groups, effort, size, layers.entries, layers.characters);
  const int key_px = is_inside ? 0 : kKeyLine_px * static_cast<int>(layers.entries);
  const int height_px = kHeight_px + key_px;
  const std::string key = is_inside
                              ? std::string("set key inside bottom right vertical\n")
                              : fmt::format(
                                    "set key at screen 0.1,0.99 left top vertical maxcols 1\n"
                                    "set tmargin at screen {:.4f}\n",
                                    1.0 - static_cast<double>(key_px + kKeyLine_px) / height_px);
  const std::string y_label = fmt::format("coverage at {} m (%)", size_text);
  return {fmt::format("coverage-{}", effort_name(effort)),
          data + key + "set yrange [0:100]\nset xrange [0:*] noextend\nset rmargin 3\n" +
              fmt::format("set xtics {:g}\n",
                          even_step(std::max(longest_effort(groups, effort), 1e-6))) +
              fmt::format("set xlabel {}\nset ylabel {} offset 0.6,0\nplot {}\n",
                          gnuplot_text(effort_label(effort)), gnuplot_text(y_label), entries),
          height_px};
}

}  // namespace

Plot coverage_plot(std::span<const RunGroup> groups, Effort effort, std::size_t size) {
  return plot_of(groups, effort, size, size, size_name(kCoverageSizes_m[size]));
}

Plot coverage_plot_at(std::span<const RunGroup> groups, Effort effort, double size_m) {
  return plot_of(groups, effort, 0, std::nullopt, size_name(size_m));
}

}  // namespace gnbv
