#include <algorithm>
#include <map>

#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "tools/mission/resolve.hpp"
#include "tools/sweep/cell_id.hpp"
#include "tools/sweep/sweep.hpp"
#include "tools/sweep/sweep_yaml.hpp"

namespace gnbv {
namespace {

/// Resolves scenarios; the extents of their structures are found once each.
class Resolver {
 public:
  explicit Resolver(const Sweep& sweep) : sweep_(sweep) {}

  /// Seeds aside: the seed is the scenario's own.
  Scenario resolve(const SweepScenario& scenario, const SweepMethod& method) {
    std::vector<Override> overrides;
    append(scenario.overrides, scenario.sources, overrides);
    append(method.overrides, method.sources, overrides);
    // a preset sets many keys: it would undo those that were set before it
    std::stable_partition(overrides.begin(), overrides.end(), [](const Override& given) {
      return std::string_view(given.text).substr(0, given.text.find('=')).ends_with(".preset");
    });
    ScenarioOptions options;
    options.scenario = scenario.scenario;
    options.mesh = scenario.mesh;
    options.bounds_auto = scenario.bounds_auto;
    return resolve_scenario(options, overrides,
                            [this](const Scenario& resolved) { return extent_of(resolved); });
  }

 private:
  void append(const std::vector<std::string>& texts, const std::vector<std::string>& sources,
              std::vector<Override>& overrides) const {
    for (std::size_t i = 0; i < texts.size(); ++i) {
      overrides.push_back({.text = texts[i],
                           .source = i < sources.size() ? sources[i] : "",
                           .folder = sweep_.folder.string()});
    }
  }

  StructureExtent extent_of(const Scenario& scenario) {
    Scenario only;  // what the extent depends on
    only.structure = scenario.structure;
    only.terrain = scenario.terrain;
    only.obstacles = scenario.obstacles;
    only.planner.floor_z_m = scenario.planner.floor_z_m;
    const std::string key = to_yaml(only);
    const auto known = extents_.find(key);
    if (known != extents_.end()) return known->second;
    return extents_[key] = structure_extent(scenario);
  }

  const Sweep& sweep_;
  std::map<std::string, StructureExtent> extents_;
};

Cell make_cell(const SweepScenario& scenario, const SweepMethod& method, std::uint64_t seed,
               const Scenario& resolved, CellNamer& namer) {
  Cell cell = {scenario.name, method.name, seed, "", resolved};
  cell.resolved.seed = seed;
  cell.id = namer.id_of(cell.resolved);
  return cell;
}

}  // namespace

std::size_t cell_count(const Sweep& sweep) {
  return sweep.scenarios.size() * sweep.methods.size() * sweep.seeds.size();
}

std::vector<Cell> cells_of(const Sweep& sweep) {
  const std::size_t count = cell_count(sweep);
  return count == 0 ? std::vector<Cell>{} : cells_of(sweep, 0, count - 1);
}

std::vector<Cell> cells_of(const Sweep& sweep, std::size_t first, std::size_t last) {
  GNBV_CHECK(first <= last && last < cell_count(sweep), "cells {} to {} of {}", first, last,
             cell_count(sweep));
  const std::size_t seeds = sweep.seeds.size();
  const std::size_t methods = sweep.methods.size();
  Resolver resolver(sweep);
  CellNamer namer;
  std::string faults;  // of all cells
  std::vector<Cell> cells;
  cells.reserve(last - first + 1);
  for (std::size_t row = first / seeds; row <= last / seeds; ++row) {
    const SweepScenario& scenario = sweep.scenarios[row / methods];
    const SweepMethod& method = sweep.methods[row % methods];
    try {
      const Scenario resolved = resolver.resolve(scenario, method);
      const std::size_t end = std::min(last + 1, (row + 1) * seeds);
      for (std::size_t i = std::max(first, row * seeds); i < end; ++i) {
        cells.push_back(make_cell(scenario, method, sweep.seeds[i % seeds], resolved, namer));
      }
    } catch (const BadInput& error) {
      faults += fmt::format("{}\n", error.what());
    }
  }
  if (!faults.empty()) throw BadInput(in_order_of_lines(faults));
  return cells;
}

}  // namespace gnbv
