#include "bench/compare/paper_figures.hpp"

#include <algorithm>
#include <filesystem>

#include "sim/core/file.hpp"
#include "sim/core/sha256.hpp"

namespace gnbv {
namespace {

using Percents = std::array<double, 3>;

// Almadhoun et al. 2019. The densities of Table 3 are in the text above it.
// utility, label, iterations, entropy reduction, distance (m), time (min), coverage (%), density
constexpr std::array<PaperRow, 3> kAircraftRows = {{
    {"bircher", "Bircher [17]", 577, 10504, 1347.6, {}, Percents{86.5, 93.9, 98.8}},
    {"isler", "Isler [29]", 585, 10846, 1500.9, {}, Percents{85.1, 92.0, 98.5}},
    {"proposed", "Proposed", 635, 10970, 1396.5, {}, Percents{94.1, 97.2, 99.8}},
}};
constexpr PaperRow kAircraftProfile = {
    "", "Profile", {}, {}, 370.0, {}, Percents{15.3, 63.9, 87.3}};

constexpr std::array<PaperRow, 3> kPowerPlantRows = {{
    {"bircher", "Bircher [17]", 162, 14574, 479.5, {}, Percents{95.9, 87.0, 98.5}, 140},
    {"isler", "Isler [29]", 360, 24425, 945.4, {}, Percents{95.7, 86.3, 98.1}, 152},
    {"proposed", "Proposed", 210, 23983, 469.5, {}, Percents{97.5, 93.6, 98.9}, 177},
}};
constexpr PaperRow kPowerPlantProfile = {
    "", "Profile", {}, {}, 512.0, {}, Percents{15.1, 69.5, 86.3}};

constexpr std::array<PaperRow, 1> kLabModelRows = {
    {{"proposed", "Proposed", 40, 30140, 32.0, 8.0, {}, 33}}};
constexpr std::array<PaperRow, 1> kLabAirplaneRows = {
    {{"proposed", "Proposed", 60, 28949, 55.4, 15.0, {}, 45}}};

constexpr std::array<PaperTable, 4> kPaperTables = {{
    {"aircraft", "Table 2, Scenario 1 (aircraft)", kAircraftRows, kAircraftProfile,
     "8dfa91604a7da02bd76885312613698895d9c2f9926b68a2810eba5777f1fafb"},
    {"power_plant", "Table 3, Scenario 2 (power plant)", kPowerPlantRows, kPowerPlantProfile,
     "0a12ac4c8fd6868540ddd1e9437fc563393f2baccfee7cca76180e6e7f598d13"},
    {"lab_model", "Section 3.2.2, Scenario 3 (lab model)", kLabModelRows},
    {"lab_airplane", "Section 3.2.2, Scenario 4 (lab airplane)", kLabAirplaneRows},
}};

}  // namespace

std::span<const PaperTable> paper_tables() { return kPaperTables; }

const PaperTable* find_paper_table(std::string_view scenario) {
  const auto table = std::find_if(kPaperTables.begin(), kPaperTables.end(),
                                  [&](const PaperTable& t) { return t.scenario == scenario; });
  return table == kPaperTables.end() ? nullptr : &*table;
}

const PaperRow* find_row(const PaperTable& paper, std::string_view utility) {
  const auto row = std::find_if(paper.rows.begin(), paper.rows.end(),
                                [&](const PaperRow& r) { return r.utility == utility; });
  return row == paper.rows.end() ? nullptr : &*row;
}

std::string name_in_table(const PaperTable& paper, const std::string& utility) {
  if (const PaperRow* const row = find_row(paper, utility)) return std::string(row->label);
  if (utility == "tour") return "Tour";
  if (utility == "oracle_views") return "Oracle, few views";
  if (utility == "oracle_metres") return "Oracle, few metres";
  return utility == "oracle_seconds" ? "Oracle, few seconds" : utility;
}

std::optional<std::string> formulas_note(std::span<const std::string> names) {
  for (const std::string& name : names) {  // bircher, Bircher [17], planner.utility.name=isler
    if (name.find("ircher") == std::string::npos && name.find("sler") == std::string::npos)
      continue;
    return "Bircher [17] and Isler [29] are the gain formulas of those papers in this paper's "
           "sampler, not their planners";
  }
  return std::nullopt;
}

bool is_doubtful(const PaperRow& row) {
  return row.coverage_percent && (*row.coverage_percent)[0] > (*row.coverage_percent)[1];
}

bool is_papers_structure(const PaperTable& paper, std::string_view structure) {
  if (structure == paper.scenario) return true;
  const std::filesystem::path file(structure);
  std::error_code ignored;
  if (paper.mesh_sha256.empty() || !std::filesystem::is_regular_file(file, ignored)) return false;
  return sha256_of(read_file(file)) == paper.mesh_sha256;
}

}  // namespace gnbv
