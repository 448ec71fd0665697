#include "bench/compare/text_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/core/error.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

/// What Markdown would take for markup. An underscore within a word is none.
std::string markdown_escaped(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kEscapes = {
      {{"\\", "\\\\"}, {"|", "\\|"}, {"*", "\\*"}, {"`", "\\`"}, {"<", "\\<"}, {"\n", " "}}};
  const auto is_word = [&](std::size_t i) {
    return i < text.size() && std::isalnum(static_cast<unsigned char>(text[i])) != 0;
  };
  std::string all;
  std::size_t from = 0;
  for (std::size_t at = text.find('_'); at != std::string::npos; at = text.find('_', at + 1)) {
    if (is_word(at - 1) && is_word(at + 1)) continue;
    all += escaped(text.substr(from, at - from), kEscapes) + "\\_";
    from = at + 1;
  }
  return all + escaped(text.substr(from), kEscapes);
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
  return escaped(text, kEscapes);
}

/// Heads, then rows, as they are printed.
template <typename Escape>
std::vector<std::vector<std::string>> printed_lines(const TextTable& table, const Escape& escape) {
  std::vector<std::vector<std::string>> lines(1);
  for (const TableColumn& column : table.columns) lines[0].push_back(escape(column.head));
  for (const auto& row : table.rows) {
    lines.emplace_back();
    for (const TableCell& cell : row) lines.back().push_back(escape(cell.text));
  }
  return lines;
}

/// What follows the key of a column in those of its plain columns.
std::vector<const char*> endings_of(ColumnKind kind) {
  using enum ColumnKind;
  if (kind == estimate) return {"", "_ci95"};
  if (kind == counted) return {"", "_runs"};
  if (kind == tested) return {"", "_n", "_w_plus"};
  return {""};
}

/// The keys of the plain columns that those of a table become, each with the head of its own.
std::vector<std::array<std::string, 2>> plain_columns(const TextTable& table) {
  std::vector<std::array<std::string, 2>> all;
  for (const TableColumn& column : table.columns) {
    for (const char* ending : endings_of(column.kind)) {
      all.push_back({column.key + ending, column.head});
    }
  }
  return all;
}

/// The cells of a row in these: texts and numbers, null where there is none.
std::vector<Json> plain_cells(const TextTable& table, const std::vector<TableCell>& row) {
  std::vector<Json> all;
  for (std::size_t c = 0; c < row.size(); ++c) {
    const ColumnKind kind = table.columns[c].kind;
    if (kind == ColumnKind::text) all.emplace_back(row[c].text);
    for (std::size_t k = 0; kind != ColumnKind::text && k < endings_of(kind).size(); ++k) {
      all.push_back(row[c].values[k] ? Json(*row[c].values[k]) : Json(nullptr));
    }
  }
  return all;
}

std::string csv_record(const std::vector<std::string>& fields) {
  return fmt::format("{}\r\n", fmt::join(fields, ","));
}

}  // namespace

TableCell estimate_cell(const std::optional<MeanEstimate>& estimate, int decimals, bool is_share) {
  if (!estimate) return {};
  const double factor = is_share ? 100.0 : 1.0;
  std::string text = grouped(factor * estimate->mean, decimals);
  if (estimate->half_width) text += " ±" + grouped(factor * *estimate->half_width, decimals);
  return {is_share ? text + "%" : text, {estimate->mean, estimate->half_width}};
}

TextTable with_columns_of(TextTable table, const TextTable& more, std::size_t shared) {
  const auto from = static_cast<std::ptrdiff_t>(shared);
  table.columns.insert(table.columns.end(), more.columns.begin() + from, more.columns.end());
  for (auto& row : table.rows) {
    const auto same = std::find_if(more.rows.begin(), more.rows.end(), [&](const auto& other) {
      return std::equal(other.begin(), other.begin() + from, row.begin(),
                        [](const TableCell& a, const TableCell& b) { return a.text == b.text; });
    });
    if (same != more.rows.end()) row.insert(row.end(), same->begin() + from, same->end());
    row.resize(table.columns.size());
  }
  table.notes.insert(table.notes.end(), more.notes.begin(), more.notes.end());
  return table;
}

