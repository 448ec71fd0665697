#include "tools/sweep/table_missions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "bench/compare/paper_table.hpp"
#include "bench/compare/statistics.hpp"
#include "planner/planners.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/mission/load_world.hpp"

namespace gnbv {
namespace {

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
bool sets_max_iterations(const TableRequest& request, const Scenario& resolved) {
  const Scenario builtin = load_scenario(resolved.name, {});
  const auto max_iterations = [](const Scenario& scenario) {
    return scenario.planner.termination.max_iterations;
  };
  if (max_iterations(resolved) != max_iterations(builtin)) return true;
  const std::vector<std::string>& sets = request.scenario.overrides;
  return std::any_of(sets.begin(), sets.end(), [](const std::string& set) {
    return set.find("max_iterations") != std::string::npos;
  });
}

Sweep sweep_of(const TableRequest& request, const PaperTable& paper, const Scenario& first,
               int seeds) {
  std::vector<std::string> sets = request.scenario.overrides;
  if (!request.scenario.preset.empty()) {
    sets.insert(sets.begin(), "planner.preset=" + request.scenario.preset);
  }
  Sweep sweep{.scenarios = {{.name = std::string(paper.scenario),
                             .scenario = request.scenario.scenario,
                             .mesh = request.scenario.mesh,
                             .bounds_auto = request.scenario.bounds_auto,
                             .overrides = overrides_of(sets)}}};
  // after the scenario's, so that it is the row's whatever the user set
  const auto add_row = [&](std::string_view utility) {
    const std::string name(utility);
    sweep.methods.push_back({name, {{"planner.utility.name=" + name}}});
  };
  const bool is_limited = sets_max_iterations(request, first);
  const auto add_row_to_the_end = [&](std::string_view utility) {
    add_row(utility);
    if (!is_limited) sweep.methods.back().overrides.push_back({kToTheEnd});
  };
  for (const PaperRow& row : paper.rows) add_row(row.utility);
  for (SweepMethod& method : named_methods(request.utilities, "--utilities")) {
    sweep.methods.push_back(std::move(method));
  }
  for (const auto tour : planners_that(&PlannerTraits::makes_tours)) add_row_to_the_end(tour);
  if (!request.no_oracle) {
    for (const auto oracle : planners_that(&PlannerTraits::knows_structure)) {
      add_row_to_the_end(oracle);
    }
  }
  std::set<std::string> names;
  for (const SweepMethod& method : sweep.methods) {
    if (!names.insert(method.name).second) {
      throw BadInput(fmt::format("--utilities: two rows are called '{}'", method.name));
    }
  }
  sweep.seeds = seeds_from(first.seed, seeds);
  return sweep;
}

/// Of a mission whose sensors and poses are exact, as those of the ceiling.
std::vector<Override> exact_overrides(const Scenario& scenario) {
  std::vector<std::string> sets = {"vehicle.estimate.model=none"};
  for (std::size_t i = 0; i < scenario.cameras.size(); ++i) {
    sets.push_back(fmt::format("cameras.{}.noise.model=none", i));
  }
  for (std::size_t i = 0; i < scenario.lidars.size(); ++i) {
    sets.push_back(fmt::format("lidars.{}.range_sigma_m=0", i));
  }
  return overrides_of(sets);
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
    return covered.empty() || estimate_mean(covered).mean <= ceiling.leaf_counted[0];
  });
  const std::vector<Override> exact = exact_overrides(scenario);
  for (SweepMethod& method : sweep.methods) {
    method.overrides.insert(method.overrides.end(), exact.begin(), exact.end());
  }
  return sweep;
}

/// The oracles that count metres or seconds, once for each of kReachShares of the ceiling.
Sweep reach_sweep(Sweep sweep, const Ceiling& ceiling) {
  const std::vector<SweepMethod> methods = std::exchange(sweep.methods, {});
  const auto counted = {planners_that(&PlannerTraits::counts_metres),
                        planners_that(&PlannerTraits::counts_seconds)};
  for (const SweepMethod& method : methods) {
    if (std::none_of(counted.begin(), counted.end(),
                     [&](const auto& names) { return std::ranges::count(names, method.name); })) {
      continue;
    }
    for (std::size_t i = 0; i < kReachShares.size(); ++i) {
      SweepMethod& at_share = sweep.methods.emplace_back(method);
      at_share.name += fmt::format("@{}", kReachNames[i]);
      at_share.overrides.push_back(
          {fmt::format("planner.oracle.coverage={}", kReachShares[i] * ceiling.leaf_counted[0])});
    }
  }
  return sweep;
}

