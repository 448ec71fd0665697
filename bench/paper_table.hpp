// The paper's result tables as data, a mission's figures, and both side by side as text.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnbv {

/// One row of Table 2 or 3 as printed. Coverage in percent at 0.05, 0.10 and 0.50 m.
struct PaperRow {
  std::string_view profiling;  // "Yes", or "Profile" for the row of the profile itself
  std::string_view utility;    // our name of it; empty for the profile
  std::string_view label;      // as the paper names it
  std::optional<int> iterations;
  std::optional<double> entropy_reduction;  // unit not printed
  double distance_m = 0.0;  // without the profile: Proposed of Table 3 is below its profile
  std::array<double, 3> coverage_percent{};
  std::optional<double> density_points_per_voxel;  // section 3.1.2, text
};

struct PaperTable {
  std::string_view scenario;  // name of our scenario
  std::string_view source;
  std::array<PaperRow, 3> rows;  // in the paper's order
  PaperRow profile;
  std::string_view remark;  // what is odd about the printed figures; may be empty
};

/// Tables 2 (aircraft) and 3 (power_plant), the paper's simulated scenarios.
std::span<const PaperTable> paper_tables();

/// The table of a scenario, if the paper has one.
const PaperTable* find_paper_table(std::string_view scenario);

/// What one mission reached. Coverage as fractions at 0.05, 0.10 and 0.50 m.
struct MissionFigures {
  std::string utility;
  std::string termination;
  int iterations = 0;
  double entropy_reduction_nat = 0.0;
  double straight_m = 0.0;  // between consecutive views, without the profile
  double flown_m = 0.0;     // the same as the vehicle flew it
  double profile_m = 0.0;
  std::array<double, 3> coverage_final{};      // of the surface seen from outside
  std::array<double, 3> coverage_profile{};    // the same, after the profile
  std::array<double, 3> coverage_final_raw{};  // of all surface
  double density_points_per_voxel = 0.0;
  double wall_s = 0.0;
};

/// Cells without form: what every renderer (terminal, Markdown, ...) takes.
struct TextTable {
  std::string title;
  std::vector<std::string> header;
  std::vector<bool> right;  // column by column: align right
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> notes;
};

/// Ours beside the paper's: per utility a row of each mission and the paper's row, in the paper's
/// order, then utilities the paper lacks, then the profile. Distances are straight_m.
TextTable comparison_table(const PaperTable& paper, std::span<const MissionFigures> missions);

/// Aligned columns for a terminal; ends with a line feed.
std::string terminal_text(const TextTable& table);

/// The same as Markdown.
std::string markdown_text(const TextTable& table);

/// The mission's row and, where the paper has one for this scenario and utility, the paper's, as a
/// small aligned table.
std::string one_row_summary(std::string_view scenario, const MissionFigures& mission);

}  // namespace gnbv
