#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "sim/core/error.hpp"
#include "tools/run/decision_lines.hpp"
#include "tools/run/file_names.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::array<std::pair<const char*, VoxelRuns BelievedVoxels::*>, 4> kLists = {
    {{"unknown", &BelievedVoxels::unknown},
     {"predicted", &BelievedVoxels::predicted},
     {"frontier", &BelievedVoxels::frontier},
     {"looked_at", &BelievedVoxels::looked_at}}};

Json json_of(const VoxelRuns& runs) {
  Json json = Json::array();
  VoxelIndex end = 0;
  for (const VoxelRun& run : runs) {
    json.push_back(run.first - end);
    json.push_back(run.length);
    end = run.first + run.length;
  }
  return json;
}

VoxelRuns runs_of(const Json& json, std::size_t voxels) {
  const bool is_list =
      json.is_array() && json.size() % 2 == 0 &&
      std::ranges::all_of(json, [](const Json& n) { return n.is_number_unsigned(); });
  if (!is_list) throw BadInput("is no list of gaps and lengths, which are whole numbers");
  VoxelRuns runs;
  std::uint64_t end = 0;
  for (std::size_t i = 0; i < json.size(); i += 2) {
    const auto gap = json[i].get<std::uint64_t>();
    const auto length = json[i + 1].get<std::uint64_t>();
    if (gap > voxels || length > voxels || end + gap + length > voxels) {
      throw BadInput("runs end beyond the {} voxels of the map", voxels);
    }
    if (length == 0 || (gap == 0 && i > 0)) throw BadInput("runs are longer, and apart");
    runs.push_back({static_cast<VoxelIndex>(end + gap), static_cast<std::uint32_t>(length)});
    end += gap + length;
  }
  return runs;
}

}  // namespace

VoxelRuns runs_of(std::span<const VoxelIndex> voxels) {
  VoxelRuns runs;
  for (const VoxelIndex v : voxels) {
    if (runs.empty() || v != runs.back().first + runs.back().length) runs.push_back({v, 0});
    ++runs.back().length;
  }
  return runs;
}

std::size_t voxel_count(const VoxelRuns& runs) {
  std::size_t count = 0;
  for (const VoxelRun& run : runs) count += run.length;
  return count;
}

BeliefsFile::BeliefsFile(const fs::path& folder, std::size_t first_iteration)
    : DecisionLines(folder / kBeliefsFile,
                    lines_before(first_iteration, folder, kBeliefsFile).text) {}

void BeliefsFile::write(std::size_t iteration, const BelievedVoxels& voxels) {
  Json json = {{"iteration", iteration}};
  for (const auto& [name, list] : kLists) {
    if (!(voxels.*list).empty()) json[name] = json_of(voxels.*list);
  }
  write_lines(json.dump() + '\n');
}

std::vector<BelievedVoxels> read_beliefs(const fs::path& run, std::size_t iterations,
                                         std::size_t voxels) {
  std::vector<BelievedVoxels> all(iterations);
  const bool has_lines =
      read_decision_lines(run, kBeliefsFile, iterations, "",
                          [&](std::size_t iteration, const Json& json, std::string_view) {
                            for (const auto& [name, list] : kLists) {
                              if (json.contains(name))
                                all[iteration].*list = runs_of(json.at(name), voxels);
                            }
                          });
  return has_lines ? all : std::vector<BelievedVoxels>{};
}

}  // namespace gnbv
