#include "bench/compare/terminal_table.hpp"

#include <algorithm>
#include <numeric>

#include "bench/compare/table_lines.hpp"

namespace gnbv {
namespace {

std::string without_trailing_blanks(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

/// Columns that are no wider than their cells and the longest word of their heads.
std::vector<std::size_t> folded_widths(const TableLines& lines) {
  TableLines headless = lines;
  headless[0].assign(lines[0].size(), "");
  std::vector<std::size_t> widths = column_widths(headless, 0);
  for (std::size_t c = 0; c < widths.size(); ++c) {
    constexpr std::size_t kShort = 7;  // "0.05 m" stays whole
    std::string_view rest = lines[0][c];
    if (width_of(rest) <= kShort) {
      widths[c] = std::max(widths[c], width_of(rest));
      continue;
    }
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find(' '), rest.size());
      widths[c] = std::max(widths[c], width_of(rest.substr(0, end)));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }
  return widths;
}

constexpr std::size_t kGap = 2;  // between columns

std::size_t width_of_block(const std::vector<std::size_t>& columns,
                           const std::vector<std::size_t>& widths) {
  std::size_t sum = 0;
  for (const std::size_t c : columns) sum += widths[c] + kGap;
  return sum - kGap;
}

/// The columns in blocks of at most that width, each after the columns of text on the left.
std::vector<std::vector<std::size_t>> blocks_of(const TextTable& table,
                                                const std::vector<std::size_t>& widths,
                                                std::size_t width) {
  std::vector<std::size_t> names;
  while (names.size() < widths.size() && !is_right(table.columns[names.size()])) {
    names.push_back(names.size());
  }
  std::vector<std::vector<std::size_t>> blocks(1, names);
  for (std::size_t c = names.size(); c < widths.size(); ++c) {
    std::vector<std::size_t> wider = blocks.back();
    wider.push_back(c);
    if (blocks.back().size() > names.size() && width_of_block(wider, widths) > width) {
      blocks.push_back(names);
    }
    blocks.back().push_back(c);
  }
  return blocks;
}

/// Heads, which may take several lines, a rule, and the rows of these columns.
std::string block_text(const TextTable& table, const TableLines& lines,
                       const std::vector<std::size_t>& widths,
                       const std::vector<std::size_t>& columns) {
  TableLines heads;  // from the lowest line up
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::size_t c = columns[k];
    std::string folded = folded_text(lines[0][c], std::max<std::size_t>(widths[c], 1));
    for (std::size_t row = 0;; ++row) {
      if (row == heads.size()) heads.emplace_back(columns.size());
      const std::size_t begin = folded.rfind('\n') + 1;  // npos + 1: all of it
      heads[row][k] = folded.substr(begin);
      if (begin == 0) break;
      folded.resize(begin - 1);
    }
  }
  std::string text;
  const auto add = [&](const auto& cell_of) {
    std::string line;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::string& cell = cell_of(k);
      const std::string fill(widths[columns[k]] - width_of(cell), ' ');
      line += k > 0 ? std::string(kGap, ' ') : "";
      line += is_right(table.columns[columns[k]]) ? fill + cell : cell + fill;
    }
    text += without_trailing_blanks(line) + "\n";
  };
  for (auto row = heads.rbegin(); row != heads.rend(); ++row) {
    add([&](std::size_t k) -> const std::string& { return (*row)[k]; });
  }
  text += std::string(width_of_block(columns, widths), '-') + "\n";
  for (std::size_t i = 1; i < lines.size(); ++i) {
    add([&](std::size_t k) -> const std::string& { return lines[i][columns[k]]; });
  }
  return text;
}

}  // namespace

std::string folded_text(std::string_view text, std::size_t width) {
  if (width == 0) return std::string(text);
  std::string folded;
  std::size_t used = 0;  // of the line
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" \n"), text.size());
    const std::string_view word = text.substr(0, end);
    const bool is_first = folded.empty() || folded.back() == '\n';
    if (!is_first && used + 1 + width_of(word) > width) {
      folded += '\n';
      used = 0;
    } else if (!is_first) {
      folded += ' ';
      ++used;
    }
    folded += word;
    used += width_of(word);
    if (end < text.size() && text[end] == '\n') {
      folded += '\n';
      used = 0;
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return folded;
}

std::string terminal_text(const TextTable& table, std::size_t width) {
  const TableLines lines = printed_cells(table, [](const std::string& text) { return text; });
  std::string text = table.title.empty() ? "" : folded_text(table.title, width) + "\n";
  const std::vector<std::size_t> whole = column_widths(lines, 0);
  std::vector<std::size_t> all(whole.size());
  std::iota(all.begin(), all.end(), 0U);
  if (width == 0 || width_of_block(all, whole) <= width) {
    text += block_text(table, lines, whole, all);
  } else {
    const std::vector<std::size_t> folded = folded_widths(lines);
    const auto blocks = blocks_of(table, folded, width);
    for (const std::vector<std::size_t>& block : blocks) {
      text += (&block == &blocks.front() ? "" : "\n") + block_text(table, lines, folded, block);
    }
  }
  for (const std::string& note : table.notes) text += folded_text(note, width) + "\n";
  return text;
}

std::string terminal_text(const TextTable& table) { return terminal_text(table, 0); }

}  // namespace gnbv
