#include "bench/compare/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/compare/table_lines.hpp"
#include "bench/compare/terminal_table.hpp"

namespace gnbv {
namespace {

std::string joined(const std::vector<std::string>& cells, const TextTable& table,
                   const std::vector<std::size_t>& widths, std::string_view separator) {
  std::string line;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::string fill(widths[c] - width_of(cells[c]), ' ');
    line += c > 0 ? separator : "";
    line += is_right(table.columns[c]) ? fill + cells[c] : cells[c] + fill;
  }
  return line;
}

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// What Markdown would take for markup. An underscore within a word is none.
std::string markdown_escaped(std::string_view text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool within_word =
        i > 0 && i + 1 < text.size() && is_word(text[i - 1]) && is_word(text[i + 1]);
    const bool is_markup = std::string_view("\\|*`<").find(text[i]) != std::string_view::npos ||
                           (text[i] == '_' && !within_word);
    if (is_markup) escaped += '\\';
    escaped += text[i] == '\n' ? ' ' : text[i];
  }
  return escaped;
}

/// LaTeX's ten special characters, and the signs of ours that its default fonts lack or, in the old
/// encoding, have others in the place of.
std::string latex_escaped(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 17> kEscapes = {
      {{"\\", "\\textbackslash{}"},
       {"&", "\\&"},
       {"%", "\\%"},
       {"_", "\\_"},
       {"#", "\\#"},
       {"$", "\\$"},
       {"{", "\\{"},
       {"}", "\\}"},
       {"~", "\\textasciitilde{}"},
       {"^", "\\textasciicircum{}"},
       {"<", "\\textless{}"},
       {">", "\\textgreater{}"},
       {"|", "\\textbar{}"},
       {"--", "-{}-"},  // else a dash
       {"±", "$\\pm$"},
       {"†", "$^\\dagger$"},
       {"\n", " "}}};
  std::string escaped;
  while (!text.empty()) {
    const auto escape = std::find_if(kEscapes.begin(), kEscapes.end(),
                                     [&](const auto& e) { return text.starts_with(e.first); });
    escaped += escape == kEscapes.end() ? text.substr(0, 1) : escape->second;
    text.remove_prefix(escape == kEscapes.end() ? 1 : escape->first.size());
  }
  return escaped;
}

}  // namespace

TextTable with_columns_of(TextTable table, const TextTable& more, std::size_t shared) {
  const auto from = static_cast<std::ptrdiff_t>(shared);
  table.columns.insert(table.columns.end(), more.columns.begin() + from, more.columns.end());
  for (auto& row : table.rows) {
    const auto same = std::find_if(more.rows.begin(), more.rows.end(), [&](const auto& other) {
      return std::equal(other.begin(), other.begin() + from, row.begin(),
                        [](const TableCell& a, const TableCell& b) { return a.text == b.text; });
    });
    if (same != more.rows.end()) {
      row.insert(row.end(), same->begin() + from, same->end());
    } else {
      row.resize(table.columns.size(), {.text = "-"});
    }
  }
  table.notes.insert(table.notes.end(), more.notes.begin(), more.notes.end());
  return table;
}

std::string markdown_text(const TextTable& table) {
  const TableLines lines = printed_cells(table, markdown_escaped);
  const std::vector<std::size_t> widths = column_widths(lines, 3);
  std::string rule = "|";
  for (std::size_t c = 0; c < widths.size(); ++c) {
    rule += " " + std::string(widths[c] - 1, '-') + (is_right(table.columns[c]) ? ":" : "-") + " |";
  }
  std::string text = table.title.empty() ? "" : "**" + markdown_escaped(table.title) + "**\n\n";
  for (const auto& line : lines) {
    text += "| " + joined(line, table, widths, " | ") + " |\n";
    if (&line == &lines[0]) text += rule + "\n";
  }
  if (!table.notes.empty()) text += "\n";
  for (const std::string& note : table.notes) text += "- " + markdown_escaped(note) + "\n";
  return text;
}

std::string latex_text(const TextTable& table) {
  const TableLines lines = printed_cells(table, latex_escaped);
  std::string text = "% needs \\usepackage{booktabs}\n\\begin{table}\n\\centering\n";
  if (!table.title.empty()) text += "\\caption{" + latex_escaped(table.title) + "}\n";
  text += "\\begin{tabular}{";
  for (const TableColumn& column : table.columns) text += is_right(column) ? "r" : "l";
  text += "}\n\\toprule\n";
  for (const auto& line : lines) {
    text += fmt::format("{} \\\\\n", fmt::join(line, " & "));
    if (&line == &lines[0]) text += "\\midrule\n";
  }
  text += "\\bottomrule\n\\end{tabular}\n";
  for (const std::string& note : table.notes) {
    text += "\n\\par\\footnotesize " + latex_escaped(note) + "\n";
  }
  return text + "\\end{table}\n";
}

std::string formatted_text(const TextTable& table, std::string_view format) {
  if (format == "terminal") return terminal_text(table);
  if (format == "markdown") return markdown_text(table);
  if (format == "csv") return csv_text(table);
  if (format == "latex") return latex_text(table);
  GNBV_CHECK(format == "json", "no table format '{}'", format);
  return json_text(table);
}

}  // namespace gnbv
