// What the forms of a table that people read have in common.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "bench/compare/text_table.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"

namespace gnbv {

using TableLines = std::vector<std::vector<std::string>>;  // cells as printed, heads first

inline bool is_right(const TableColumn& column) { return column.kind != ColumnKind::text; }

template <typename Escape>
TableLines printed_cells(const TextTable& table, const Escape& escaped) {
  TableLines lines(1);
  for (const TableColumn& column : table.columns) lines[0].push_back(escaped(column.head));
  for (const auto& row : table.rows) {
    GNBV_CHECK(row.size() == table.columns.size(), "{} cells in {} columns", row.size(),
               table.columns.size());
    std::vector<std::string>& line = lines.emplace_back();
    for (const TableCell& cell : row) line.push_back(escaped(cell.text));
  }
  return lines;
}

inline std::vector<std::size_t> column_widths(const TableLines& lines, std::size_t least) {
  std::vector<std::size_t> widths(lines[0].size(), least);
  for (const auto& line : lines) {
    for (std::size_t c = 0; c < line.size(); ++c) {
      widths[c] = std::max(widths[c], width_of(line[c]));
    }
  }
  return widths;
}

}  // namespace gnbv
