#include "tools/run/run_inputs.hpp"

#include <map>
#include <nlohmann/json.hpp>

#include "bench/score/content_cache.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/file_names.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string hash_of(const TriangleMesh& mesh) {
  Sha256 sha;
  add_mesh(sha, mesh);
  return sha.hex();
}

/// The hash of each key; none where there is no such file.
std::map<std::string, std::string> read_hashes(const fs::path& path) {
  std::map<std::string, std::string> hashes;
  if (!fs::exists(path)) return hashes;
  const Json json = Json::parse(read_file(path), nullptr, false);
  const bool has_inputs = json.is_object() && json.contains("inputs") && json["inputs"].is_array();
  if (!has_inputs) throw BadInput(fmt::format("{}: holds no inputs", path.string()));
  for (const Json& input : json["inputs"]) {
    const bool is_whole = input.is_object() && input.contains("key") && input["key"].is_string() &&
                          input.contains("sha256") && input["sha256"].is_string();
    if (!is_whole) throw BadInput(fmt::format("{}: an input without hash", path.string()));
    hashes[input["key"].get<std::string>()] = input["sha256"].get<std::string>();
  }
  return hashes;
}

}  // namespace

std::vector<RunInput> world_inputs(const Scenario& scenario, const World& world) {
  std::vector<RunInput> inputs = {
      {"structure", structure_name(scenario.structure), hash_of(world.structure)}};
  if (!world.obstacles.faces.empty()) {
    inputs.push_back({"obstacles", fmt::format("{} obstacles", scenario.obstacles.size()),
                      hash_of(world.obstacles)});
  }
  if (!world.terrain.faces.empty()) {
    inputs.push_back({"terrain", scenario.terrain.path, hash_of(world.terrain)});
  }
  return inputs;
}

std::vector<RunInput> run_inputs(const Scenario& scenario, const World& world) {
  std::vector<RunInput> inputs = world_inputs(scenario, world);
  const ProfilingConfig& profiling = scenario.planner.profiling;
  if (profiling.method != ProfilingMethod::saved) return inputs;
  Sha256 sha;
  sha.add(read_file(profiling.file));
  inputs.push_back({"planner.profiling.file", profiling.file, sha.hex()});
  return inputs;
}

void write_inputs(const fs::path& run, std::span<const RunInput> inputs) {
  Json list = Json::array();
  for (const RunInput& input : inputs) {
    list.push_back({{"key", input.key}, {"name", input.name}, {"sha256", input.sha256}});
  }
  const Json json = {{"schema", 1}, {"version", GNBV_VERSION}, {"inputs", list}};
  write_file_atomically(run / kInputsFile,
                        json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

void need_same_inputs(const fs::path& run, std::span<const RunInput> now,
                      const std::string& advice) {
  const std::map<std::string, std::string> hashes = read_hashes(run / kInputsFile);
  for (const RunInput& input : now) {
    const auto then = hashes.find(input.key);
    if (then == hashes.end() || then->second == input.sha256) continue;
    throw BadInput(fmt::format("{}: {}: {} is not what the run began with: {}",
                               (run / kInputsFile).string(), input.key, input.name, advice));
  }
}

}  // namespace gnbv
