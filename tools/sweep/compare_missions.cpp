#include "tools/sweep/compare_missions.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "planner/guided/utility.hpp"
#include "planner/planners.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "tools/run/file_names.hpp"
#include "tools/sweep/manifest.hpp"
#include "tools/sweep/run_cells.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

std::vector<SweepScenario> scenarios_of(const CompareRequest& request) {
  if (request.scenarios.empty()) throw BadInput("compare: needs a SCENARIO, or --from");
  if (request.scenarios.size() > 1 && !request.structure.mesh.empty()) {
    throw BadInput("--mesh {}: one structure for {} scenarios; compare them one by one",
                   request.structure.mesh, request.scenarios.size());
  }
  std::vector<SweepScenario> scenarios;
  for (const std::string& given : request.scenarios) {
    const auto is_new = [&](const std::string& name) {
      return std::none_of(scenarios.begin(), scenarios.end(),
                          [&](const SweepScenario& s) { return s.name == name; });
    };
    std::string name = load_flown_scenario(given).name;
    if (!is_new(name)) name = fs::path(given).stem().string();  // two files may make one scenario
    if (!is_new(name)) throw BadInput("{}: two scenarios are named '{}'", given, name);
    scenarios.push_back({.name = name,
                         .scenario = given,
                         .mesh = request.structure.mesh,
                         .bounds_auto = request.structure.bounds_auto,
                         .overrides = overrides_of(request.structure.overrides)});
  }
  return scenarios;
}

/// The methods, the one named `route` with its views.
std::vector<SweepMethod> methods_with_views(const CompareRequest& request) {
  std::vector<SweepMethod> methods = methods_of(request.methods);
  if (request.views.empty()) return methods;
  const std::string file = request.views.string();
  const auto route = std::find_if(methods.begin(), methods.end(), [](const SweepMethod& method) {
    return method.name == kRouteName;
  });
  if (route == methods.end()) {
    throw BadInput("--views {}: goes with {} among --utilities", file, kRouteName);
  }
  route->overrides.push_back(views_of_file(file));
  return methods;
}

/// Each once, in their order.
template <typename Named>
std::vector<std::string> names_of(const std::vector<Named>& all, std::string Named::*name) {
  std::vector<std::string> names;
  for (const Named& one : all) {
    if (std::find(names.begin(), names.end(), one.*name) == names.end()) names.push_back(one.*name);
  }
  return names;
}

/// What the others are tested against.
std::string baseline_of(const CompareRequest& request, const std::vector<std::string>& methods) {
  if (request.baseline.empty()) return methods.front();
  if (std::find(methods.begin(), methods.end(), request.baseline) != methods.end()) {
    return request.baseline;
  }
  throw BadInput("--baseline: value '{}': no method of this comparison; it has: {}",
                 request.baseline, fmt::join(methods, ", "));
}

std::vector<Cell> cells_to_fly(const CompareRequest& request, int seeds) {
  Sweep sweep{.scenarios = scenarios_of(request), .methods = methods_with_views(request)};
  baseline_of(request, names_of(sweep.methods,
                                &SweepMethod::name));  // is told before the faults of the methods
  ScenarioOptions first = request.structure;           // as `run` reads it, with its faults
  first.scenario = request.scenarios.front();
  sweep.seeds = seeds_from(resolve_scenario(first).seed, seeds);
  return cells_of(sweep);
}

/// Flies, or reads what was flown: a sweep's folder, or files of rows.
BenchRuns runs_of(const CompareRequest& request, const std::string& baseline,
                  const std::vector<Cell>& cells, const BenchOptions& options) {
  if (request.from.empty()) return rows_of_cells(cells, baseline, options);
  if (cells.empty()) return read_rows(request.from);
  const fs::path& folder = request.from.front();
  std::vector<Cell> done;
  for (Cell cell : cells) {  // which a manifest does not resolve
    const CellOutcome outcome = look_up(folder, cell);
    if (outcome.status != CellStatus::done) continue;
    cell.resolved = load_flown_scenario((outcome.run / kScenarioFile).string());
    done.push_back(std::move(cell));
  }
  return read_cells(cells, folder, ceilings_of(done, baseline, options));
}

/// Rows of tables as methods: without those that know the structure, and those of a setting beside
/// the scenario's. Scenarios of one name that were flown around several structures are told apart
/// by these, and these by their meshes where their files have one name.
void make_comparable(std::vector<MissionRow>& rows) {
  const std::vector<std::string_view> oracles = planners_that(&PlannerTraits::knows_structure);
  std::erase_if(rows, [&](const MissionRow& row) {
    return !row.setting.empty() || std::ranges::count(oracles, row.method) > 0;
  });
  std::map<std::string, std::set<std::string>> of_scenario, of_name;
  for (const MissionRow& row : rows) {
    of_scenario[row.scenario].insert(row.structure_id());
    of_name[row.structure].insert(row.structure_id());
  }
  for (MissionRow& row : rows) {
    if (of_scenario[row.scenario].size() < 2) continue;
    row.scenario = of_name[row.structure].size() < 2
                       ? row.structure
                       : fmt::format("{} ({:.8})", row.structure, row.structure_id());
  }
}

}  // namespace

ComparedMissions compare_missions(const CompareRequest& request, const BenchOptions& options) {
  std::vector<Cell> cells;
  if (!request.sweep.empty()) {
    cells = cells_of(read_sweep(request.sweep));
  } else if (request.from.empty()) {
    cells = cells_to_fly(request, options.seed_count);
  } else if (request.from.size() == 1 && std::filesystem::is_directory(request.from.front())) {
    cells = cells_of_manifest(request.from.front());
  }
  ComparedMissions all;
  BenchRuns& runs = all.flown;
  std::string baseline;
  std::vector<std::string> methods = names_of(cells, &Cell::method);
  if (!cells.empty()) baseline = baseline_of(request, methods);
  runs = runs_of(request, baseline, cells, options);
  if (cells.empty()) {
    make_comparable(runs.rows);
    methods = names_of(runs.rows, &MissionRow::method);
    baseline = baseline_of(request, methods);
  }
  if (methods.size() < 2) {
    throw BadInput("{}: one method: nothing to compare",
                   request.from.empty() ? "compare" : request.from.front().string());
  }
  if (std::ranges::count(runs.rows, baseline, &MissionRow::method) == 0) {
    throw CommandFailed("no mission of the baseline, {}, is done:\n{}", baseline,
                        fmt::join(runs.notes, "\n"));
  }
  all.comparison = compare(runs.rows, baseline);
  TextTable table = comparison_table(all.comparison);
  table.notes.insert(table.notes.end(), runs.notes.begin(), runs.notes.end());
  if (!options.no_ceiling) add_given_ceiling_note(options, table.notes);
  all.bench = {{std::move(table)}, runs.failures};
  return all;
}

}  // namespace gnbv
