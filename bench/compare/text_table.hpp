// Tables as data, and the forms they are printed in: terminal, Markdown, CSV, LaTeX, JSON. Every
// form carries the same rows and notes; people read rounded text, machines the plain numbers.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/compare/statistics.hpp"

namespace gnbv {

/// What the cells of a column are, and which plain columns CSV and JSON make of it: `text` and
/// `number` one named by the key, `estimate` (a mean and the half width of its 95 % interval) KEY
/// and KEY_ci95, `counted` (a number and the runs that go with it) KEY and KEY_runs, `tested` (a p
/// of the signed-rank test, the differences that it ranks, the ranks of positive ones) KEY, KEY_n
/// and KEY_w_plus.
enum class ColumnKind { text, number, estimate, counted, tested };

struct TableColumn {
  std::string head;  // for people
  std::string key;   // for machines, in the unit of the plain numbers
  ColumnKind kind = ColumnKind::text;
  int decimals = 0;       // of estimates, for people
  bool is_share = false;  // people read it in percent

  bool is_right() const { return kind != ColumnKind::text; }
};

/// A cell as people read it and, unless the column is of text, its plain numbers.
struct TableCell {
  std::string text = "-";
  std::array<std::optional<double>, 3> values = {};

  bool operator==(const TableCell&) const = default;
};

/// "92.8 ±0.6"; a dash where there is no mean.
TableCell estimate_cell(const std::optional<MeanEstimate>& estimate, int decimals,
                        bool is_share = false);

struct TextTable {
  std::string title = {};
  std::vector<TableColumn> columns = {};  // the first is of text
  std::vector<std::vector<TableCell>> rows = {};
  std::vector<std::string> notes = {};
};

/// The table with the last columns of `more`, those after its first `shared`: a row gets the cells
/// of the row that agrees with it in the texts of the shared columns, or dashes. Notes of both.
TextTable with_columns_of(TextTable table, const TextTable& more, std::size_t shared);

/// Title, aligned columns where there are rows, and notes, for a terminal of that width (0: as wide
/// as it takes). What is wider is made narrow, by no more than it takes: heads are folded at
/// blanks; all names but the last become lines above their rows; words on the right are folded;
/// columns go into blocks below each other. No cell is ever cut.
std::string terminal_text(const TextTable& table, std::size_t width = 0);

/// A table of GitHub's Markdown, its title in bold above and its notes as a list below.
std::string markdown_text(const TextTable& table);

/// A field of RFC 4180: in quotes where it has to be.
std::string csv_field(std::string_view text);

/// RFC 4180: keys, then a record a row; plain numbers, empty where there is none. A note is a
/// record whose first field begins with "note: "; its other fields are empty. The title is not in
/// it.
std::string csv_text(const TextTable& table);

/// A `table` environment for the packages booktabs and, where the text is not ASCII, UTF-8 input.
std::string latex_text(const TextTable& table);

/// An object: title, columns (key, head), rows (objects by key; null where there is no number),
/// notes.
std::string json_text(const TextTable& table);

/// The forms by name, as --format takes them.
constexpr std::array<std::string_view, 5> kTableFormats = {"terminal", "markdown", "csv", "latex",
                                                           "json"};

/// In a form of kTableFormats; that of a terminal as wide as `width`.
std::string formatted_text(const TextTable& table, std::string_view format, std::size_t width = 0);

}  // namespace gnbv
