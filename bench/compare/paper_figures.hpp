// What the paper printed: its result tables and the figures in its text, as data.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace gnbv {

/// One row as printed, with the paper's rounding; empty where it prints nothing.
struct PaperRow {
  std::string_view utility;  // our name of it; empty for the profile
  std::string_view label;    // as the paper names it
  std::optional<int> iterations = {};
  std::optional<double> entropy_reduction = {};  // unit not printed
  std::optional<double> distance_m = {};         // without the profile: see Table 3's Proposed
  std::optional<double> time_min = {};           // in which the path was generated
  std::optional<std::array<double, 3>> coverage_percent = {};  // at 0.05, 0.10 and 0.50 m
  std::optional<double> density_points_per_voxel = {};
};

struct PaperTable {
  std::string_view scenario;  // name of our scenario, and of the structure built in for it
  std::string_view source;
  std::span<const PaperRow> rows;  // in the paper's order
  std::optional<PaperRow> profile = {};
  std::string_view mesh_sha256 =
      {};  // of a file that holds the paper's own structure; may be empty
};

/// Tables 2 (aircraft) and 3 (power_plant), and section 3.2.2 (lab_model, lab_airplane).
std::span<const PaperTable> paper_tables();

/// The table of a scenario, if the paper has one.
const PaperTable* find_paper_table(std::string_view scenario);

/// The row of a utility, if the table has one.
const PaperRow* find_row(const PaperTable& paper, std::string_view utility);

/// What tables call a utility: as the paper does, or by our own words.
std::string name_in_table(const PaperTable& paper, const std::string& utility);

/// What rows are not that these names make of one; nothing where none is named after another paper.
std::optional<std::string> formulas_note(std::span<const std::string> names);

/// Why a run of a scenario of the paper's does not stand beside it.
constexpr std::string_view kOtherSetting =
    "ours has other sensors, views, resolution, profile or room than the paper's";

/// More coverage at 0.05 m than at 0.10 m: by the paper's own definition hardly possible, since a
/// coarse voxel is covered when one of the fine ones in it is. So in Table 3, but for its profile.
bool is_doubtful(const PaperRow& row);

/// Whether a structure (built-in name or path, as RunFigures has it) is the one the paper's figures
/// are of: the scenario's own, or a file known to hold the paper's.
bool is_papers_structure(const PaperTable& paper, std::string_view structure);

}  // namespace gnbv
