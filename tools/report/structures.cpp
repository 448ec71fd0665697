#include "tools/report/structures.hpp"

#include <map>

#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/reference.hpp"
#include "tools/report/run_json.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kAllMeshBytes = 4'000'000;
constexpr std::size_t kAllSurfaceBytes = 6'000'000;
constexpr std::size_t kVoxelBytes = 6;
constexpr std::size_t kFoundBytes = 2;  // a voxel and run

/// Equal for runs of the same structure among the same obstacles on the same terrain, that are
/// scored alike.
std::string structure_key(const Scenario& scenario) {
  Scenario only;
  only.structure = scenario.structure;
  only.terrain = scenario.terrain;
  only.obstacles = scenario.obstacles;
  only.score.region_m = scenario.score.region_m;
  only.planner.floor_z_m = scenario.planner.floor_z_m;
  return to_yaml(only);
}

/// What stands there, as one mesh.
TriangleMesh all_meshes(const World& world) {
  TriangleMesh all = world.structure;
  for (const TriangleMesh* more : {&world.obstacles, &world.terrain}) {
    if (!more->faces.empty()) append(all, *more);
  }
  return all;
}

std::shared_ptr<KnownStructure> known_structure(const Scenario& scenario, std::size_t max_voxels,
                                                int threads) {
  std::vector<std::string> told_by_run;  // the mesh's faults were told when it was flown
  auto known = std::make_shared<KnownStructure>(load_world_anywhere(scenario, told_by_run));
  try {
    const auto reference = reference_of(scenario, known->world, known->scene, threads);
    known->to_find = true_voxels(reference, max_voxels);
  } catch (const BadInput&) {
    // nothing to measure: there is nothing to find
  }
  return known;
}

}  // namespace

Structures pack_structures(const std::vector<RunRecord>& records, int threads) {
  std::map<std::string, Structures::OfRun> known;
  for (const RunRecord& record : records) known[structure_key(record.scenario)] = {};
  const std::size_t max_bytes = kAllMeshBytes / known.size();
  const std::size_t max_voxels =
      kAllSurfaceBytes / (kVoxelBytes * known.size() + kFoundBytes * records.size());
  known.clear();
  Structures out;
  for (const RunRecord& record : records) {
    const auto [entry, is_new] = known.try_emplace(structure_key(record.scenario));
    Structures::OfRun& structure = entry->second;
    try {
      if (is_new) {
        structure.known = known_structure(record.scenario, max_voxels, threads);
        structure.number = static_cast<int>(out.json.size());
        Json json = mesh_json(all_meshes(structure.known->world), max_bytes, out.bytes);
        json["surface"] = true_voxels_json(structure.known->to_find, out.bytes);
        out.json.push_back(json);
      }
    } catch (const BadInput& error) {
      structure.why = error.what();
    }
    out.of_run.push_back(structure);
  }
  return out;
}

}  // namespace gnbv
