#include "bench/compare/paper_figures.hpp"

#include <algorithm>
#include <filesystem>
#include <string>

#include "sim/core/file.hpp"
#include "sim/core/sha256.hpp"

namespace gnbv {
namespace {

using Percents = std::array<double, 3>;

// Almadhoun et al. 2019. The densities of Table 3 are in the text above it.
constexpr std::array<PaperRow, 3> kAircraftRows = {{
    {.utility = "bircher",
     .label = "Bircher [17]",
     .iterations = 577,
     .entropy_reduction = 10504,
     .distance_m = 1347.6,
     .coverage_percent = Percents{86.5, 93.9, 98.8}},
    {.utility = "isler",
     .label = "Isler [29]",
     .iterations = 585,
     .entropy_reduction = 10846,
     .distance_m = 1500.9,
     .coverage_percent = Percents{85.1, 92.0, 98.5}},
    {.utility = "proposed",
     .label = "Proposed",
     .iterations = 635,
     .entropy_reduction = 10970,
     .distance_m = 1396.5,
     .coverage_percent = Percents{94.1, 97.2, 99.8}},
}};

constexpr std::array<PaperRow, 3> kPowerPlantRows = {{
    {.utility = "bircher",
     .label = "Bircher [17]",
     .iterations = 162,
     .entropy_reduction = 14574,
     .distance_m = 479.5,
     .coverage_percent = Percents{95.9, 87.0, 98.5},
     .density_points_per_voxel = 140},
    {.utility = "isler",
     .label = "Isler [29]",
     .iterations = 360,
     .entropy_reduction = 24425,
     .distance_m = 945.4,
     .coverage_percent = Percents{95.7, 86.3, 98.1},
     .density_points_per_voxel = 152},
    {.utility = "proposed",
     .label = "Proposed",
     .iterations = 210,
     .entropy_reduction = 23983,
     .distance_m = 469.5,
     .coverage_percent = Percents{97.5, 93.6, 98.9},
     .density_points_per_voxel = 177},
}};

constexpr std::array<PaperRow, 1> kLabModelRows = {{
    {.utility = "proposed",
     .label = "Proposed",
     .iterations = 40,
     .entropy_reduction = 30140,
     .distance_m = 32.0,
     .time_min = 8.0,
     .density_points_per_voxel = 33},
}};

constexpr std::array<PaperRow, 1> kLabAirplaneRows = {{
    {.utility = "proposed",
     .label = "Proposed",
     .iterations = 60,
     .entropy_reduction = 28949,
     .distance_m = 55.4,
     .time_min = 15.0,
     .density_points_per_voxel = 45},
}};

constexpr std::array<PaperTable, 4> kPaperTables = {{
    {.scenario = "aircraft",
     .source = "Table 2, Scenario 1 (aircraft)",
     .rows = kAircraftRows,
     .profile = PaperRow{.utility = "",
                         .label = "Profile",
                         .distance_m = 370.0,
                         .coverage_percent = Percents{15.3, 63.9, 87.3}},
     .mesh_sha256 = "8dfa91604a7da02bd76885312613698895d9c2f9926b68a2810eba5777f1fafb"},
    {.scenario = "power_plant",
     .source = "Table 3, Scenario 2 (power plant)",
     .rows = kPowerPlantRows,
     .profile = PaperRow{.utility = "",
                         .label = "Profile",
                         .distance_m = 512.0,
                         .coverage_percent = Percents{15.1, 69.5, 86.3}},
     .mesh_sha256 = "0a12ac4c8fd6868540ddd1e9437fc563393f2baccfee7cca76180e6e7f598d13"},
    {.scenario = "lab_model",
     .source = "Section 3.2.2, Scenario 3 (lab model)",
     .rows = kLabModelRows,
     .profile = {},
     .mesh_sha256 = ""},
    {.scenario = "lab_airplane",
     .source = "Section 3.2.2, Scenario 4 (lab airplane)",
     .rows = kLabAirplaneRows,
     .profile = {},
     .mesh_sha256 = ""},
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

bool is_doubtful(const PaperRow& row) {
  return row.coverage_percent && (*row.coverage_percent)[0] > (*row.coverage_percent)[1];
}

bool is_papers_structure(const PaperTable& paper, std::string_view structure) {
  if (structure == paper.scenario) return true;
  const std::filesystem::path file(structure);
  std::error_code ignored;
  if (paper.mesh_sha256.empty() || !std::filesystem::is_regular_file(file, ignored)) return false;
  Sha256 hash;
  hash.add(std::string_view(read_file(file)));
  return hash.hex() == paper.mesh_sha256;
}

}  // namespace gnbv
