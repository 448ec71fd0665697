#include "tools/run/run_inputs.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/score/content_cache.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// What cameras see of it beside its shape, where it has pictures or colours of corners.
void add_looks(Sha256& sha, const TriangleMesh& mesh) {
  if (mesh.face_looks.empty()) return;
  static_assert(sizeof(CornerLook) == 12);
  sha.add_bytes(std::as_bytes(std::span(mesh.face_looks)));
  sha.add(std::span<const std::uint16_t>(mesh.face_material));
  for (const Material& material : mesh.materials) {
    sha.add(std::span<const float>(material.rgb));
    for (const Wrap wrap : material.texture.wrap) sha.add(static_cast<std::uint8_t>(wrap));
    if (!material.texture.image) continue;
    sha.add(material.texture.image->width_px);
    sha.add(std::span<const std::uint8_t>(material.texture.image->rgb));
  }
}

RunInput mesh_input(const char* key, const std::string& name, const TriangleMesh& mesh) {
  Sha256 sha;
  add_mesh(sha, mesh);
  add_looks(sha, mesh);
  return {key, name, sha.hex()};
}

}  // namespace

std::vector<RunInput> world_inputs(const Scenario& scenario, const World& world) {
  std::vector<RunInput> inputs = {
      mesh_input("structure", structure_name(scenario.structure), world.structure)};
  TriangleMesh obstacles = world.obstacles;
  for (const MovingBody& mover : world.movers) append(obstacles, mover.mesh);
  if (!obstacles.faces.empty()) {
    const std::string name = fmt::format("{} obstacles", scenario.obstacles.size());
    inputs.push_back(mesh_input("obstacles", name, obstacles));
  }
  if (!world.terrain.faces.empty()) {
    inputs.push_back(mesh_input("terrain", scenario.terrain.path, world.terrain));
  }
  return inputs;
}

std::vector<RunInput> run_inputs(const Scenario& scenario, const World& world) {
  std::vector<RunInput> inputs = world_inputs(scenario, world);
  const ProfilingConfig& profiling = scenario.planner.profiling;
  if (profiling.method != ProfilingMethod::saved) return inputs;
  inputs.push_back(
      {"planner.profiling.file", profiling.file, sha256_of(read_file(profiling.file))});
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

std::vector<RunInput> read_inputs(const fs::path& run) {
  std::vector<RunInput> inputs;
  const fs::path path = run / kInputsFile;
  if (!fs::exists(path)) return inputs;
  try {
    const Json json = Json::parse(read_json_text(path));
    for (const Json& input : json.at("inputs")) {
      inputs.push_back({input.at("key"), input.at("name"), input.at("sha256")});
    }
  } catch (const Json::exception& error) {
    throw BadInput("{}: {}", path.string(), json_reason(error));
  }
  return inputs;
}

void need_same_inputs(const fs::path& run, std::span<const RunInput> now,
                      const std::string& advice) {
  const std::vector<RunInput> began = read_inputs(run);
  for (const RunInput& input : now) {
    const auto then = std::ranges::find(began, input.key, &RunInput::key);
    if (then == began.end() || then->sha256 == input.sha256) continue;
    throw BadInput("{}: {}: {} is not what the run began with: {}", (run / kInputsFile).string(),
                   input.key, input.name, advice);
  }
}

}  // namespace gnbv
