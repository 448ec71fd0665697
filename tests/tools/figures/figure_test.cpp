// Laws of figures as files: every kind is as its schema says, and the CSV holds what the JSON does.
#include "tools/figures/figure.hpp"

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "sim/core/file.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/tools/figures/figure_support.hpp"
#include "tools/figures/flight_figures.hpp"
#include "tools/figures/forest_figure.hpp"
#include "tools/figures/group_figures.hpp"
#include "tools/figures/run_figures.hpp"
#include "tools/run/predictions_csv.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::json;

/// JSON Schema, as far as ours goes; a keyword that is not known here is a fault, too.
class Checker {
 public:
  explicit Checker(Json root) : root_(std::move(root)) {}

  std::vector<std::string> faults(const Json& value) {
    check(value, root_, "");
    return faults_;
  }

 private:
  static bool is_of(const Json& value, const std::string& type) {
    return type == "object"    ? value.is_object()
           : type == "array"   ? value.is_array()
           : type == "string"  ? value.is_string()
           : type == "boolean" ? value.is_boolean()
           : type == "integer" ? value.is_number_integer()
           : type == "number"  ? value.is_number()
                               : value.is_null();
  }

  void require(bool is_kept, const std::string& at, const std::string& keyword) {
    if (!is_kept) faults_.push_back(at + ": " + keyword);
  }

  void check(const Json& value, const Json& schema, const std::string& at) {
    for (const auto& [keyword, rule] : schema.items()) {
      if (keyword == "$ref") {
        check(value, root_.at(Json::json_pointer(rule.get<std::string>().substr(1))), at);
      } else if (keyword == "type") {
        const Json types = rule.is_array() ? rule : Json::array({rule});
        require(std::any_of(types.begin(), types.end(),
                            [&](const Json& type) { return is_of(value, type); }),
                at, keyword);
      } else if (keyword == "const") {
        require(value == rule, at, keyword);
      } else if (keyword == "enum") {
        require(std::find(rule.begin(), rule.end(), value) != rule.end(), at, keyword);
      } else if (keyword == "required") {
        for (const Json& key : rule) require(value.contains(key.get<std::string>()), at, key);
      } else if (keyword == "properties") {
        for (const auto& [key, below] : value.items()) {
          require(rule.contains(key), at, "additional " + key);
          if (rule.contains(key)) check(below, rule.at(key), at + "/" + key);
        }
      } else if (keyword == "items") {
        if (value.is_null()) continue;
        for (const Json& item : value) check(item, rule, at + "[]");
      } else if (keyword == "minItems" || keyword == "maxItems") {
        const bool is_kept = keyword == "minItems" ? value.size() >= rule : value.size() <= rule;
        require(value.is_null() || is_kept, at, keyword);
      } else if (keyword == "minimum") {
        require(value >= rule, at, keyword);
      } else if (keyword == "exclusiveMinimum") {
        require(value > rule, at, keyword);
      } else if (keyword == "maximum") {
        require(value <= rule, at, keyword);
      } else if (keyword == "pattern") {
        require(value.get<std::string>().size() == 7, at, keyword);  // the only one: of colours
      } else {
        static const std::set<std::string> words = {"$schema", "title", "description",
                                                    "definitions", "additionalProperties"};
        require(words.contains(keyword), at, "unknown keyword " + keyword);
      }
    }
  }

  Json root_;
  std::vector<std::string> faults_ = {};
};

