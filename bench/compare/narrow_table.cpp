#include "bench/compare/narrow_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bench/compare/table_lines.hpp"

namespace gnbv {
namespace {

/// "every row: n 8, Rank -; Holm as p": nothing for a column that has to be seen.
std::string in_words(const TextTable& table, std::size_t column) {
  const auto& rows = table.rows;
  const std::string& head = table.columns[column].head;
  const auto is_same = [&](const auto& row) { return row[column].text == rows[0][column].text; };
  if (std::all_of(rows.begin(), rows.end(), is_same)) {
    const std::string& text = rows[0][column].text;
    return text == "-" ? fmt::format("no {}", head) : fmt::format("{} {}", head, text);
  }
  const bool repeats = column > 0 && std::all_of(rows.begin(), rows.end(), [&](const auto& row) {
                         return row[column].text == row[column - 1].text;
                       });
  return repeats ? fmt::format("{} as {}", head, table.columns[column - 1].head) : "";
}

}  // namespace

std::size_t names_of(const TextTable& table) {
  const auto& columns = table.columns;
  return static_cast<std::size_t>(std::find_if(columns.begin(), columns.end(), is_right) -
                                  columns.begin());
}

TextTable without_constants(TextTable table) {
  if (table.rows.size() < 3) return table;
  std::vector<std::string> said;
  std::vector<std::size_t> gone;
  std::size_t names = names_of(table);
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const bool is_name = c < names_of(table);
    const std::string words = is_name && names == 1 ? "" : in_words(table, c);
    if (words.empty()) continue;
    if (is_name) --names;
    said.push_back(words);
    gone.push_back(c);
  }
  if (gone.empty()) return table;
  for (auto c = gone.rbegin(); c != gone.rend(); ++c) {
    const auto at = static_cast<std::ptrdiff_t>(*c);
    table.columns.erase(table.columns.begin() + at);
    for (auto& row : table.rows) row.erase(row.begin() + at);
  }
  table.notes.insert(table.notes.begin(), fmt::format("every row: {}", fmt::join(said, ", ")));
  return table;
}

}  // namespace gnbv
