#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "bench/compare/comparison_text.hpp"
#include "planner/planners.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/figures/figure_files.hpp"
#include "tools/figures/forest_figure.hpp"
#include "tools/figures/group_figures.hpp"
#include "tools/gnbv/bench_runs.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/run/user_views.hpp"
#include "tools/sweep/manifest.hpp"
#include "tools/sweep/method_options.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct CompareOptions {
  ScenarioOptions structure;  // of every scenario
  std::vector<std::string> scenarios;
  MethodOptions methods;
  fs::path views;  // of the method `route`
  BenchOptions bench = {.seed_count = 8};
  std::string baseline;  // "" is the first method
  fs::path from;         // of a sweep; "" flies
  bool no_ceiling = false;
  fs::path plots;  // folder; "" draws none
};

/// What is compared, before anything is flown.
struct Plan {
  std::vector<Cell> cells;
  std::string baseline;
};

std::vector<SweepScenario> scenarios_of(const CompareOptions& options) {
  if (options.scenarios.empty()) throw BadInput("compare: needs a SCENARIO, or --from");
  if (options.scenarios.size() > 1 && !options.structure.mesh.empty()) {
    throw BadInput(fmt::format("--mesh {}: one structure for {} scenarios; compare them one by one",
                               options.structure.mesh, options.scenarios.size()));
  }
  std::vector<SweepScenario> scenarios;
  for (const std::string& given : options.scenarios) {
    const auto is_new = [&](const std::string& name) {
      return std::none_of(scenarios.begin(), scenarios.end(),
                          [&](const SweepScenario& s) { return s.name == name; });
    };
    std::string name = load_flown_scenario(given).name;
    if (!is_new(name)) name = fs::path(given).stem().string();  // two files may make one scenario
    if (!is_new(name)) throw BadInput(fmt::format("{}: two scenarios are named '{}'", given, name));
    scenarios.push_back({.name = name,
                         .scenario = given,
                         .mesh = options.structure.mesh,
                         .bounds_auto = options.structure.bounds_auto,
                         .overrides = options.structure.overrides});
  }
  return scenarios;
}

std::string chosen_baseline(const std::vector<std::string>& methods, const std::string& asked_for) {
  if (asked_for.empty()) return methods.front();
  if (std::find(methods.begin(), methods.end(), asked_for) != methods.end()) return asked_for;
  throw BadInput(fmt::format("--baseline: value '{}': no method of this comparison; it has: {}",
                             asked_for, fmt::join(methods, ", ")));
}

std::uint64_t first_seed(const CompareOptions& options) {
  ScenarioOptions first = options.structure;  // as `run` reads it, with its faults
  first.scenario = options.scenarios.front();
  return resolve_scenario(first).seed;
}

/// The methods, the one named `route` with its views.
std::vector<SweepMethod> methods_with_views(const CompareOptions& options) {
  std::vector<SweepMethod> methods = methods_of(options.methods);
  if (options.views.empty()) return methods;
  const std::string_view taker = planners_that(&PlannerTraits::takes_views).front();
  const auto route = std::find_if(methods.begin(), methods.end(),
                                  [&](const SweepMethod& method) { return method.name == taker; });
  if (route == methods.end()) {
    throw BadInput(
        fmt::format("--views {}: goes with {} among --utilities", options.views.string(), taker));
  }
  route->sources.resize(route->overrides.size());
  route->overrides.push_back(views_override(read_user_views(options.views)));
  route->sources.push_back(fmt::format("--views {}", options.views.string()));
  return methods;
}

Plan plan_of(const CompareOptions& options) {
  Sweep sweep{.scenarios = scenarios_of(options), .methods = {}, .seeds = {}, .folder = {}};
  sweep.methods = methods_with_views(options);
  std::vector<std::string> names;
  for (const SweepMethod& method : sweep.methods) names.push_back(method.name);
  Plan plan{.cells = {}, .baseline = chosen_baseline(names, options.baseline)};
  sweep.seeds = seeds_from(first_seed(options), options.bench.seed_count);
  plan.cells = cells_of(sweep);
  return plan;
}

Plan plan_of_sweep(const CompareOptions& options) {
  Plan plan{.cells = cells_of_manifest(options.from), .baseline = {}};
  std::vector<std::string> names;
  for (const Cell& cell : plan.cells) {
    if (std::find(names.begin(), names.end(), cell.method) == names.end()) {
      names.push_back(cell.method);
    }
  }
  if (names.size() < 2) {
    throw BadInput(
        fmt::format("{}: the sweep has one method: nothing to compare", options.from.string()));
  }
  plan.baseline = chosen_baseline(names, options.baseline);
  return plan;
}

