#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/sha256.hpp"
#include "sim/mesh/model_parts.hpp"
#include "tools/mission/resolve.hpp"
#include "tools/sweep/sweep.hpp"
#include "tools/sweep/sweep_yaml.hpp"

namespace gnbv {
namespace {

/// Resolves the scenarios of a sweep; the extents of their structures are found once each.
class Resolver {
 public:
  explicit Resolver(const Sweep& sweep) : folder_(sweep.folder.string()) {}

  /// Seeds aside: the seed is the scenario's own.
  Scenario resolve(const SweepScenario& scenario, const SweepMethod& method) {
    std::vector<Override> overrides = scenario.overrides;
    overrides.insert(overrides.end(), method.overrides.begin(), method.overrides.end());
    for (Override& given : overrides) given.folder = folder_;
    // a preset sets many keys: it would undo those that were set before it
    std::stable_partition(overrides.begin(), overrides.end(), [](const Override& given) {
      return std::string_view(given.text).substr(0, given.text.find('=')).ends_with(".preset");
    });
    ScenarioOptions options;
    options.scenario = scenario.scenario;
    options.mesh = scenario.mesh;
    options.bounds_auto = scenario.bounds_auto;
    try {
      return resolve_scenario(options, nullptr, overrides,
                              [this](const Scenario& resolved) { return extent_of(resolved); });
    } catch (const NoExtent&) {
      options.bounds_auto = false;
      return resolve_scenario(options, nullptr, overrides);
    }
  }

 private:
  /// Of what cannot be read: its own mission will say why, the others fly.
  struct NoExtent {};

  StructureExtent extent_of(const Scenario& scenario) {
    Scenario only;  // what the extent depends on
    only.structure = scenario.structure;
    only.terrain = scenario.terrain;
    only.obstacles = scenario.obstacles;
    only.planner.floor_z_m = scenario.planner.floor_z_m;
    const std::string key = to_yaml(only);
    const auto [entry, is_new] = extents_.try_emplace(key);
    if (is_new) {
      try {
        entry->second = structure_extent(scenario);
      } catch (const BadInput&) {
        entry->second.reset();
      }
    }
    if (!entry->second) throw NoExtent{};
    return *entry->second;
  }

  std::string folder_;
  std::map<std::string, std::optional<StructureExtent>> extents_;
};

/// Material libraries, buffers, pictures, the meshes of a model. None where the mesh cannot be
/// read: its mission will say why.
std::vector<std::filesystem::path> files_beside(const std::string& mesh) {
  const std::string extension = extension_of(mesh);
  if (extension == ".ply" || extension == ".stl") return {};
  try {
    return read_mesh({.path = mesh}).files;
  } catch (const BadInput&) {
    return {};
  }
}

}  // namespace

std::string CellNamer::content_path(const std::string& path, bool is_mesh) {
  if (path.empty()) return path;
  std::string& known = content_paths_[path];
  if (known.empty()) {
    Sha256 hash;
    hash.add(read_file(is_mesh ? model_file_of(path) : std::filesystem::path(path)));
    for (const auto& file : is_mesh ? files_beside(path) : std::vector<std::filesystem::path>{}) {
      hash.add(read_file(file));
    }
    known = "/sha256/" + hash.hex();  // absolute: to_yaml() puts the current folder before others
  }
  return known;
}

std::string CellNamer::id_of(const Scenario& scenario) {
  Scenario named = scenario;
  for (const MeshFileKey& mesh : mesh_files(named))
    mesh.file->path = content_path(mesh.file->path, true);
  named.planner.utility.python.label.clear();
  named.planner.utility.python.file.clear();
  std::string& profile = named.planner.profiling.file;
  profile = content_path(profile, false);
  const auto values = scenario_values(usual_beside(named));
  const std::set<std::pair<std::string, std::string>> defaults(values.begin(), values.end());
  Sha256 hash;
  hash.add(fmt::format("gnbv cell 3\n{}\n{}\n{} cameras, {} lidars\n", version_, source_,
                       named.cameras.size(), named.lidars.size()));
  for (const auto& value : scenario_values(named)) {
    if (!defaults.contains(value)) hash.add(fmt::format("{}={}\n", value.first, value.second));
  }
  return hash.hex().substr(0, 16);
}

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
      Scenario resolved = resolver.resolve(scenario, method);
      const std::size_t end = std::min(last + 1, (row + 1) * seeds);
      for (std::size_t i = std::max(first, row * seeds); i < end; ++i) {
        resolved.seed = sweep.seeds[i % seeds];
        cells.push_back(
            {scenario.name, method.name, resolved.seed, namer.id_of(resolved), resolved});
      }
    } catch (const BadInput& error) {
      faults += fmt::format("{}\n", error.what());
    }
  }
  if (!faults.empty()) throw BadInput(in_order_of_lines(faults));
  return cells;
}

}  // namespace gnbv
