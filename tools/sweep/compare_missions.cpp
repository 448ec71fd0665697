#include "tools/sweep/compare_missions.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "planner/guided/utility.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "tools/run/user_views.hpp"
#include "tools/sweep/manifest.hpp"
#include "tools/terminal/command_failed.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// What is compared, before anything is flown.
struct PlannedMissions {
  std::vector<Cell> cells;
  std::string baseline;
};

std::vector<SweepScenario> scenarios_of(const CompareRequest& request) {
  if (request.scenarios.empty()) throw BadInput("compare: needs a SCENARIO, or --from");
  if (request.scenarios.size() > 1 && !request.structure.mesh.empty()) {
    throw BadInput(fmt::format("--mesh {}: one structure for {} scenarios; compare them one by one",
                               request.structure.mesh, request.scenarios.size()));
  }
  std::vector<SweepScenario> scenarios;
  for (const std::string& given : request.scenarios) {
    const auto is_new = [&](const std::string& name) {
      return std::none_of(scenarios.begin(), scenarios.end(),
                          [&](const SweepScenario& s) { return s.name == name; });
    };
    std::string name = load_flown_scenario(given).name;
    if (!is_new(name)) name = fs::path(given).stem().string();  // two files may make one scenario
    if (!is_new(name)) throw BadInput(fmt::format("{}: two scenarios are named '{}'", given, name));
    scenarios.push_back({.name = name,
                         .scenario = given,
                         .mesh = request.structure.mesh,
                         .bounds_auto = request.structure.bounds_auto,
                         .overrides = request.structure.overrides});
  }
  return scenarios;
}

std::string chosen_baseline(const std::vector<std::string>& methods, const std::string& asked_for) {
  if (asked_for.empty()) return methods.front();
  if (std::find(methods.begin(), methods.end(), asked_for) != methods.end()) return asked_for;
  throw BadInput(fmt::format("--baseline: value '{}': no method of this comparison; it has: {}",
                             asked_for, fmt::join(methods, ", ")));
}

std::uint64_t first_seed(const CompareRequest& request) {
  ScenarioOptions first = request.structure;  // as `run` reads it, with its faults
  first.scenario = request.scenarios.front();
  return resolve_scenario(first).seed;
}

/// The methods, the one named `route` with its views.
std::vector<SweepMethod> methods_with_views(const CompareRequest& request) {
  std::vector<SweepMethod> methods = methods_of(request.methods);
  if (request.views.empty()) return methods;
  const auto route = std::find_if(methods.begin(), methods.end(), [](const SweepMethod& method) {
    return method.name == kRouteName;
  });
  if (route == methods.end()) {
    throw BadInput(fmt::format("--views {}: goes with {} among --utilities", request.views.string(),
                               kRouteName));
  }
  route->sources.resize(route->overrides.size());
  route->overrides.push_back(views_override(read_user_views(request.views)));
  route->sources.push_back(fmt::format("--views {}", request.views.string()));
  return methods;
}

PlannedMissions plan_of(const CompareRequest& request, int seeds) {
  Sweep sweep{.scenarios = scenarios_of(request), .methods = {}, .seeds = {}, .folder = {}};
  sweep.methods = methods_with_views(request);
  std::vector<std::string> names;
  for (const SweepMethod& method : sweep.methods) names.push_back(method.name);
  PlannedMissions plan{.cells = {}, .baseline = chosen_baseline(names, request.baseline)};
  sweep.seeds = seeds_from(first_seed(request), seeds);
  plan.cells = cells_of(sweep);
  return plan;
}

PlannedMissions plan_of_sweep(const CompareRequest& request) {
  PlannedMissions plan{.cells = cells_of_manifest(request.from), .baseline = {}};
  std::vector<std::string> names;
  for (const Cell& cell : plan.cells) {
    if (std::find(names.begin(), names.end(), cell.method) == names.end()) {
      names.push_back(cell.method);
    }
  }
  if (names.size() < 2) {
    throw BadInput(
        fmt::format("{}: the sweep has one method: nothing to compare", request.from.string()));
  }
  plan.baseline = chosen_baseline(names, request.baseline);
  return plan;
}

}  // namespace

ComparedMissions compare_missions(const CompareRequest& request, const BenchOptions& options) {
  const bool flies = request.from.empty();
  const PlannedMissions plan =
      flies ? plan_of(request, options.seed_count) : plan_of_sweep(request);
  ComparedMissions all{.flown = flies ? fly_cells(plan.cells, options)
                                      : read_cells(plan.cells, request.from)};
  const BenchRuns& flown = all.flown;
  const bool has_baseline =
      std::any_of(flown.runs.begin(), flown.runs.end(),
                  [&](const ComparedRun& run) { return run.method == plan.baseline; });
  if (!has_baseline) {
    throw CommandFailed(fmt::format("no mission of the baseline, {}, is done:\n{}", plan.baseline,
                                    fmt::join(flown.notes, "\n")));
  }
  std::vector<std::string> notes = flown.notes;
  const Ceilings ceilings = request.no_ceiling ? Ceilings{} : ceilings_of(flown, options, notes);
  if (!request.no_ceiling) add_given_ceiling_note(options, notes);
  all.comparison = compare(flown.runs, plan.baseline, ceilings);
  TextTable table = comparison_table(all.comparison);
  table.notes.insert(table.notes.end(), notes.begin(), notes.end());
  all.bench = {{std::move(table)}, flown.failures};
  return all;
}

}  // namespace gnbv
