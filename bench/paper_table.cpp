#include "bench/paper_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

// Almadhoun et al. 2019, Tables 2 and 3; the densities are in the text above Table 3. Figures as
// printed, with the paper's rounding.
constexpr std::array<PaperTable, 2> kPaperTables = {{
    {"aircraft",
     "Table 2, Scenario 1 (aircraft)",
     {{{"Yes", "bircher", "Bircher [17]", 577, 10504, 1347.6, {86.5, 93.9, 98.8}, {}},
       {"Yes", "isler", "Isler [29]", 585, 10846, 1500.9, {85.1, 92.0, 98.5}, {}},
       {"Yes", "proposed", "Proposed", 635, 10970, 1396.5, {94.1, 97.2, 99.8}, {}}}},
     {"Profile", "", "", {}, {}, 370.0, {15.3, 63.9, 87.3}, {}},
     ""},
    {"power_plant",
     "Table 3, Scenario 2 (power plant)",
     {{{"Yes", "bircher", "Bircher [17]", 162, 14574, 479.5, {95.9, 87.0, 98.5}, 140},
       {"Yes", "isler", "Isler [29]", 360, 24425, 945.4, {95.7, 86.3, 98.1}, 152},
       {"Yes", "proposed", "Proposed", 210, 23983, 469.5, {97.5, 93.6, 98.9}, 177}}},
     {"Profile", "", "", {}, {}, 512.0, {15.1, 69.5, 86.3}, {}},
     "The paper prints more coverage at 0.05 m than at 0.10 m; by its own definition that is "
     "hardly possible. Shown as printed."},
}};

// 10970 -> "10,970", as the paper prints it.
std::string grouped(double value) {
  std::string digits = fmt::format("{:.0f}", std::abs(value));
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return std::round(value) < 0.0 ? "-" + digits : digits;
}

std::string percent(double value_percent) { return fmt::format("{:.1f}%", value_percent); }
std::string metres(double value_m) { return fmt::format("{:.1f}", value_m); }

std::string three_percent(const std::array<double, 3>& fractions) {
  return fmt::format("{:.1f} / {:.1f} / {:.1f} %", 100.0 * fractions[0], 100.0 * fractions[1],
                     100.0 * fractions[2]);
}

using Cells = std::vector<std::string>;

void add_coverage(Cells& cells, const std::array<double, 3>& values, double factor) {
  for (const double value : values) cells.push_back(percent(factor * value));
}

Cells paper_cells(const PaperRow& row) {
  Cells cells = {std::string(row.profiling),
                 row.label.empty() ? "-" : std::string(row.label),
                 "paper",
                 row.iterations ? std::to_string(*row.iterations) : "-",
                 row.entropy_reduction ? grouped(*row.entropy_reduction) : "-",
                 metres(row.distance_m)};
  add_coverage(cells, row.coverage_percent, 1.0);
  return cells;
}

Cells our_cells(const MissionFigures& mission, std::string_view label) {
  Cells cells = {"Yes",
                 std::string(label),
                 "ours",
                 std::to_string(mission.iterations),
                 grouped(mission.entropy_reduction_nat),
                 metres(mission.straight_m)};
  add_coverage(cells, mission.coverage_final, 100.0);
  return cells;
}

Cells our_profile_cells(const MissionFigures& mission) {
  Cells cells = {"Profile", "-", "ours", "-", "-", metres(mission.profile_m)};
  add_coverage(cells, mission.coverage_profile, 100.0);
  return cells;
}

const PaperRow* find_row(const PaperTable& paper, std::string_view utility) {
  const auto row = std::find_if(paper.rows.begin(), paper.rows.end(),
                                [&](const PaperRow& r) { return r.utility == utility; });
  return row == paper.rows.end() ? nullptr : &*row;
}

std::string mission_note(const MissionFigures& m) {
  return fmt::format(
      "{}: ended by {} after {} views; flown {} m; {:.0f} points/voxel; all surface, also inner: "
      "{}; "
      "{:.1f} s",
      m.utility, m.termination, m.iterations, metres(m.flown_m), m.density_points_per_voxel,
      three_percent(m.coverage_final_raw), m.wall_s);
}

// Width on a terminal of UTF-8 text: its code points.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

std::vector<std::size_t> column_widths(const TextTable& table) {
  std::vector<std::size_t> widths;
  for (const std::string& name : table.header) widths.push_back(width_of(name));
  GNBV_CHECK(table.right.size() == widths.size(), "{} alignments for {} columns",
             table.right.size(), widths.size());
  for (const Cells& row : table.rows) {
    GNBV_CHECK(row.size() == widths.size(), "{} cells in {} columns", row.size(), widths.size());
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width_of(row[c]));
  }
  return widths;
}

std::string padded(std::string_view text, std::size_t width, bool right) {
  const std::string fill(width - width_of(text), ' ');
  return right ? fill + std::string(text) : std::string(text) + fill;
}

std::string joined(const Cells& cells, const TextTable& table,
                   const std::vector<std::size_t>& widths, std::string_view separator) {
  std::string line;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (c > 0) line += separator;
    line += padded(cells[c], widths[c], table.right[c]);
  }
  return line;
}