/// The paired differences, and the coverage over metres of all methods, scenario by scenario.
void draw_comparison(const Comparison& comparison, const BenchRuns& collected,
                     const fs::path& folder) {
  std::vector<Figure> figures;
  for (std::size_t scenario = 0; scenario < comparison.scenarios.size(); ++scenario) {
    if (auto forest = forest_figure(comparison, scenario)) figures.push_back(std::move(*forest));
    std::vector<RunRecord> records;
    for (std::size_t i = 0; i < collected.runs.size(); ++i) {
      if (collected.runs[i].scenario != comparison.scenarios[scenario]) continue;
      records.push_back(read_run(collected.folders[i]));
    }
    std::vector<std::string> notes;
    const std::vector<RunGroup> groups = group_runs(records, notes);
    for (const std::string& note : notes) say(note);
    if (groups.empty()) continue;
    figures.push_back(coverage_figure(groups, Effort::metres, kCoverageSizes_m[0]));
    figures.back().name += "-" + comparison.scenarios[scenario];
  }
  make_folder(folder);
  const std::vector<std::string> formats = {"svg", "json"};
  for (const fs::path& written : write_figures(figures, formats, {}, folder)) {
    say("{}", written.string());
  }
}

void compare_command(const CompareOptions& options) {
  const bool flies = options.from.empty();
  const Plan plan = flies ? plan_of(options) : plan_of_sweep(options);
  const BenchRuns collected =
      flies ? fly_cells(plan.cells, options.bench) : read_cells(plan.cells, options.from);
  const bool has_baseline =
      std::any_of(collected.runs.begin(), collected.runs.end(),
                  [&](const ComparedRun& run) { return run.method == plan.baseline; });
  if (!has_baseline) {
    for (const std::string& note : collected.notes) say(note);
    throw CommandFailed(fmt::format("no mission of the baseline, {}, is done", plan.baseline));
  }
  std::vector<std::string> more_notes = collected.notes;
  const Ceilings ceilings =
      options.no_ceiling ? Ceilings{} : ceilings_of(collected, options.bench, more_notes);
  if (!options.no_ceiling) add_given_ceiling_note(options.bench, more_notes);
  const Comparison comparison = compare(collected.runs, plan.baseline, ceilings);
  if (!options.plots.empty()) draw_comparison(comparison, collected, options.plots);
  TextTable table = comparison_table(comparison);
  table.notes.insert(table.notes.end(), more_notes.begin(), more_notes.end());
  print_bench({table}, options.bench.format, collected.has_failures);
}

}  // namespace

void add_compare_command(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* const command =
      app.add_subcommand("compare", "fly methods over seeds: is one better than another here?");
  CLI::Option* const scenarios =
      command->add_option("SCENARIO", options->scenarios, "built-in names or YAML files");
  add_structure_options(*command, options->structure);
  MethodOptions& methods = options->methods;
  std::vector<CLI::Option*> what_to_fly = {
      scenarios,
      command
          ->add_option("--utilities", methods.utilities,
                       "utilities by name or FILE.py:FUNCTION, with commas")
          ->delimiter(',')
          ->allow_extra_args(false),
      command->add_option("--presets", methods.presets, "planner presets by name, with commas")
          ->delimiter(',')
          ->allow_extra_args(false),
      command
          ->add_option("--variant", methods.variants,
                       "[NAME:]KEY=VALUE[,KEY=VALUE]... of the scenario file; repeatable")
          ->allow_extra_args(false),
      command
          ->add_option("--vary", methods.varies,
                       "KEY=VALUE[,VALUE]...: a method a value; repeatable")
          ->allow_extra_args(false)};
  what_to_fly.push_back(command->add_option(
      "--views", options->views, "body poses that the utility `route` flies, CSV or TUM"));
  command->add_option("--baseline", options->baseline,
                      "method the others are tested against (default: the first)");
  command->add_option("--plots", options->plots,
                      "folder for plots: paired differences with intervals, and coverage over "
                      "metres of all methods");
  CLI::Option* const no_ceiling = command->add_flag(
      "--no-ceiling", options->no_ceiling,
      "leave out the shares of the ceiling and the efforts to reach them: where none "
      "is known yet, each takes a minute");
  add_bench_options(*command, options->bench);
  no_ceiling->excludes(command->get_option("--ceiling-at"));
  CLI::Option* const from =
      command->add_option("--from", options->from, "folder of a sweep: compare what it flew");
  for (const char* name : {"--mesh", "--seed", "--set", "--bounds", "--seeds", "--jobs", "--out"}) {
    what_to_fly.push_back(command->get_option(name));
  }
  for (CLI::Option* const option : what_to_fly) option->excludes(from);
  command->callback([options] { compare_command(*options); });
}

}  // namespace gnbv