std::string markdown_text(const TextTable& table) {
  std::string text = table.title.empty() ? "" : "**" + markdown_escaped(table.title) + "**\n\n";
  const auto lines = printed_lines(table, markdown_escaped);
  std::vector<std::size_t> widths(table.columns.size(), 3);
  for (const auto& line : lines) {
    for (std::size_t c = 0; c < line.size(); ++c) {
      widths[c] = std::max(widths[c], width_of(line[c]));
    }
  }
  for (const auto& line : lines) {
    std::string rule = "|";
    for (std::size_t c = 0; c < line.size(); ++c) {
      const bool is_right = table.columns[c].is_right();
      const std::string fill(widths[c] - width_of(line[c]), ' ');
      text += "| " + (is_right ? fill + line[c] : line[c] + fill) + " ";
      rule += " " + std::string(widths[c] - 1, '-') + (is_right ? ":" : "-") + " |";
    }
    text += "|\n" + (&line == &lines.front() ? rule + "\n" : "");
  }
  if (!table.notes.empty()) text += "\n";
  for (const std::string& note : table.notes) text += "- " + markdown_escaped(note) + "\n";
  return text;
}

std::string latex_text(const TextTable& table) {
  std::string text = "% needs \\usepackage{booktabs}\n\\begin{table}\n\\centering\n";
  if (!table.title.empty()) text += "\\caption{" + latex_escaped(table.title) + "}\n";
  text += "\\begin{tabular}{";
  for (const TableColumn& column : table.columns) text += column.is_right() ? "r" : "l";
  text += "}\n\\toprule\n";
  const auto lines = printed_lines(table, latex_escaped);
  for (const auto& line : lines) {
    text += fmt::format("{} \\\\\n", fmt::join(line, " & "));
    if (&line == &lines.front()) text += "\\midrule\n";
  }
  text += "\\bottomrule\n\\end{tabular}\n";
  for (const std::string& note : table.notes) {
    text += "\n\\par\\footnotesize " + latex_escaped(note) + "\n";
  }
  return text + "\\end{table}\n";
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  constexpr std::array<std::pair<std::string_view, std::string_view>, 1> kEscapes = {
      {{"\"", "\"\""}}};
  return "\"" + escaped(text, kEscapes) + "\"";
}

std::string csv_text(const TextTable& table) {
  std::vector<std::string> fields;
  for (const auto& [key, head] : plain_columns(table)) fields.push_back(csv_field(key));
  std::string text = csv_record(fields);
  for (const auto& row : table.rows) {
    fields.clear();
    for (const Json& cell : plain_cells(table, row)) {
      // a number is the shortest decimal that reads back as the same double
      fields.push_back(cell.is_string()   ? csv_field(cell.get<std::string>())
                       : cell.is_number() ? fmt::format("{}", cell.get<double>())
                                          : "");
    }
    text += csv_record(fields);
  }
  for (const std::string& note : table.notes) {
    fields.assign(fields.size(), "");
    fields[0] = csv_field("note: " + note);
    text += csv_record(fields);
  }
  return text;
}

std::string json_text(const TextTable& table) {
  const auto columns = plain_columns(table);
  Json json = {{"title", table.title},
               {"columns", Json::array()},
               {"rows", Json::array()},
               {"notes", table.notes}};
  for (const auto& [key, head] : columns) {
    json["columns"].push_back({{"key", key}, {"head", head}});
  }
  for (const auto& row : table.rows) {
    const std::vector<Json> cells = plain_cells(table, row);
    Json object = Json::object();
    for (std::size_t c = 0; c < cells.size(); ++c) object[columns[c][0]] = cells[c];
    json["rows"].push_back(object);
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string formatted_text(const TextTable& table, std::string_view format, std::size_t width) {
  if (format == "terminal") return terminal_text(table, width);
  if (format == "markdown") return markdown_text(table);
  if (format == "csv") return csv_text(table);
  if (format == "latex") return latex_text(table);
  GNBV_CHECK(format == "json", "no table format '{}'", format);
  return json_text(table);
}

}  // namespace gnbv