std::string without_trailing_blanks(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

std::string markdown_escaped(std::string text) {
  for (std::size_t i = text.find('|'); i != std::string::npos; i = text.find('|', i + 2)) {
    text.insert(i, "\\");
  }
  return text;
}

}  // namespace

std::span<const PaperTable> paper_tables() { return kPaperTables; }

const PaperTable* find_paper_table(std::string_view scenario) {
  const auto table = std::find_if(kPaperTables.begin(), kPaperTables.end(),
                                  [&](const PaperTable& t) { return t.scenario == scenario; });
  return table == kPaperTables.end() ? nullptr : &*table;
}

TextTable comparison_table(const PaperTable& paper, std::span<const MissionFigures> missions) {
  TextTable table;
  table.title = std::string(paper.source);
  table.header = {"Profiling",    "Utility", "Row",    "Iterations", "Entropy reduction",
                  "Distance (m)", "0.05 m",  "0.10 m", "0.50 m"};
  table.right = {false, false, false, true, true, true, true, true, true};
  for (const PaperRow& row : paper.rows) {
    for (const MissionFigures& m : missions) {
      if (m.utility == row.utility) table.rows.push_back(our_cells(m, row.label));
    }
    table.rows.push_back(paper_cells(row));
  }
  std::set<Cells> profiles;  // missions of one scenario usually share theirs
  std::vector<Cells> profile_rows;
  for (const MissionFigures& m : missions) {
    if (find_row(paper, m.utility) == nullptr) table.rows.push_back(our_cells(m, m.utility));
    const Cells profile = our_profile_cells(m);
    if (profiles.insert(profile).second) profile_rows.push_back(profile);
  }
  table.rows.insert(table.rows.end(), profile_rows.begin(), profile_rows.end());
  table.rows.push_back(paper_cells(paper.profile));

  table.notes.push_back(
      "0.05, 0.10, 0.50 m: coverage at that voxel size, ours of the surface seen from outside");
  table.notes.push_back(
      "ours: entropy reduction in nat; distance in straight lines between views, profile apart");
  for (const MissionFigures& m : missions) table.notes.push_back(mission_note(m));
  for (const PaperRow& row : paper.rows) {
    if (!row.density_points_per_voxel) continue;
    table.notes.push_back(
        fmt::format("{}, paper: {:.0f} points/voxel", row.utility, *row.density_points_per_voxel));
  }
  if (!paper.remark.empty()) table.notes.emplace_back(paper.remark);
  return table;
}

std::string terminal_text(const TextTable& table) {
  const std::vector<std::size_t> widths = column_widths(table);
  std::string text;
  if (!table.title.empty()) text += table.title + "\n";
  const std::string header = joined(table.header, table, widths, "  ");
  text += without_trailing_blanks(header) + "\n" + std::string(width_of(header), '-') + "\n";
  for (const Cells& row : table.rows) {
    text += without_trailing_blanks(joined(row, table, widths, "  ")) + "\n";
  }
  for (const std::string& note : table.notes) text += note + "\n";
  return text;
}

std::string markdown_text(const TextTable& table) {
  TextTable escaped = table;
  for (std::string& cell : escaped.header) cell = markdown_escaped(cell);
  for (Cells& row : escaped.rows) {
    for (std::string& cell : row) cell = markdown_escaped(cell);
  }
  std::vector<std::size_t> widths = column_widths(escaped);
  std::string rule = "|";
  for (std::size_t c = 0; c < widths.size(); ++c) {
    widths[c] = std::max<std::size_t>(widths[c], 3);
    rule += " " + std::string(widths[c] - 1, '-') + (table.right[c] ? ":" : "-") + " |";
  }
  std::string text = table.title.empty() ? "" : "**" + table.title + "**\n\n";
  text += "| " + joined(escaped.header, escaped, widths, " | ") + " |\n" + rule + "\n";
  for (const Cells& row : escaped.rows) {
    text += "| " + joined(row, escaped, widths, " | ") + " |\n";
  }
  if (!table.notes.empty()) text += "\n";
  for (const std::string& note : table.notes) text += "- " + note + "\n";
  return text;
}

std::string one_row_summary(std::string_view scenario, const MissionFigures& mission) {
  const PaperTable* paper = find_paper_table(scenario);
  const PaperRow* row = paper == nullptr ? nullptr : find_row(*paper, mission.utility);
  TextTable table;
  table.header = {"",
                  "Utility",
                  "Iterations",
                  "Entropy reduction",
                  "Distance (m)",
                  "Cov. 0.05 m",
                  "Cov. 0.10 m",
                  "Cov. 0.50 m"};
  table.right = {false, false, true, true, true, true, true, true};
  const auto add = [&](Cells cells) {
    const std::string who = cells[2];
    cells.erase(cells.begin(), cells.begin() + 3);
    cells.insert(cells.begin(), {who, mission.utility});
    table.rows.push_back(std::move(cells));
  };
  add(our_cells(mission, mission.utility));
  if (row != nullptr) add(paper_cells(*row));
  table.notes.push_back(mission_note(mission));
  return terminal_text(table);
}

}  // namespace gnbv