/// The runs of such a sweep, called by their oracles.
RunsByShare by_share(const BenchRuns& flown) {
  RunsByShare runs;
  for (const ComparedRun& run : flown.runs) {
    const std::size_t at = run.method.find('@');
    const auto share = std::ranges::find(kReachNames, run.method.substr(at + 1));
    runs[static_cast<std::size_t>(share - kReachNames.begin())].push_back(run.figures);
  }
  return runs;
}

/// What the table depends on; neither where it was made nor by how many processors.
std::string command_of(const TableRequest& request, const BenchOptions& options,
                       std::uint64_t first_seed) {
  const ScenarioOptions& of = request.scenario;
  std::string command = fmt::format("gnbv table {} --seed {} --seeds {}", shell_word(of.scenario),
                                    first_seed, options.seed_count);
  if (!of.mesh.empty()) command += " --mesh " + shell_word(of.mesh);
  if (of.bounds_auto) command += " --bounds auto";
  if (!of.preset.empty()) command += " --preset " + shell_word(of.preset);
  for (const std::string& utility : request.utilities) {
    command += " --utilities " + shell_word(utility);
  }
  for (const std::string& set : of.overrides) command += " --set " + shell_word(set);
  if (options.ceiling_percent) {
    command += fmt::format(" --ceiling-at {:.4g}", *options.ceiling_percent);
  }
  return command + (request.no_oracle ? " --no-oracle" : "");
}

}  // namespace

BenchTables table_of_missions(const TableRequest& request, const BenchOptions& options) {
  const Scenario first = resolve_scenario(request.scenario);
  const PaperTable& paper = paper_table_of(first, request.scenario.scenario);
  const Sweep sweep = sweep_of(request, paper, first, options.seed_count);
  const std::vector<Cell> cells = cells_of(sweep);
  const Ceiling ceiling = ceiling_of(cells.front().resolved, options);
  BenchRuns flown = fly_cells(cells, options);
  const auto take_notes = [&](const BenchRuns& some) {
    for (const auto list : {&BenchRuns::notes, &BenchRuns::failures}) {
      (flown.*list).insert((flown.*list).end(), (some.*list).begin(), (some.*list).end());
    }
  };
  RunsByShare oracles;
  if (const Sweep reach = reach_sweep(sweep, ceiling); !reach.methods.empty()) {
    const BenchRuns reached = fly_cells(cells_of(reach), options);
    oracles = by_share(reached);
    take_notes(reached);
  }
  std::vector<RunFigures> runs;
  std::vector<std::string> settings;
  const auto add = [&](const BenchRuns& some, const std::string& setting) {
    for (const ComparedRun& run : some.runs) {
      runs.push_back(run.figures);
      runs.back().utility = run.method;  // it may have been flown under another label
    }
    settings.resize(runs.size(), setting);
  };
  add(flown, "");
  const Sweep exact = exact_sweep(sweep, cells.front().resolved, flown.runs, ceiling);
  if (!exact.methods.empty()) {
    const BenchRuns again = fly_cells(cells_of(exact), options);
    add(again, "exact sensors");
    take_notes(again);
  }
  TextTable text = comparison_table(paper, runs, ceiling, settings);
  const auto effort = [&](Effort of) {
    return effort_table(paper, of, runs, ceiling, settings, oracles);
  };
  const TextTable metres = effort(Effort::metres);
  const TextTable seconds = effort(Effort::seconds);
  if (!exact.methods.empty()) {
    text.notes.emplace_back(
        "exact sensors: the same missions without noise of depth, range and pose, flown where "
        "ours lies above the ceiling");
  }
  add_given_ceiling_note(options, text.notes);
  const std::string structure = structure_name(first.structure);
  if (!is_papers_structure(paper, structure)) {
    text.notes.push_back(fmt::format(
        "ours is of {}, which is not known to be the structure that the paper's figures are of",
        request.scenario.mesh.empty() ? structure : request.scenario.mesh));
  }
  if (!has_papers_setting(cells.front().resolved)) {
    text.notes.emplace_back(kOtherSetting);
  }
  text.notes.insert(text.notes.end(), flown.notes.begin(), flown.notes.end());
  text.notes.push_back(
      fmt::format("{}, version {}", command_of(request, options, first.seed), GNBV_VERSION));
  // people read narrow tables, machines one wide one
  if (options.format == "csv" || options.format == "json") {
    return {
        {with_columns_of(with_columns_of(text, metres, kSharedColumns), seconds, kSharedColumns)},
        flown.failures};
  }
  return {{text, metres, seconds}, flown.failures};
}

}  // namespace gnbv
