#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "bench/compare/text_table.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/separated_text.hpp"
#include "tools/sweep/bench_runs.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// The columns of words, before those of figures; the seed stands behind the setting.
constexpr std::array<std::pair<const char*, std::string MissionRow::*>, 10> kWords = {
    {{"id", &MissionRow::id},
     {"scenario", &MissionRow::scenario},
     {"structure", &MissionRow::structure},
     {"structure_sha256", &MissionRow::structure_sha256},
     {"method", &MissionRow::method},
     {"setting", &MissionRow::setting},
     {"commit", &MissionRow::commit},
     {"program", &MissionRow::program},
     {"termination", &MissionRow::termination},
     {"result_sha256", &MissionRow::result_sha256}}};
constexpr const char* kSeed = "seed";

/// A field of a row, by its column's name.
void take_field(const std::string& column, const std::string& text, const TextPlace& place,
                MissionRow& row) {
  const auto* const word = std::ranges::find(kWords, column, [](const auto& w) { return w.first; });
  if (word != kWords.end()) {
    row.*word->second = text;
  } else if (column == kSeed) {
    const char* const end = text.data() + text.size();
    if (std::from_chars(text.data(), end, row.seed) != std::from_chars_result{end, {}}) {
      throw BadInput("{}: {}: '{}' is no seed", to_string(place), column, text);
    }
  } else if (text == "inf") {
    row.figures[column] = std::numeric_limits<double>::infinity();
  } else if (!text.empty()) {
    row.figures[column] = to_number(text, place, column);
  }
}

}  // namespace

std::string missions_csv(std::span<const MissionRow> missions) {
  std::set<std::string> figures;
  for (const MissionRow& row : missions) {
    for (const auto& [name, value] : row.figures) figures.insert(name);
  }
  std::string csv;
  for (const auto& [name, word] : kWords) csv += fmt::format("{},", name);
  csv += kSeed;
  for (const std::string& name : figures) csv += ',' + name;
  csv += '\n';
  for (const MissionRow& row : missions) {
    for (const auto& [name, word] : kWords) {
      const bool is_path = word == &MissionRow::structure;
      csv += csv_field(is_path ? fs::path(row.*word).filename().string() : row.*word) + ',';
    }
    csv += std::to_string(row.seed);
    for (const std::string& name : figures) {
      const auto value = row.find(name);
      csv += value ? fmt::format(",{}", *value) : ",";
    }
    csv += '\n';
  }
  return csv;
}

std::vector<MissionRow> read_missions(const fs::path& csv) {
  std::vector<MissionRow> missions;
  std::vector<std::string> columns;
  std::set<std::tuple<std::string, std::string, std::string, std::uint64_t>> seen;
  for_each_line(read_file(csv), csv, [&](std::string_view line, const TextPlace& place) {
    if (columns.empty()) {
      columns = csv_fields(trimmed(line));
      for (const auto& [name, word] : kWords) {
        if (std::ranges::count(columns, name) == 1) continue;
        throw BadInput("{}: has no column '{}': no file of missions", to_string(place), name);
      }
      return;
    }
    const std::vector<std::string> fields = csv_fields(line);
    if (fields.size() != columns.size()) {
      throw BadInput("{}: {} fields of {} columns", to_string(place), fields.size(),
                     columns.size());
    }
    MissionRow& row = missions.emplace_back();
    for (std::size_t i = 0; i < fields.size(); ++i) take_field(columns[i], fields[i], place, row);
    if (seen.insert({row.scenario, row.method, row.setting, row.seed}).second) return;
    throw BadInput("{}: a second row of {}, {}, seed {}", to_string(place), row.scenario,
                   row.method, row.seed);
  });
  if (missions.empty()) throw BadInput("{}: holds no missions", csv.string());
  return missions;
}

}  // namespace gnbv
