#include "bench/compare/terminal_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <sstream>

#include "bench/compare/narrow_table.hpp"
#include "bench/compare/table_lines.hpp"

namespace gnbv {
namespace {

std::string without_trailing_blanks(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

std::size_t longest_word(std::string_view text) {
  std::size_t longest = 0;
  while (!text.empty()) {
    const std::string_view word = first_word(text);
    longest = std::max(longest, width_of(word));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
  }
  return longest;
}

/// Columns that are no wider than their cells and the longest word of their heads.
std::vector<std::size_t> folded_widths(const TableLines& lines) {
  TableLines headless = lines;
  headless[0].assign(lines[0].size(), "");
  std::vector<std::size_t> widths = column_widths(headless, 0);
  for (std::size_t c = 0; c < widths.size(); ++c) {
    constexpr std::size_t kShort = 7;  // "0.05 m" stays whole
    const std::string& head = lines[0][c];
    const bool is_short = width_of(head) <= kShort;
    widths[c] = std::max(widths[c], is_short ? width_of(head) : longest_word(head));
  }
  return widths;
}

/// How a table is laid out.
struct Form {
  std::vector<std::size_t> widths;  // of its columns
  std::size_t gap = 2;              // between them
  std::size_t above = 0;            // the first names that stand above the rows that share them
};

using Columns = std::vector<std::size_t>;

std::size_t width_of_block(const Columns& columns, const Form& form) {
  std::size_t sum = 0;
  for (const std::size_t c : columns) sum += form.widths[c] + form.gap;
  return sum - form.gap;
}

/// The columns in blocks of at most that width, each after the names that do not stand above.
std::vector<Columns> blocks_of(const TextTable& table, const Form& form, std::size_t width) {
  Columns names(names_of(table) - form.above);
  std::iota(names.begin(), names.end(), form.above);
  std::vector<Columns> blocks(1, names);
  for (std::size_t c = names_of(table); c < form.widths.size(); ++c) {
    Columns wider = blocks.back();
    wider.push_back(c);
    if (blocks.back().size() > names.size() && width_of_block(wider, form) > width) {
      blocks.push_back(names);
    }
    blocks.back().push_back(c);
  }
  return blocks;
}

/// The lines of text cells of a row, each folded to the width of its column, one below the other.
/// `from_below`: shorter ones stand on the last line, not on the first.
std::string folded_row(const TextTable& table, const std::vector<std::string>& cells,
                       const Form& form, const Columns& columns, bool from_below) {
  std::vector<std::vector<std::string>> pieces;  // by column
  std::size_t height = 1;
  for (const std::size_t c : columns) {
    std::vector<std::string>& lines = pieces.emplace_back();
    const bool fits = width_of(cells[c]) <= form.widths[c];
    std::istringstream folded(fits ? cells[c] : folded_text(cells[c], form.widths[c]));
    for (std::string line; std::getline(folded, line);) lines.push_back(line);
    height = std::max(height, lines.size());
  }
  std::string text;
  for (std::size_t row = 0; row < height; ++row) {
    std::string line;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::size_t above = from_below ? height - pieces[k].size() : 0;
      const bool is_there = row >= above && row - above < pieces[k].size();
      const std::string piece = is_there ? pieces[k][row - above] : "";
      const std::string fill(form.widths[columns[k]] - width_of(piece), ' ');
      line += k > 0 ? std::string(form.gap, ' ') : "";
      line += is_right(table.columns[columns[k]]) ? fill + piece : piece + fill;
    }
    text += without_trailing_blanks(line) + "\n";
  }
  return text;
}

/// Heads, which may take several lines, a rule, and the rows of these columns; above the rows that
/// share their first names a line with these.
std::string block_text(const TextTable& table, const TableLines& lines, const Form& form,
                       const Columns& columns) {
  std::string text = folded_row(table, lines[0], form, columns, true) +
                     std::string(width_of_block(columns, form), '-') + "\n";
  const auto shared = [&](const std::vector<std::string>& line) {
    return std::vector<std::string>(line.begin(),
                                    line.begin() + static_cast<std::ptrdiff_t>(form.above));
  };
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (form.above > 0 && (i == 1 || shared(lines[i]) != shared(lines[i - 1]))) {
      text += fmt::format("{}{}\n", i == 1 ? "" : "\n", fmt::join(shared(lines[i]), ", "));
    }
    text += folded_row(table, lines[i], form, columns, false);
  }
  return text;
}

/// Words on the right become as narrow as the width asks for, but no narrower than each of them.
void fold_words(const TextTable& table, const TableLines& lines, const Columns& columns,
                std::size_t width, Form& form) {
  const std::size_t last = columns.back();
  const std::size_t all = width_of_block(columns, form);
  if (all <= width || is_right(table.columns[last]) || last < names_of(table)) return;
  std::size_t longest = 1;
  for (const auto& line : lines) longest = std::max(longest, longest_word(line[last]));
  std::size_t& now = form.widths[last];
  now -= std::min(all - width, now - std::min(now, longest));
}

/// The table as narrow as it takes.
std::string narrow_text(const TextTable& table, std::size_t width) {
  const TableLines lines = printed_cells(table, [](const std::string& text) { return text; });
  Form form{.widths = folded_widths(lines)};
  Columns columns(form.widths.size());
  std::iota(columns.begin(), columns.end(), 0U);
  const auto fits = [&] { return width_of_block(columns, form) <= width; };
  if (!fits() && names_of(table) > 1 && table.rows.size() > 2) {
    form.above = names_of(table) - 1;
    columns.erase(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(form.above));
  }
  if (!fits()) {
    form.gap = 1;
    fold_words(table, lines, columns, width, form);
  }
  if (!fits()) {  // there will be blocks: these can be wide
    form.gap = 2;
    form.widths = folded_widths(lines);
  }
  std::string text;
  for (const Columns& block : blocks_of(table, form, width)) {
    text += (text.empty() ? "" : "\n") + block_text(table, lines, form, block);
  }
  return text;
}

}  // namespace

std::string terminal_text(const TextTable& table, std::size_t width) {
  const TableLines lines = printed_cells(table, [](const std::string& text) { return text; });
  const Form whole{.widths = column_widths(lines, 0)};
  Columns all(whole.widths.size());
  std::iota(all.begin(), all.end(), 0U);
  const bool fits = width == 0 || width_of_block(all, whole) <= width;
  const bool fits_folded = width_of_block(all, {.widths = folded_widths(lines)}) <= width;
  const TextTable shown = fits || fits_folded ? table : without_constants(table);
  std::string text = table.title.empty() ? "" : folded_text(table.title, width) + "\n";
  text += fits ? block_text(table, lines, whole, all) : narrow_text(shown, width);
  for (const std::string& note : shown.notes) text += folded_text(note, width) + "\n";
  return text;
}

}  // namespace gnbv
