// terminal_text() of text_table.hpp: a table made as narrow as a terminal asks for.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <sstream>

#include "bench/compare/text_table.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

/// How many columns of text are on the left.
std::size_t names_of(const TextTable& table) {
  const auto first = std::find_if(table.columns.begin(), table.columns.end(),
                                  [](const TableColumn& column) { return column.is_right(); });
  return static_cast<std::size_t>(first - table.columns.begin());
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

/// A head folded at blanks; "0.05 m" stays whole.
std::size_t folded_width(std::string_view head) {
  constexpr std::size_t kShort = 7;
  return width_of(head) <= kShort ? width_of(head) : longest_word(head);
}

using Columns = std::vector<std::size_t>;

/// A table laid out in columns, as narrow as it takes.
class Layout {
 public:
  Layout(const TextTable& table, std::size_t most) : table_(table), most_(most) {
    for (std::size_t c = 0; c < table.columns.size(); ++c) columns_.push_back(c);
    set_widths(width_of);
    if (!fits()) set_widths(folded_width);
    if (!fits() && names_of(table) > 1 && table.rows.size() > 2) {
      above_ = names_of(table) - 1;
      columns_.erase(columns_.begin(), columns_.begin() + static_cast<std::ptrdiff_t>(above_));
    }
    if (!fits()) gap_ = 1;
    if (!fits()) fold_words();
    if (fits()) return;
    gap_ = 2;  // there will be blocks: these can be wide
    set_widths(folded_width);
  }

  std::string text() const {
    std::string text;
    for (const Columns& block : blocks()) text += (text.empty() ? "" : "\n") + block_text(block);
    return text;
  }

 private:
  void set_widths(std::size_t (*of_head)(std::string_view)) {
    widths_.clear();
    for (std::size_t c = 0; c < table_.columns.size(); ++c) {
      widths_.push_back(of_head(table_.columns[c].head));
      for (const auto& row : table_.rows) widths_[c] = std::max(widths_[c], width_of(row[c].text));
    }
  }

  std::size_t width_of_block(const Columns& block) const {
    std::size_t sum = 0;
    for (const std::size_t c : block) sum += widths_[c] + gap_;
    return sum - gap_;
  }
  bool fits() const { return width_of_block(columns_) <= most_; }

  /// Words on the right become as narrow as the width asks for, but no narrower than each of them.
  void fold_words() {
    const std::size_t last = columns_.back();
    if (table_.columns[last].is_right() || last < names_of(table_)) return;
    std::size_t longest = std::max<std::size_t>(1, longest_word(table_.columns[last].head));
    for (const auto& row : table_.rows) longest = std::max(longest, longest_word(row[last].text));
    std::size_t& now = widths_[last];
    now -= std::min(width_of_block(columns_) - most_, now - std::min(now, longest));
  }

  /// The columns in blocks of at most that width, each after the names that do not stand above.
  std::vector<Columns> blocks() const {
    Columns names(names_of(table_) - above_);
    std::iota(names.begin(), names.end(), above_);
    std::vector<Columns> all(1, names);
    for (std::size_t c = names_of(table_); c < widths_.size(); ++c) {
      Columns wider = all.back();
      wider.push_back(c);
      if (all.back().size() > names.size() && width_of_block(wider) > most_) all.push_back(names);
      all.back().push_back(c);
    }
    return all;
  }

  /// The lines of some cells, each folded to the width of its column, one below the other.
  /// `from_below`: shorter ones stand on the last line, not on the first.
  template <typename TextOf>
  std::string line_text(const Columns& block, bool from_below, const TextOf& text_of) const {
    std::vector<std::vector<std::string>> pieces;  // by column
    std::size_t height = 1;
    for (const std::size_t c : block) {
      std::vector<std::string>& lines = pieces.emplace_back();
      const bool fits = width_of(text_of(c)) <= widths_[c];
      std::istringstream folded(fits ? text_of(c) : folded_text(text_of(c), widths_[c]));
      for (std::string line; std::getline(folded, line);) lines.push_back(line);
      height = std::max(height, lines.size());
    }
    std::string text;
    for (std::size_t row = 0; row < height; ++row) {
      std::string line;
      for (std::size_t k = 0; k < block.size(); ++k) {
        const std::size_t over = from_below ? height - pieces[k].size() : 0;
        const bool is_there = row >= over && row - over < pieces[k].size();
        const std::string piece = is_there ? pieces[k][row - over] : "";
        const std::string fill(widths_[block[k]] - width_of(piece), ' ');
        line += k > 0 ? std::string(gap_, ' ') : "";
        line += table_.columns[block[k]].is_right() ? fill + piece : piece + fill;
      }
      text += line.erase(line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
  }

  /// Heads, which may take several lines, a rule, and the rows of these columns; above the rows
  /// that share their first names a line with these.
  std::string block_text(const Columns& block) const {
    std::string text = line_text(block, true, [&](auto c) { return table_.columns[c].head; }) +
                       std::string(width_of_block(block), '-') + "\n";
    std::string said;
    for (const auto& row : table_.rows) {
      std::vector<std::string> names;
      for (std::size_t c = 0; c < above_; ++c) names.push_back(row[c].text);
      const std::string line = fmt::format("{}\n", fmt::join(names, ", "));
      if (above_ > 0 && line != said) text += (said.empty() ? "" : "\n") + line;
      said = line;
      text += line_text(block, false, [&](std::size_t c) { return row[c].text; });
    }
    return text;
  }

  const TextTable& table_;
  const std::size_t most_;
  Columns columns_ = {};                  // those beside each other
  std::vector<std::size_t> widths_ = {};  // of all columns
  std::size_t gap_ = 2;                   // between them
  std::size_t above_ = 0;  // the first names that stand above the rows that share them
};

}  // namespace

std::string terminal_text(const TextTable& table, std::size_t width) {
  const std::size_t most = width == 0 ? std::numeric_limits<std::size_t>::max() : width;
  std::string text = table.title.empty() ? "" : folded_text(table.title, width) + "\n";
  if (!table.rows.empty()) text += Layout(table, most).text();
  for (const std::string& note : table.notes) text += folded_text(note, width) + "\n";
  return text;
}

}  // namespace gnbv
