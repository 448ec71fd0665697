#include "tools/sweep/compare_missions.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "planner/guided/utility.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "tools/sweep/manifest.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

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
    throw BadInput(fmt::format("--views {}: goes with {} among --utilities", file, kRouteName));
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
  throw BadInput(fmt::format("--baseline: value '{}': no method of this comparison; it has: {}",
                             request.baseline, fmt::join(methods, ", ")));
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

}  // namespace

ComparedMissions compare_missions(const CompareRequest& request, const BenchOptions& options) {
  const bool flies = request.from.empty();
  const std::vector<Cell> cells =
      flies ? cells_to_fly(request, options.seed_count) : cells_of_manifest(request.from);
  const std::vector<std::string> methods = names_of(cells, &Cell::method);
  if (methods.size() < 2) {
    throw BadInput(
        fmt::format("{}: the sweep has one method: nothing to compare", request.from.string()));
  }
  const std::string baseline = baseline_of(request, methods);
  ComparedMissions all{.flown =
                           flies ? fly_cells(cells, options) : read_cells(cells, request.from)};
  const BenchRuns& flown = all.flown;
  const bool has_baseline =
      std::any_of(flown.runs.begin(), flown.runs.end(),
                  [&](const ComparedRun& run) { return run.method == baseline; });
  if (!has_baseline) {
    throw CommandFailed(fmt::format("no mission of the baseline, {}, is done:\n{}", baseline,
                                    fmt::join(flown.notes, "\n")));
  }
  std::vector<std::string> notes = flown.notes;
  const Ceilings ceilings =
      request.no_ceiling ? Ceilings{} : ceilings_of(flown, baseline, options, notes);
  if (!request.no_ceiling) add_given_ceiling_note(options, notes);
  all.comparison = compare(flown.runs, baseline, ceilings);
  TextTable table = comparison_table(all.comparison);
  table.notes.insert(table.notes.end(), notes.begin(), notes.end());
  all.bench = {{std::move(table)}, flown.failures};
  return all;
}

}  // namespace gnbv
