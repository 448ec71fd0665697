#include "tools/plots/coverage_plot.hpp"

#include <fmt/format.h>

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

}  // namespace

std::string coverage_plot(std::span<const RunGroup> groups, Effort effort, std::size_t size) {
  std::string data, bands, lines, levels;
  bool has_doubtful = false;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::string_view colour = kPalette[i % kPalette.size()];
    const auto dashes = 1 + i / kPalette.size();
    data += group_data(groups[i], i, effort, size);
    if (groups[i].runs.size() > 1) {
      bands += fmt::format(
          "$group{} using 1:3:4 with filledcurves fc rgb '{}' fs transparent solid 0.18 noborder "
          "notitle, ",
          i, colour);
    }
    lines += fmt::format("$group{} using 1:2 with lines lw 1.5 dt {} lc rgb '{}' title {}, ", i,
                         dashes, colour, gnuplot_text(label_of(groups[i])));
    if (const auto level = paper_level(groups[i], size)) {
      levels += fmt::format("{} with lines lw 0.9 dt (6,5) lc rgb '{}' notitle, ", level->percent,
                            colour);
      has_doubtful = has_doubtful || level->is_doubtful;
    }
  }
  if (!levels.empty()) {
    levels += fmt::format(
        "keyentry with lines lw 0.9 dt (6,5) lc rgb '#5c6470' title {}, ",
        gnuplot_text(has_doubtful ? "paper, at the end (doubtful)" : "paper, at the end"));
  }
  if (!bands.empty()) {
    lines += "keyentry with boxes fs solid noborder fc rgb '#d5d9de' title '95 % of the mean', ";
  }
  std::string plot = bands + levels + lines;
  plot.resize(plot.size() - 2);
  return data + "set key outside top left horizontal Left reverse\nset yrange [0:100]\n" +
         fmt::format(
             "set xrange [0:*] noextend\nset xlabel {}\nset ylabel {} offset 0.6,0\n",
             gnuplot_text(x_label(effort)),
             gnuplot_text(fmt::format("coverage at {:.2f} m (%)", kCoverageSizes_m[size]))) +
         "plot " + plot + "\n";
}

}  // namespace gnbv
