#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/exports/export_folder.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/plots/coverage_plot.hpp"
#include "tools/plots/density_plot.hpp"
#include "tools/plots/flight_plot.hpp"
#include "tools/plots/gnuplot.hpp"
#include "tools/plots/predictions_plot.hpp"
#include "tools/plots/reach_plot.hpp"
#include "tools/plots/run_plots.hpp"
#include "tools/plots/script_parts.hpp"
#include "tools/plots/terms_plot.hpp"
#include "tools/plots/tracking_plot.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/run_names.hpp"
#include "tools/sweep/cell_files.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

const std::vector<std::pair<std::string, PlotFormat>> kFormats = {
    {"svg", PlotFormat::svg}, {"png", PlotFormat::png}, {"pdf", PlotFormat::pdf}};

struct PlotOptions {
  std::vector<fs::path> runs;
  fs::path out;
  std::vector<std::string> formats = {"svg"};
  std::vector<std::string> plots = {"density", "coverage", "terms", "reach"};
  bool are_plots_asked_for = false;  // or the default's
  int reach_percent = 95;
  double voxel_m = 0.05;
  PlotSize size;
  bool keep = false;
};

/// The runs in a folder of runs (a sweep's are in cells/), by name; the folder itself when it is a
/// run, or holds none.
std::vector<fs::path> runs_in(const fs::path& folder) {
  if (fs::exists(folder / kScenarioFile) || !fs::is_directory(folder)) return {folder};
  std::vector<fs::path> runs;
  const fs::path cells = folder / kCellsFolder;
  for (const auto& entry : fs::directory_iterator(fs::is_directory(cells) ? cells : folder)) {
    const bool is_export = fs::exists(entry.path() / kExportMarker);
    if (fs::exists(entry.path() / kScenarioFile) && !is_export) runs.push_back(entry.path());
  }
  std::sort(runs.begin(), runs.end());
  return runs.empty() ? std::vector{folder} : runs;
}

std::vector<RunRecord> read_runs(const PlotOptions& options) {
  std::vector<RunRecord> records;
  for (const fs::path& given : options.runs) {
    const std::vector<fs::path> runs = runs_in(given);
    for (const fs::path& run : runs) {
      try {
        records.push_back(read_run(run));
      } catch (const BadInput& error) {
        if (run == given) throw;  // one damaged run of a folder does not spoil the others
        say("{}: left out", error.what());
        continue;
      }
      for (const std::string& missing : records.back().missing) {
        say(missing);
      }
    }
    if (records.empty()) {
      throw BadInput(
          fmt::format("{}: none of its {} runs can be read", given.string(), runs.size()));
    }
  }
  return records;
}

bool wants(const PlotOptions& options, const std::string& plot) {
  return std::find(options.plots.begin(), options.plots.end(), plot) != options.plots.end();
}

/// What follows the names of plots: nothing for a single run, else "-RUN".
std::vector<std::string> name_ends(const std::vector<RunRecord>& records) {
  if (records.size() == 1) return {""};
  std::vector<fs::path> folders;
  for (const RunRecord& record : records) folders.push_back(record.folder);
  std::vector<std::string> ends = run_names(folders);
  for (std::string& end : ends) end.insert(0, "-");
  return ends;
}

/// Where `is_overlaid`, another plot shows the densities of all of them.
std::vector<Plot> plots_of_runs(const PlotOptions& options, const std::vector<RunRecord>& records,
                                bool is_overlaid) {
  std::vector<Plot> plots;
  const std::vector<std::string> ends = name_ends(records);
  const auto add = [&](const char* what, std::size_t run, std::optional<Plot> plot) {
    if (plot) {
      plot->name = what + ends[run];
      plots.push_back(std::move(*plot));
    } else {
      say("{}: no views to plot as {}", records[run].folder.string(), what);
    }
  };
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (wants(options, "density")) {
      add(is_overlaid ? "entropy" : "density", i, density_entropy_plot(records[i], !is_overlaid));
    }
    if (wants(options, "terms")) add("terms", i, terms_plot(records[i]));
    if (wants(options, "predictions")) add("predictions", i, predictions_plot(records[i]));
    if (wants(options, "tracking")) add("tracking", i, tracking_plot(records[i]));
    if (wants(options, "flight")) add("flight", i, flight_plot(records[i]));
  }
  return plots;
}

std::vector<Plot> plots_of_reach(const PlotOptions& options, std::span<const RunGroup> groups) {
  std::vector<Plot> plots;
  for (const Effort effort : {Effort::views, Effort::metres, Effort::seconds}) {
    if (auto plot = reach_plot(groups, effort, options.reach_percent / 100.0)) {
      plots.push_back(std::move(*plot));
    }
  }
  if (plots.empty()) {
    say("no run's ceiling is known, so not how far they got; `gnbv score RUN --update "
        "--ceiling` finds it");
  }
  return plots;
}

/// The runs that were scored at the size, its curve in the place of the finest one's.
std::vector<RunRecord> runs_at(std::vector<RunRecord> records, double size_m) {
  std::erase_if(records, [&](RunRecord& record) {
    if (!record.figures) return false;  // which the groups say
    for (const SizedCoverage& at : record.figures->more) {
      if (at.size_m != size_m) continue;
      for (std::size_t i = 0; i < at.curve.size(); ++i) {
        record.figures->curve.coverage[i][0] = at.curve[i];
      }
      return false;
    }
    say("{}: not scored at {} m: left out; `gnbv score RUN --resolution {} --update` "
        "scores it",
        record.folder.string(), size_name(size_m), size_name(size_m));
    return true;
  });
  return records;
}

