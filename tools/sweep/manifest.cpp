#include "tools/sweep/manifest.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "bench/compare/text_table.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/sweep/source_id.hpp"

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

/// A list with one item a line: readable, and small with many of them.
std::string by_line(const std::vector<Json>& items) {
  std::string text = "[";
  for (const Json& item : items) {
    text += (text.size() == 1 ? "\n  " : ",\n  ") +
            item.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  return text + "\n]";
}

struct Column {
  std::string_view name;
  std::string_view pointer;  // into summary.json
};

constexpr std::array kColumns = {
    Column{"termination", "/termination"},
    Column{"iterations", "/iterations"},
    Column{"straight_m", "/distance_m/straight"},
    Column{"flown_m", "/distance_m/flown"},
    Column{"profile_m", "/distance_m/profile"},
    Column{"flight_time_s", "/flight_time_s"},
    Column{"energy_wh", "/energy_wh"},
    Column{"entropy_reduction_nat", "/entropy_nat/reduction"},
    Column{"coverage_0.05", "/coverage/final/0.05"},
    Column{"coverage_0.10", "/coverage/final/0.10"},
    Column{"coverage_0.50", "/coverage/final/0.50"},
    Column{"coverage_raw_0.05", "/coverage/final_raw_reference/0.05"},
    Column{"coverage_raw_0.10", "/coverage/final_raw_reference/0.10"},
    Column{"coverage_raw_0.50", "/coverage/final_raw_reference/0.50"},
    Column{"coverage_profile_0.05", "/coverage/profile/0.05"},
    Column{"coverage_profile_0.10", "/coverage/profile/0.10"},
    Column{"coverage_profile_0.50", "/coverage/profile/0.50"},
    Column{"density_points_per_voxel", "/density_points_per_voxel"},
    Column{"wall_s", "/wall_s/total"},
    Column{"result_sha256", "/result_sha256"},
};

/// Empty where the summary has no such value.
std::string csv_value(const nlohmann::json& summary, std::string_view pointer) {
  const nlohmann::json::json_pointer place{std::string(pointer)};
  if (!summary.is_object() || !summary.contains(place)) return "";
  const nlohmann::json& value = summary.at(place);
  return value.is_string() ? csv_field(value.get<std::string>()) : value.dump();
}

}  // namespace

std::string_view name_of(CellStatus status) {
  switch (status) {
    case CellStatus::done:
      return "done";
    case CellStatus::failed:
      return "failed";
    case CellStatus::locked:
      return "running";
    case CellStatus::missing:
      return "missing";
  }
  return "";
}

void write_manifest(const fs::path& folder, const fs::path& yaml, std::span<const Cell> cells) {
  std::vector<Json> items;
  for (std::size_t i = 0; i < cells.size(); ++i) items.push_back(described(cells[i], i));
  const auto quoted = [](const std::string& text) {
    return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  std::error_code error;
  fs::create_directories(folder, error);  // a failure is one of the file, too
  write_file_atomically(
      folder / kManifest,
      fmt::format("{{\n\"schema\": 1,\n\"version\": \"{}\",\n\"source_id\": \"{}\",\n\"file\": "
                  "{},\n\"text\": {},\n"
                  "\"cells\": {}\n}}\n",
                  GNBV_VERSION, source_id(), quoted(fs::absolute(yaml).lexically_normal().string()),
                  quoted(read_file(yaml)), by_line(items)));
}

std::optional<ManifestHead> read_manifest_head(const fs::path& folder) {
  std::error_code ignored;
  const fs::path path = folder / kManifest;
  if (!fs::exists(path, ignored)) return std::nullopt;
  try {
    const auto manifest = nlohmann::json::parse(read_file(path));
    ManifestHead head{.file = manifest.at("file").get<std::string>(), .ids = {}};
    for (const auto& cell : manifest.at("cells"))
      head.ids.push_back(cell.at("id").get<std::string>());
    return head;
  } catch (const nlohmann::json::exception& error) {
    throw BadInput(fmt::format("{}: is no manifest of a sweep: {}", path.string(), error.what()));
  }
}

void require_folder_of(const fs::path& folder, const fs::path& yaml) {
  const auto head = read_manifest_head(folder);
  std::error_code ignored;
  const std::string file = fs::absolute(yaml).lexically_normal().string();
  if (!head || head->file == file || fs::equivalent(head->file, file, ignored)) return;
  throw BadInput(
      fmt::format("{}: is of {}, not of {}; --replace makes it the latter's, and the cells stay",
                  (folder / kManifest).string(), head->file, file));
}

std::string results_csv(std::span<const Cell> cells, std::span<const CellOutcome> outcomes) {
  GNBV_CHECK(cells.size() == outcomes.size(), "{} cells, {} outcomes", cells.size(),
             outcomes.size());
  std::string csv = "index,id,scenario,method,seed,status";
  for (const Column& column : kColumns) csv += fmt::format(",{}", column.name);
  csv += '\n';
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& cell = cells[i];
    nlohmann::json summary;
    if (outcomes[i].status == CellStatus::done) {
      const fs::path file = outcomes[i].run / "summary.json";
      summary = nlohmann::json::parse(read_file(file), nullptr, false);
      if (!summary.is_object()) throw BadInput(fmt::format("{}: is no JSON", file.string()));
    }
    csv += fmt::format("{},{},{},{},{},{}", i, cell.id, csv_field(cell.scenario),
                       csv_field(cell.method), cell.seed, name_of(outcomes[i].status));
    for (const Column& column : kColumns) csv += ',' + csv_value(summary, column.pointer);
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
