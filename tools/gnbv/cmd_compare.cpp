
#include <CLI/CLI.hpp>
#include <memory>

#include "sim/core/file.hpp"
#include "tools/figures/figure_files.hpp"
#include "tools/figures/group_figures.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/sweep/compare_missions.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct CompareOptions {
  CompareRequest request;
  BenchOptions bench = {.seed_count = 8};
  fs::path plots;  // folder; "" draws none
};

/// The paired differences, and of all methods the coverage over metres and over seconds from
/// take-off, scenario by scenario.
void draw_comparison(const ComparedMissions& missions, const fs::path& folder) {
  const Comparison& comparison = missions.comparison;
  const BenchRuns& collected = missions.flown;
  std::vector<Figure> figures;
  for (std::size_t scenario = 0; scenario < comparison.scenarios.size(); ++scenario) {
    if (auto forest = forest_figure(comparison, scenario)) figures.push_back(std::move(*forest));
    std::vector<RunRecord> records;
    for (std::size_t i = 0; i < collected.rows.size(); ++i) {
      if (collected.rows[i].scenario != comparison.scenarios[scenario]) continue;
      if (collected.folders[i].empty()) continue;  // a row alone has no curve
      records.push_back(read_run(collected.folders[i]));
    }
    std::vector<std::string> notes;
    const std::vector<RunGroup> groups = group_runs(records, notes);
    for (const std::string& note : notes) say(note);
    if (groups.empty()) continue;
    for (const Effort effort : {Effort::metres, Effort::seconds_with_profile}) {
      figures.push_back(coverage_figure(groups, effort, kCoverageSizes_m[0]));
      figures.back().name += "-" + comparison.scenarios[scenario];
    }
  }
  for (Figure& figure : figures) {  // of a scenario that a sweep may have called a/b
    std::replace(figure.name.begin(), figure.name.end(), '/', '-');
  }
  make_folder(folder);
  const std::vector<std::string> formats = {"svg", "json"};
  for (const fs::path& written : write_figures(figures, formats, {}, folder)) {
    say("{}", written.string());
  }
}

void compare_command(const CompareOptions& options) {
  const ComparedMissions missions = compare_missions(options.request, options.bench);
  if (!options.plots.empty()) draw_comparison(missions, options.plots);
  print_bench(missions.bench, options.bench.format);
}

}  // namespace

void add_compare_command(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  CompareRequest& request = options->request;
  CLI::App* const command =
      app.add_subcommand("compare", "fly methods over seeds: is one better than another here?");
  const auto add = [&](const char* name, auto& value, const char* meaning) {
    return command->add_option(name, value, meaning)->allow_extra_args(false);
  };
  std::vector<CLI::Option*> what_to_fly = {
      command->add_option("SCENARIO", request.scenarios, "built-in names or YAML files")};
  add_structure_options(*command, request.structure);
  MethodOptions& methods = request.methods;
  what_to_fly.insert(
      what_to_fly.end(),
      {add_utilities_option(*command, methods.utilities, "methods"),
       add("--presets", methods.presets, "planner presets by name, with commas")->delimiter(','),
       add("--variant", methods.variants,
           "[NAME:]KEY=VALUE[,KEY=VALUE]... of the scenario file; repeatable"),
       add("--vary", methods.varies, "KEY=VALUE[,VALUE]...: one method for each value; repeatable"),
       command->add_option("--views", request.views,
                           "body poses that the utility `route` flies, CSV or TUM")});
  command->add_option("--baseline", request.baseline,
                      "method that the others are tested against (default: the first)");
  command->add_option("--plots", options->plots,
                      "folder for plots: paired differences with intervals, and coverage over "
                      "metres of all methods");
  CLI::Option* const no_ceiling =
      command->add_flag("--no-ceiling", options->bench.no_ceiling,
                        "leave out the shares of the ceiling, and the efforts to reach them. A "
                        "ceiling that is not known yet takes a minute to find");
  add_bench_options(*command, options->bench);
  no_ceiling->excludes(command->get_option("--ceiling-at"));
  CLI::Option* const sweep =
      command->add_option("--sweep", request.sweep, "file of a sweep: fly its missions");
  for (CLI::Option* const option : what_to_fly) sweep->excludes(option);
  for (const char* name : {"--mesh", "--seed", "--set", "--bounds", "--seeds"}) {
    sweep->excludes(command->get_option(name));
  }
  what_to_fly.push_back(sweep);
  CLI::Option* const from = command->add_option(
      "--from", request.from,
      "folder of a sweep, or files of rows (--missions): compare what they hold, fly nothing");
  for (const char* name :
       {"--mesh", "--seed", "--set", "--bounds", "--seeds", "--jobs", "--out", "--missions"}) {
    what_to_fly.push_back(command->get_option(name));
  }
  for (CLI::Option* const option : what_to_fly) option->excludes(from);
  command->callback([options] { compare_command(*options); });
}

}  // namespace gnbv
