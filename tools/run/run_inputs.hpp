// inputs.json: what a run read beside its scenario.yaml, by content. A mesh that is exchanged later
// is another world under the same name.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scenarios/scenario.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

struct RunInput {
  std::string key;     // of the scenario: structure, obstacles, terrain, planner.profiling.file
  std::string name;    // the file, or what is built in
  std::string sha256;  // of a mesh the vertices and faces as they are flown, with pictures if any,
                       // of a file its bytes
};

/// The meshes of the world.
std::vector<RunInput> world_inputs(const Scenario& scenario, const World& world);

/// Those, and the saved profile that the mission begins with.
std::vector<RunInput> run_inputs(const Scenario& scenario, const World& world);

void write_inputs(const std::filesystem::path& run, std::span<const RunInput> inputs);

/// Of inputs.json; nothing where there is none. Throws BadInput naming one that is damaged.
std::vector<RunInput> read_inputs(const std::filesystem::path& run);

/// Throws BadInput naming file, key and `advice` when one of those given is another than the run
/// began with. What its inputs.json does not name, as that of an earlier version, is not asked.
void need_same_inputs(const std::filesystem::path& run, std::span<const RunInput> now,
                      const std::string& advice);

}  // namespace gnbv
