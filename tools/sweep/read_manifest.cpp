#include "tools/sweep/read_manifest.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::json;

Cell cell_from(const Json& json, const std::filesystem::path& manifest) {
  Cell cell;
  json.at("scenario").get_to(cell.scenario);
  json.at("method").get_to(cell.method);
  if (!json.at("seed").is_number_unsigned()) {
    throw BadInput(fmt::format("{}: seed: value '{}': expects a whole number, 0 or more",
                               manifest.string(), json.at("seed").dump()));
  }
  json.at("seed").get_to(cell.seed);
  json.at("id").get_to(cell.id);
  return cell;
}

}  // namespace

std::vector<Cell> cells_of_manifest(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "sweep.json";
  std::vector<Cell> cells;
  std::set<std::tuple<std::string, std::string, std::uint64_t>> seen;
  try {
    const Json manifest = Json::parse(read_file(path));
    if (manifest.at("schema") != 1) {
      throw BadInput(fmt::format("{}: schema: value '{}': expects 1", path.string(),
                                 manifest.at("schema").dump()));
    }
    for (const Json& json : manifest.at("cells")) {
      cells.push_back(cell_from(json, path));
      const Cell& cell = cells.back();
      if (!seen.insert({cell.scenario, cell.method, cell.seed}).second) {
        throw BadInput(fmt::format("{}: two cells of {}, {}, seed {}", path.string(), cell.scenario,
                                   cell.method, cell.seed));
      }
    }
  } catch (const Json::exception& error) {
    throw BadInput(fmt::format("{}: is no manifest of a sweep: {}", path.string(), error.what()));
  }
  if (cells.empty()) throw BadInput(fmt::format("{}: has no cells", path.string()));
  return cells;
}

}  // namespace gnbv