std::vector<Plot> coverage_plots(const std::vector<RunRecord>& records, double size_m) {
  const std::optional<std::size_t> size = papers_size(size_m);
  const std::vector<RunRecord> own = size ? std::vector<RunRecord>{} : runs_at(records, size_m);
  std::vector<std::string> notes;  // said of all groups
  const std::vector<RunGroup> groups = group_runs(size ? records : own, notes);
  std::vector<Plot> plots;
  for (const Effort effort : {Effort::views, Effort::metres, Effort::seconds}) {
    if (groups.empty()) break;
    plots.push_back(size ? coverage_plot(groups, effort, *size)
                         : coverage_plot_at(groups, effort, size_m));
    if (!size) continue;
    if (auto end = coverage_end_plot(groups, effort, *size)) plots.push_back(std::move(*end));
  }
  return plots;
}

std::vector<Plot> plots_of_groups(const PlotOptions& options,
                                  const std::vector<RunRecord>& records) {
  std::vector<std::string> notes;
  const std::vector<RunGroup> groups = group_runs(records, notes);
  for (const std::string& note : notes) say(note);
  if (groups.empty()) return {};
  std::vector<Plot> plots;
  if (wants(options, "coverage")) plots = coverage_plots(records, options.voxel_m);
  if (wants(options, "density") && groups.size() > 1) {
    const std::vector<MeanSeries> series = mean_densities(groups);
    if (!series.empty()) plots.push_back(mean_density_plot(series, common_scenario(groups)));
  }
  // how many runs got there says nothing of a single one
  if (wants(options, "reach") && (records.size() > 1 || options.are_plots_asked_for)) {
    for (Plot& reach : plots_of_reach(options, groups)) plots.push_back(std::move(reach));
  }
  return plots;
}

void draw(const PlotOptions& options, const Plot& plot, const fs::path& folder) {
  for (const auto& [name, format] : kFormats) {
    if (std::find(options.formats.begin(), options.formats.end(), name) == options.formats.end()) {
      continue;
    }
    const std::string script = plot_script(plot, format, options.size);
    const fs::path picture = folder / (plot.name + "." + name);
    draw_plot(script, picture);
    fmt::print("{}\n", picture.string());
    if (!options.keep) continue;
    // two formats of a plot differ in their terminals only, yet each is whole
    const fs::path kept = folder / (plot.name + "." + name + ".gp");
    write_file_atomically(kept, script);
    fmt::print("{}\n", kept.string());
  }
}

void plot(const PlotOptions& options) {
  const std::vector<RunRecord> records = read_runs(options);
  std::vector<Plot> of_groups;
  if (wants(options, "coverage") || wants(options, "reach") || wants(options, "density")) {
    of_groups = plots_of_groups(options, records);
  }
  const bool is_overlaid = std::any_of(of_groups.begin(), of_groups.end(),
                                       [](const Plot& each) { return each.name == "density"; });
  std::vector<Plot> plots = plots_of_runs(options, records, is_overlaid);
  for (Plot& each : of_groups) plots.push_back(std::move(each));
  if (plots.empty()) {
    throw BadInput(fmt::format("{}: nothing to plot", records.front().folder.string()));
  }
  fs::path folder = options.out;
  if (folder.empty()) folder = records.size() == 1 ? records.front().folder / "plots" : "plots";
  const bool is_new = make_folder(folder);
  try {
    for (const Plot& each : plots) draw(options, each, folder);
  } catch (...) {
    std::error_code ignored;
    if (is_new) fs::remove(folder, ignored);  // when nothing came into it
    throw;
  }
}

}  // namespace

void add_plot_command(CLI::App& app) {
  auto options = std::make_shared<PlotOptions>();
  CLI::App* const command =
      app.add_subcommand("plot", "density, entropy, coverage and utility terms as curves");
  command->add_option("RUN", options->runs, "run directories, or folders of them")->required();
  command->add_option("-o,--out", options->out,
                      "folder to write into (default: RUN/plots; plots/ for several runs)");
  command->add_option("--format", options->formats, "svg, png, pdf, with commas")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(is_one_of({"svg", "png", "pdf"}))
      ->capture_default_str();
  command
      ->add_option(
          "--plots", options->plots,
          "which: density, coverage, terms, reach (of several runs, or asked for), flight, "
          "tracking, predictions, with commas")
      ->each([options](const std::string&) { options->are_plots_asked_for = true; })
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(
          is_one_of({"density", "coverage", "terms", "reach", "flight", "tracking", "predictions"}))
      ->capture_default_str();
  command
      ->add_option("--reach", options->reach_percent,
                   "percent of the ceiling that the reach plots ask for")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command->add_option("--voxel", options->voxel_m, "edge of the voxels that are covered (m)")
      ->check(is_positive())
      ->capture_default_str();
  command
      ->add_option("--width,--width-px", options->size.width_px,
                   "in pixels; 1512 is one column of a paper at 432 dots an inch")
      ->check(CLI::Range(200, 8192))
      ->capture_default_str();
  command
      ->add_option("--height,--height-px", options->size.height_px,
                   "in pixels (default: what each plot asks for)")
      ->check(CLI::Range(150, 8192));
  command->add_flag("--keep", options->keep,
                    "also write the scripts with their data, to restyle: gnuplot X.gp > X");
  command->callback([options] { plot(*options); });
}

}  // namespace gnbv
