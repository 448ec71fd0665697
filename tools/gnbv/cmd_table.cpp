#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "bench/compare/effort_table.hpp"
#include "bench/compare/paper_table.hpp"
#include "bench/compare/statistics.hpp"
#include "planner/planners.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/gnbv/bench_runs.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/sweep/method_options.hpp"

namespace gnbv {
namespace {

struct TableOptions {
  ScenarioOptions scenario;
  BenchOptions bench;
  std::vector<std::string> utilities = {};  // rows beside the paper's
  bool no_oracle = false;
};

const PaperTable& paper_table_of(const Scenario& scenario, const std::string& asked_for) {
  const PaperTable* const paper = find_paper_table(scenario.name);
  if (paper != nullptr) return *paper;
  std::string known;
  for (const PaperTable& t : paper_tables()) known += fmt::format(" {}", t.scenario);
  throw BadInput(
      fmt::format("{}: the paper has no table for this scenario; it has:{}", asked_for, known));
}

/// The tour ends by itself, and an oracle is to show what is possible: the paper's number of views
/// is no bound for them, but one that the user sets is.
constexpr const char* kToTheEnd = "planner.termination.max_iterations=100000";

/// In a file, or by an override, whatever its value.
bool sets_max_iterations(const TableOptions& options, const Scenario& resolved) {
  const Scenario builtin = load_scenario(resolved.name, {});
  const auto max_iterations = [](const Scenario& scenario) {
    return scenario.planner.termination.max_iterations;
  };
  if (max_iterations(resolved) != max_iterations(builtin)) return true;
  const std::vector<std::string>& sets = options.scenario.overrides;
  return std::any_of(sets.begin(), sets.end(), [](const std::string& set) {
    return set.find("max_iterations") != std::string::npos;
  });
}

Sweep sweep_of(const TableOptions& options, const PaperTable& paper, const Scenario& first) {
  Sweep sweep;
  SweepScenario scenario{.name = std::string(paper.scenario),
                         .scenario = options.scenario.scenario,
                         .mesh = options.scenario.mesh,
                         .bounds_auto = options.scenario.bounds_auto,
                         .overrides = {}};
  if (!options.scenario.preset.empty()) {
    scenario.overrides.push_back("planner.preset=" + options.scenario.preset);
  }
  scenario.overrides.insert(scenario.overrides.end(), options.scenario.overrides.begin(),
                            options.scenario.overrides.end());
  sweep.scenarios = {scenario};
  // after the scenario's, so that it is the row's whatever the user set
  const auto add_row = [&](std::string_view utility) {
    sweep.methods.push_back(
        {std::string(utility), {fmt::format("planner.utility.name={}", utility)}});
  };
  const bool is_limited = sets_max_iterations(options, first);
  const auto add_row_to_the_end = [&](std::string_view utility) {
    add_row(utility);
    if (is_limited) return;
    sweep.methods.back().overrides.push_back(kToTheEnd);
  };
  for (const PaperRow& row : paper.rows) add_row(row.utility);
  for (const std::string& utility : options.utilities) {
    sweep.methods.push_back(method_of_utility(utility));
  }
  for (const auto tour : planners_that(&PlannerTraits::makes_tours)) add_row_to_the_end(tour);
  if (!options.no_oracle) {
    for (const auto oracle : planners_that(&PlannerTraits::knows_structure)) {
      add_row_to_the_end(oracle);
    }
  }
  sweep.seeds = seeds_from(first.seed, options.bench.seed_count);
  return sweep;
}

/// Of a mission whose sensors and poses are exact, as those of the ceiling.
std::vector<std::string> exact_overrides(const Scenario& scenario) {
  std::vector<std::string> sets = {"vehicle.estimate.model=none"};
  for (std::size_t i = 0; i < scenario.cameras.size(); ++i) {
    sets.push_back(fmt::format("cameras.{}.noise.model=none", i));
  }
  for (std::size_t i = 0; i < scenario.lidars.size(); ++i) {
    sets.push_back(fmt::format("lidars.{}.range_sigma_m=0", i));
  }
  return sets;
}

/// The missions whose mean lies above the ceiling once more, without noise: is it by noise alone?
Sweep exact_sweep(Sweep sweep, const Scenario& scenario, const std::vector<ComparedRun>& runs,
                  const Ceiling& ceiling) {
  std::erase_if(sweep.methods, [&](const SweepMethod& method) {
    if (ceiling.is_given) return true;  // nobody said that it is a bound
    std::vector<double> covered;
    for (const ComparedRun& run : runs) {
      if (run.method == method.name) covered.push_back(run.figures.coverage_final[0]);
    }
    return covered.empty() || estimate_mean(covered).mean <= ceiling.leaf_outside[0];
  });
  for (SweepMethod& method : sweep.methods) {
    const std::vector<std::string> exact = exact_overrides(scenario);
    method.overrides.insert(method.overrides.end(), exact.begin(), exact.end());
  }
  return sweep;
}

/// What the table depends on; neither where it was made nor by how many processors.
std::string command_of(const TableOptions& options, std::uint64_t first_seed) {
  const ScenarioOptions& of = options.scenario;
  std::string command = fmt::format("gnbv table {} --seed {} --seeds {}", shell_word(of.scenario),
                                    first_seed, options.bench.seed_count);
  if (!of.mesh.empty()) command += " --mesh " + shell_word(of.mesh);
  if (of.bounds_auto) command += " --bounds auto";
  if (!of.preset.empty()) command += " --preset " + shell_word(of.preset);
  for (const std::string& utility : options.utilities) {
    command += " --utilities " + shell_word(utility);
  }
  for (const std::string& set : of.overrides) command += " --set " + shell_word(set);
  if (options.bench.ceiling_percent) {
    command += fmt::format(" --ceiling-at {:.4g}", *options.bench.ceiling_percent);
  }
  return command + (options.no_oracle ? " --no-oracle" : "");
}

void table(const TableOptions& options) {
  const Scenario first = resolve_scenario(options.scenario);
  const PaperTable& paper = paper_table_of(first, options.scenario.scenario);
  const Sweep sweep = sweep_of(options, paper, first);
  const std::vector<Cell> cells = cells_of(sweep);
  const Ceiling ceiling = ceiling_of(cells.front().resolved, options.bench);
  BenchRuns flown = fly_cells(cells, options.bench);
  std::vector<RunFigures> runs;
  std::vector<std::string> settings;
  const auto add = [&](const BenchRuns& some, const std::string& setting) {
    for (const ComparedRun& run : some.runs) runs.push_back(run.figures);
    settings.resize(runs.size(), setting);
  };
  add(flown, "");
  const Sweep exact = exact_sweep(sweep, cells.front().resolved, flown.runs, ceiling);
  if (!exact.methods.empty()) {
    const BenchRuns again = fly_cells(cells_of(exact), options.bench);
    add(again, "exact sensors");
    flown.notes.insert(flown.notes.end(), again.notes.begin(), again.notes.end());
    flown.has_failures = flown.has_failures || again.has_failures;
  }
  TextTable text = comparison_table(paper, runs, ceiling, settings);
  const TextTable effort = effort_table(paper, runs, ceiling, settings);
  if (!exact.methods.empty()) {
    text.notes.emplace_back(
        "exact sensors: the same missions without noise of depth, range and pose, flown where "
        "ours lies above the ceiling");
  }
  add_given_ceiling_note(options.bench, text.notes);
  const std::string structure = structure_name(first.structure);
  if (!is_papers_structure(paper, structure)) {
    text.notes.push_back(fmt::format(
        "ours is of {}, which is not known to be the structure that the paper's figures are of",
        options.scenario.mesh.empty() ? structure : options.scenario.mesh));
  }
  if (!has_papers_setting(cells.front().resolved)) {
    text.notes.emplace_back(kOtherSetting);
  }
  text.notes.insert(text.notes.end(), flown.notes.begin(), flown.notes.end());
  text.notes.push_back(
      fmt::format("{}, version {}", command_of(options, first.seed), GNBV_VERSION));
  // people read two narrow tables, machines one wide one
  const std::string& format = options.bench.format;
  if (format == "csv" || format == "json") {
    print_bench({with_columns_of(text, effort, kSharedColumns)}, format, flown.has_failures);
  } else {
    print_bench({text, effort}, format, flown.has_failures);
  }
}

}  // namespace

void add_table_command(CLI::App& app) {
  auto options = std::make_shared<TableOptions>();
  CLI::App* const command = app.add_subcommand(
      "table", "fly every row of the paper's table, the tour and the oracles, and print all");
  add_scenario_options(*command, options->scenario);
  add_preset_option(*command, options->scenario);
  add_bench_options(*command, options->bench);
  command
      ->add_option("--utilities", options->utilities,
                   "rows beside the paper's: utilities by name or FILE.py:FUNCTION, with commas")
      ->delimiter(',');
  command->add_flag("--no-oracle", options->no_oracle,
                    "without the rows of planners that know the mesh");
  command->callback([options] { table(*options); });
}

}  // namespace gnbv