/// One of each kind, with a name that any of their languages would trip over.
std::vector<Figure> one_of_each_kind() {
  const TempFolder temp;
  RunRecord record = scored_record();
  record.folder = temp.path();
  record.scenario.name = "a,\"b\"\n$x^2$ \xff";
  const std::vector<ViewOutcome> outcomes = {
      {1, {PatchSource::sampled, 0, 0, 2, 100.0, 90.0, 40.0}}};
  write_file_atomically(temp.path() / kPredictionsFile, predictions_csv(outcomes));
  std::vector<RunRecord> runs = {covered_record(1, {0.2, 0.4, 0.5}), covered_record(2, {0.2, 0.8}),
                                 covered_record(3, {0.1, 0.7})};
  for (RunRecord& run : runs) run.figures->ceiling = 0.9;
  const RunGroup group = group_of(runs);
  std::vector<ComparedRun> compared;
  for (const RunRecord& run : runs) {
    for (const char* const method : {"a", "b"}) {
      ComparedRun one{.scenario = "smoke", .method = method, .seed = run.scenario.seed};
      one.figures.straight_m = *method == 'a' ? 5.0 : 6.0 + static_cast<double>(one.seed);
      compared.push_back(one);
    }
  }
  return {coverage_figure({&group, 1}, Effort::metres, 0.05),
          *coverage_end_figure({&group, 1}, Effort::views, 0.05),
          *reach_figure({&group, 1}, Effort::seconds, 0.8),
          *density_figure({&group, 1}),
          *density_entropy_figure(record),
          *density_entropy_figure(record, false),
          *terms_figure(record),
          *predictions_figure(record),
          *flight_figure(made_record()),
          *tracking_figure(made_record()),
          *forest_figure(compare(compared, "a", {}), 0)};
}

TEST(Figures, EveryKindIsAsTheSchemaSays) {
  const Json schema = Json::parse(figures_schema());
  const std::vector<Figure> figures = one_of_each_kind();
  const Json written = Json::parse(figures_json(figures));
  EXPECT_EQ(Checker(schema).faults(written), std::vector<std::string>{});
  std::set<std::string> kinds;
  for (const Figure& figure : figures) kinds.insert(figure.kind);
  EXPECT_EQ(Json(kinds).size(),
            schema["definitions"]["figure"]["properties"]["kind"]["enum"].size());
  for (const char* const damage : {"/figures/0/panels/0/x/low", "/figures/0/panels/0/series/0/mark",
                                   "/figures/0/rows", "/schema"}) {
    Json damaged = written;
    damaged[Json::json_pointer(damage)] = "?";
    EXPECT_FALSE(Checker(schema).faults(damaged).empty()) << damage;
  }
  Json other = written;
  other["figures"][0]["mine"] = 1;
  EXPECT_FALSE(Checker(schema).faults(other).empty());
}

/// Rows as they stand, with quotes where RFC 4180 has them.
std::vector<std::vector<std::string>> csv_rows(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool is_quoted = false;
  for (const char c : text) {
    if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      rows.back().emplace_back();
    } else if (c == '\n' && !is_quoted) {
      rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  rows.pop_back();
  return rows;
}

TEST(Figures, TheCsvHoldsWhatTheJsonDoes) {
  for (const Figure& figure : one_of_each_kind()) {
    const Json json = Json::parse(figures_json({&figure, 1}));
    const auto rows = csv_rows(figure_csv(figure));
    EXPECT_EQ(rows[0], (std::vector<std::string>{"panel", "series", "x", "y", "low", "high"}));
    std::size_t row = 1;
    for (const Json& panel : json["figures"][0]["panels"]) {
      for (const Json& series : panel["series"]) {
        const std::size_t count = std::max(series["x"].size(), series["y"].size());
        for (std::size_t i = 0; i < count; ++i, ++row) {
          ASSERT_LT(row, rows.size());
          EXPECT_EQ(rows[row][1], series["name"]);
          for (const auto& [column, key] : {std::pair{2, "x"}, {3, "y"}, {4, "low"}, {5, "high"}}) {
            const Json known = i < series[key].size() ? series[key][i] : Json(nullptr);
            const std::string& cell = rows[row].at(static_cast<std::size_t>(column));
            EXPECT_EQ(cell.empty() ? Json(nullptr) : Json(std::stod(cell)), known) << figure.name;
          }
        }
      }
    }
    EXPECT_EQ(row, rows.size()) << figure.name;
  }
}

}  // namespace
}  // namespace gnbv
