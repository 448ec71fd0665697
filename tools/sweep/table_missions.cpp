#include "tools/sweep/table_missions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <span>

#include "bench/compare/paper_groups.hpp"
#include "bench/compare/paper_table.hpp"
#include "bench/compare/statistics.hpp"
#include "planner/planners.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

constexpr const char* kExact = "exact sensors";  // of a row

const PaperTable& paper_table_of(const std::string& scenario, const std::string& asked_for) {
  const PaperTable* const paper = find_paper_table(scenario);
  if (paper != nullptr) return *paper;
  std::string known;
  for (const PaperTable& t : paper_tables()) known += fmt::format(" {}", t.scenario);
  throw BadInput("{}: the paper has no table for this scenario; it has:{}", asked_for, known);
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
  for (const PaperRow& row : paper.rows) add_row(row.utility);
  for (SweepMethod& method : named_methods(request.utilities, "--utilities")) {
    sweep.methods.push_back(std::move(method));
  }
  for (const auto tour : planners_that(&PlannerTraits::makes_tours)) add_row(tour);
  if (!request.no_oracle) {
    for (const auto oracle : planners_that(&PlannerTraits::knows_structure)) {
      add_row(oracle);
    }
  }
  std::set<std::string> names;
  for (const SweepMethod& method : sweep.methods) {
    if (!names.insert(method.name).second) {
      throw BadInput("--utilities: two rows are called '{}'", method.name);
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
Sweep exact_sweep(Sweep sweep, const Scenario& scenario, const std::vector<MissionRow>& rows) {
  std::erase_if(sweep.methods, [&](const SweepMethod& method) {
    std::vector<double> above;
    for (const MissionRow& row : rows) {
      const bool is_bounded = row.find("physical_ceiling_0.05").has_value();
      if (row.method != method.name || !is_bounded) continue;
      above.push_back(*row.find("coverage_0.05") - *row.find("ceiling_0.05"));
    }
    return above.empty() || mean_of(above) <= 0.0;
  });
  const std::vector<Override> exact = exact_overrides(scenario);
  for (SweepMethod& method : sweep.methods) {
    method.overrides.insert(method.overrides.end(), exact.begin(), exact.end());
  }
  return sweep;
}

/// The oracles that count metres or seconds, for one share of the ceiling.
Sweep reach_sweep(Sweep sweep, std::size_t share, double ceiling) {
  const std::array counted = {planners_that(&PlannerTraits::counts_metres),
                              planners_that(&PlannerTraits::counts_seconds)};
  std::erase_if(sweep.methods, [&](const SweepMethod& method) {
    return std::ranges::none_of(
        counted, [&](const auto& names) { return std::ranges::count(names, method.name) > 0; });
  });
  for (SweepMethod& method : sweep.methods) {
    method.overrides.push_back(
        {fmt::format("planner.oracle.coverage={}", kReachShares[share] * ceiling)});
  }
  return sweep;
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

/// A table is of one scenario around one structure: means over several would be of none.
void need_one_scene(const std::vector<MissionRow>& rows) {
  const MissionRow& first = rows.front();
  for (const MissionRow& row : rows) {
    if (row.scenario == first.scenario && row.structure_id() == first.structure_id()) continue;
    const auto mesh = [](const MissionRow& of) {
      return fmt::format("{:.8}", of.structure_sha256);
    };
    throw BadInput(
        "--from: rows of {} around {} ({}) and of {} around {} ({}): a table is of one scenario "
        "and structure; compare --from takes several",
        first.scenario, first.structure, mesh(first), row.scenario, row.structure, mesh(row));
  }
}

/// What rows alone say, and the command that flew them.
BenchTables tables_of(const PaperTable& paper, const BenchRuns& runs, const BenchOptions& options,
                      const std::string& command) {
  TextTable text = comparison_table(paper, runs.rows);
  // people read narrow tables, machines one wide one
  const bool is_one = options.format == "csv" || options.format == "json";
  if (!is_one) text = with_columns_of(text, take_off_table(paper, runs.rows), kSharedColumns);
  const bool has_exact = std::ranges::count(runs.rows, kExact, &MissionRow::setting) > 0;
  if (has_exact) {
    text.notes.emplace_back(
        "exact sensors: the same missions without noise of depth, range and pose, flown where "
        "ours lies above the ceiling");
  }
  add_given_ceiling_note(options, text.notes);
  const auto is_papers = [&](std::string_view figure) {
    return std::ranges::all_of(
        runs.rows, [&](const MissionRow& row) { return row.find(figure).value_or(1.0) > 0.0; });
  };
  if (!is_papers("papers_structure")) {
    text.notes.push_back(fmt::format(
        "our rows are of {}, which is not known to be the structure of the paper's figures",
        runs.rows.front().structure));
  }
  if (!is_papers("papers_setting")) text.notes.emplace_back(kOtherSetting);
  text.notes.insert(text.notes.end(), runs.notes.begin(), runs.notes.end());
  if (!command.empty()) text.notes.push_back(command);
  std::vector<TextTable> tables = {std::move(text)};
  for (const Effort effort : std::span(kEfforts).subspan(1)) {  // but views
    TextTable more = effort_table(paper, effort, runs.rows);
    if (is_one) {
      tables[0] = with_columns_of(std::move(tables[0]), more, kSharedColumns);
    } else if (more.columns.size() > kSharedColumns) {
      tables.push_back(std::move(more));
    }
  }
  return {std::move(tables), runs.failures};
}

}  // namespace

BenchTables table_of_missions(const TableRequest& request, const BenchOptions& options) {
  if (!request.from.empty()) {
    const BenchRuns runs = read_rows(request.from);
    need_one_scene(runs.rows);
    return tables_of(paper_table_of(runs.rows.front().scenario, request.from.front().string()),
                     runs, options, {});
  }
  const Scenario first = resolve_scenario(request.scenario);
  const PaperTable& paper = paper_table_of(first.name, request.scenario.scenario);
  const Sweep sweep = sweep_of(request, paper, first, options.seed_count);
  const std::vector<Cell> cells = cells_of(sweep);
  BenchRuns runs = rows_of_cells(cells, std::string(paper.rows.back().utility), options);
  const auto add = [&](const Sweep& more, const std::string& setting) {
    if (more.methods.empty()) return;
    const BenchRuns flown = rows_of_cells(cells_of(more), "", options, setting);
    runs.rows.insert(runs.rows.end(), flown.rows.begin(), flown.rows.end());
    for (const auto list : {&BenchRuns::notes, &BenchRuns::failures}) {
      (runs.*list).insert((runs.*list).end(), (flown.*list).begin(), (flown.*list).end());
    }
  };
  const Sweep exact = exact_sweep(sweep, cells.front().resolved, runs.rows);
  const auto ceiling = runs.rows.empty() ? std::nullopt : runs.rows[0].find("ceiling_0.05");
  for (std::size_t i = 0; i < kReachShares.size() && ceiling; ++i) {
    add(reach_sweep(sweep, i, *ceiling), fmt::format("{}{}", kForShare, kReachNames[i]));
  }
  add(exact, kExact);
  return tables_of(
      paper, runs, options,
      fmt::format("{}, version {}", command_of(request, options, first.seed), GNBV_VERSION));
}

}  // namespace gnbv
