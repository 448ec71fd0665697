#include "tools/sweep/manifest.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "bench/compare/text_table.hpp"
#include "bench/sources/source_ids.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/separated_text.hpp"
#include "tools/run/summary_json.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kManifest = "sweep.json";

Json described(const Cell& cell, std::size_t index) {
  return {{"index", index},
          {"id", cell.id},
          {"scenario", cell.scenario},
          {"method", cell.method},
          {"seed", cell.seed}};
}

Cell cell_from(const Json& json, const fs::path& manifest) {
  Cell cell;
  json.at("scenario").get_to(cell.scenario);
  json.at("method").get_to(cell.method);
  if (!json.at("seed").is_number_unsigned()) {
    throw BadInput("{}: seed: value '{}': expects a whole number, 0 or more", manifest.string(),
                   json.at("seed").dump());
  }
  json.at("seed").get_to(cell.seed);
  json.at("id").get_to(cell.id);
  return cell;
}

std::string_view name_of(CellStatus status) {
  return kCellStatusNames.at(static_cast<std::size_t>(status));
}

/// On one line; a path need not be UTF-8.
std::string one_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// The whole path, as a manifest has it.
std::string path_in_manifest(const fs::path& yaml) {
  return Json::parse(one_line(fs::absolute(yaml).lexically_normal().string()));
}

/// A list with one item a line: readable, and small with many of them.
std::string by_line(const std::vector<Json>& items) {
  std::string text = "[";
  for (const Json& item : items) {
    text += (text.size() == 1 ? "\n  " : ",\n  ") + one_line(item);
  }
  return text + "\n]";
}

/// The columns of a mission's figures. Numbers as JSON has them, which read back exactly.
std::vector<std::pair<std::string, Json>> columns_of(const RunFigures& f) {
  std::vector<std::pair<std::string, Json>> columns = {
      {"termination", f.termination},    {"iterations", f.iterations},
      {"straight_m", f.straight_m},      {"flown_m", f.flown_m},
      {"profile_m", f.before.profile_m}, {"flight_time_s", f.flight_time_s},
      {"energy_wh", f.energy_wh},        {"entropy_reduction_nat", f.entropy_reduction_nat}};
  const auto add_sizes = [&](const std::string& name, const std::array<double, 3>& coverage) {
    for (std::size_t size = 0; size < 3; ++size) {
      columns.emplace_back(fmt::format("{}_{:.2f}", name, kCoverageSizes_m[size]), coverage[size]);
    }
  };
  add_sizes("coverage", f.coverage_final);
  for (std::size_t size = 0; size < 3; ++size) {
    columns.emplace_back(fmt::format("accurate_{:.2f}", kCoverageSizes_m[size]),
                         f.coverage_accurate ? Json((*f.coverage_accurate)[size]) : Json(""));
  }
  add_sizes("coverage_raw", f.coverage_final_raw);
  add_sizes("coverage_profile", f.coverage_profile);
  columns.emplace_back("density_points_per_voxel", f.density_points_per_voxel);
  columns.emplace_back("wall_s", f.wall_s);
  columns.emplace_back("result_sha256", f.result_sha256);
  return columns;
}

}  // namespace

void write_manifest(const fs::path& folder, const fs::path& yaml, std::span<const Cell> cells) {
  std::vector<Json> items;
  for (std::size_t i = 0; i < cells.size(); ++i) items.push_back(described(cells[i], i));
  std::error_code error;
  fs::create_directories(folder, error);  // a failure is one of the file, too
  write_file_atomically(
      folder / kManifest,
      fmt::format("{{\n\"schema\": 1,\n\"version\": \"{}\",\n\"source_id\": \"{}\",\n\"file\": "
                  "{},\n\"text\": {},\n"
                  "\"cells\": {}\n}}\n",
                  GNBV_VERSION, flying_source_id(), one_line(path_in_manifest(yaml)),
                  one_line(read_file(yaml)), by_line(items)));
}

std::optional<Manifest> read_manifest(const fs::path& folder) {
  std::error_code ignored;
  const fs::path path = folder / kManifest;
  if (!fs::exists(path, ignored)) return std::nullopt;
  Manifest manifest;
  std::set<std::tuple<std::string, std::string, std::uint64_t>> seen;
  try {
    const Json json = Json::parse(read_json_text(path));
    if (json.at("schema") != 1) {
      throw BadInput("{}: schema: value '{}': expects 1", path.string(), json.at("schema").dump());
    }
    manifest.file = json.value("file", "");
    for (const Json& item : json.at("cells")) {
      const Cell& cell = manifest.cells.emplace_back(cell_from(item, path));
      if (seen.insert({cell.scenario, cell.method, cell.seed}).second) continue;
      throw BadInput("{}: two cells of {}, {}, seed {}", path.string(), cell.scenario, cell.method,
                     cell.seed);
    }
  } catch (const Json::exception& error) {
    throw BadInput("{}: is no manifest of a sweep: {}", path.string(), json_reason(error));
  }
  return manifest;
}

std::vector<Cell> cells_of_manifest(const fs::path& folder) {
  const fs::path path = folder / kManifest;
  std::optional<Manifest> manifest = read_manifest(folder);
  if (!manifest) read_file(path);  // throws, with the cause
  if (manifest->cells.empty()) throw BadInput("{}: has no cells", path.string());
  return std::move(manifest->cells);
}

void require_folder_of(const fs::path& folder, const fs::path& yaml) {
  const auto head = read_manifest(folder);
  std::error_code ignored;
  const std::string file = path_in_manifest(yaml);
  if (!head || head->file == file || fs::equivalent(head->file, file, ignored)) return;
  throw BadInput("{}: is of {}, not of {}; --replace takes it for the latter, and its cells stay",
                 (folder / kManifest).string(), head->file, file);
}

std::string results_csv(std::span<const Cell> cells, std::span<const CellOutcome> outcomes) {
  GNBV_CHECK(cells.size() == outcomes.size(), "{} cells, {} outcomes", cells.size(),
             outcomes.size());
  std::string csv = "index,id,scenario,method,seed,status";
  const auto names = columns_of({});
  for (const auto& [name, value] : names) csv += ',' + name;
  csv += '\n';
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& cell = cells[i];
    csv += fmt::format("{},{},{},{},{},{}", i, cell.id, csv_field(cell.scenario),
                       csv_field(cell.method), cell.seed, name_of(outcomes[i].status));
    if (outcomes[i].status != CellStatus::done) {
      csv.append(names.size(), ',');
    } else {
      for (const auto& [name, value] : columns_of(read_run_figures(outcomes[i].run))) {
        csv += ',' + (value.is_string() ? csv_field(value.get<std::string>()) : value.dump());
      }
    }
    csv += '\n';
  }
  return csv;
}

std::string cells_json(std::span<const Cell> cells, std::span<const CellOutcome> outcomes) {
  std::vector<Json> items;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Json item = described(cells[i], i);
    if (i < outcomes.size()) {
      item["status"] = name_of(outcomes[i].status);
      if (outcomes[i].status == CellStatus::done) item["run"] = outcomes[i].run.string();
      if (outcomes[i].status == CellStatus::failed) item["failure"] = outcomes[i].failure;
    }
    items.push_back(std::move(item));
  }
  return by_line(items) + "\n";
}

}  // namespace gnbv
