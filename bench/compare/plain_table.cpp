// The forms of a table that machines read: plain numbers under plain keys.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bench/compare/text_table.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// The plain columns that one of ours becomes.
std::vector<std::string> keys_of(const TableColumn& column) {
  if (column.kind == ColumnKind::estimate) return {column.key, column.key + "_ci95"};
  if (column.kind == ColumnKind::counted) return {column.key, column.key + "_runs"};
  return {column.key};
}

/// The shortest decimal that reads back as the same double.
std::string csv_number(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "";
}

std::string csv_record(const std::vector<std::string>& fields) {
  return fmt::format("{}\r\n", fmt::join(fields, ","));
}

}  // namespace

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string csv_text(const TextTable& table) {
  GNBV_CHECK(!table.columns.empty() && table.columns[0].kind == ColumnKind::text,
             "the first column is not of text");
  std::vector<std::string> header;
  for (const TableColumn& column : table.columns) {
    for (const std::string& key : keys_of(column)) header.push_back(csv_field(key));
  }
  std::string text = csv_record(header);
  for (const auto& row : table.rows) {
    std::vector<std::string> fields;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const bool is_text = table.columns[c].kind == ColumnKind::text;
      for (std::size_t k = 0; k < keys_of(table.columns[c]).size(); ++k) {
        fields.push_back(is_text ? csv_field(row[c].text) : csv_number(row[c].values[k]));
      }
    }
    text += csv_record(fields);
  }
  for (const std::string& note : table.notes) {
    std::vector<std::string> fields(header.size());
    fields[0] = csv_field("note: " + note);
    text += csv_record(fields);
  }
  return text;
}

std::string json_text(const TextTable& table) {
  using Json = nlohmann::ordered_json;
  Json json = {{"title", table.title},
               {"columns", Json::array()},
               {"rows", Json::array()},
               {"notes", table.notes}};
  for (const TableColumn& column : table.columns) {
    for (const std::string& key : keys_of(column)) {
      json["columns"].push_back({{"key", key}, {"head", column.head}});
    }
  }
  for (const auto& row : table.rows) {
    Json object = Json::object();
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::vector<std::string> keys = keys_of(table.columns[c]);
      for (std::size_t k = 0; k < keys.size(); ++k) {
        const std::optional<double>& value = row[c].values[k];
        object[keys[k]] = table.columns[c].kind == ColumnKind::text ? Json(row[c].text)
                          : value                                   ? Json(*value)
                                                                    : Json(nullptr);
      }
    }
    json["rows"].push_back(object);
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gnbv
