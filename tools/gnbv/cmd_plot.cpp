#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/exports/export_folder.hpp"
#include "tools/figures/figure_files.hpp"
#include "tools/figures/runs_to_figures.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/run/file_names.hpp"
#include "tools/sweep/run_cells.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct PlotOptions {
  std::vector<fs::path> runs;
  fs::path out;
  std::vector<std::string> formats = {"svg"};
  FigureRequest figures;
  FigureStyle style;
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
      throw BadInput("{}: none of its {} runs can be read", given.string(), runs.size());
    }
  }
  return records;
}

void plot(const PlotOptions& options) {
  const std::vector<RunRecord> records = read_runs(options);
  std::vector<std::string> notes;
  const std::vector<Figure> figures = figures_of_runs(records, options.figures, notes);
  for (const std::string& note : notes) say(note);
  if (figures.empty()) throw BadInput("{}: nothing to plot", records.front().folder.string());
  fs::path folder = options.out;
  if (folder.empty()) folder = records.size() == 1 ? records.front().folder / "plots" : "plots";
  const bool is_new = make_folder(folder);
  try {
    for (const fs::path& written : write_figures(figures, options.formats, options.style, folder)) {
      fmt::print("{}\n", written.string());
    }
  } catch (...) {
    std::error_code ignored;
    if (is_new) fs::remove(folder, ignored);  // when nothing came into it
    throw;
  }
}

void add_look_options(CLI::App& command, PlotOptions& options) {
  command.add_option("--title", options.figures.title, "title of each figure, instead of its own");
  add_list(command, "--labels", options.figures.labels,
           "GROUP=LABEL of the legend, with commas, also in a LABEL; a GROUP is its label, its "
           "utility, or its number from 1");
  add_list(command, "--colors", options.figures.colours, "GROUP=#rrggbb, with commas");
  add_list(command, "--order", options.figures.order,
           "GROUPs in the order of the legend, with commas; the others follow");
  command.add_option("--font", options.style.font, "font by its name, or a file .ttf or .otf");
  command
      .add_option("--width,--width-px", options.style.width_px,
                  "width in pixels; 1512 is one column of a paper at 432 dots an inch")
      ->check(CLI::Range(200, 8192))
      ->capture_default_str();
  command
      .add_option("--height,--height-px", options.style.height_px,
                  "height in pixels (default: as each figure needs)")
      ->check(CLI::Range(150, 8192));
}

}  // namespace

void add_plot_command(CLI::App& app) {
  auto options = std::make_shared<PlotOptions>();
  CLI::App* const command =
      app.add_subcommand("plot", "density, entropy, coverage and utility terms as curves");
  command->add_option("RUN", options->runs, "run directories, or folders of them")->required();
  command->add_option("-o,--out", options->out,
                      "folder to write into, with each figure's data as NAME.csv (default: "
                      "RUN/plots; plots/ for several runs)");
  add_list(*command, "--format", options->formats,
           "svg, png, pdf, and json: all figures as data, figures.json; with commas")
      ->check(is_one_of({"svg", "png", "pdf", "json"}))
      ->capture_default_str();
  add_list(*command, "--plots", options->figures.kinds,
           "which: density, coverage, terms, reach (of several runs, or asked for), flight, "
           "tracking, predictions, with commas")
      ->each([options](const std::string&) { options->figures.has_reach_of_one = true; })
      ->check(is_one_of(figure_kinds_of_runs()))
      ->capture_default_str();
  command
      ->add_option("--reach", options->figures.reach_percent,
                   "percent of the ceiling; the reach figures show the effort to get there")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command->add_option("--voxel", options->figures.voxel_m, "edge of the voxels of the coverage (m)")
      ->check(is_positive())
      ->capture_default_str();
  add_look_options(*command, *options);
  command->callback([options] { plot(*options); });
}

}  // namespace gnbv
