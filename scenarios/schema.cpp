#include <cmath>
#include <nlohmann/json.hpp>

#include "scenarios/fields.hpp"
#include "scenarios/load.hpp"
#include "scenarios/values.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

Json number_schema(const char* type, const Range& allowed) {
  Json schema = {{"type", type}};
  const auto put = [&](const char* key, double bound) {
    if (!std::isfinite(bound)) return;
    if (bound == std::round(bound)) {
      schema[key] = static_cast<std::int64_t>(bound);
    } else {
      schema[key] = bound;
    }
  };
  put(allowed.is_min_open ? "exclusiveMinimum" : "minimum", allowed.min);
  put(allowed.is_max_open ? "exclusiveMaximum" : "maximum", allowed.max);
  return schema;
}

/// Draft 7, the one that editors know. Defaults are those of the config structs.
class SchemaWriter final : public FieldVisitor {
 public:
  SchemaWriter() { open_.push_back(object("A scenario of gnbv.")); }

  Json& root() { return open_.front(); }

 private:
  static Json object(std::string_view meaning) {
    return {{"type", "object"},
            {"description", meaning},
            {"additionalProperties", false},
            {"properties", Json::object()}};
  }

  Form form_of(std::string_view, bool) override { return Form::both; }

  void leaf(const Field& field, const FieldValue& value) override {
    Json schema = std::visit([&](const auto* v) { return schema_of(field, *v); }, value);
    schema["description"] = field.meaning;
    open_.back()["properties"][std::string(field.key)] = std::move(schema);
  }

  static double written(const Field& field, double value) {
    return field.kind == FieldKind::angle ? degrees_of(value) : value;
  }
  static Json schema_of(const Field& field, double value) {
    Json schema = number_schema("number", field.allowed);
    schema["default"] = written(field, value);
    return schema;
  }
  static Json schema_of(const Field& field, const Vec3& value) {
    return {{"type", "array"},
            {"items", number_schema("number", field.allowed)},
            {"minItems", 3},
            {"maxItems", 3},
            {"default",
             {written(field, value.x()), written(field, value.y()), written(field, value.z())}}};
  }
  static Json schema_of(const Field& field, const std::vector<double>& values) {
    return {{"type", "array"},     {"items", number_schema("number", field.allowed)},
            {"minItems", 1},       {"maxItems", kMostNumbers},
            {"uniqueItems", true}, {"default", values}};
  }
  static Json schema_of(const Field& field, int value) {
    Json schema = number_schema("integer", field.allowed);
    schema["default"] = value;
    return schema;
  }
  static Json schema_of(const Field&, std::uint64_t value) {
    return {{"type", "integer"},
            {"minimum", 0},
            {"maximum", std::numeric_limits<std::uint64_t>::max()},
            {"default", value}};
  }
  static Json schema_of(const Field&, bool value) {
    return {{"type", "boolean"}, {"default", value}};
  }
  static Json schema_of(const Field& field, const std::string& value) {
    Json schema = {{"type", "string"}};
    if (field.kind == FieldKind::choice) schema["enum"] = field.choices;
    if (field.kind == FieldKind::word) schema["pattern"] = "^[A-Za-z0-9_][A-Za-z0-9._-]*$";
    schema["default"] = value;
    return schema;
  }

  void begin_section(std::string_view key, std::string_view meaning) override {
    keys_.emplace_back(key);
    open_.push_back(object(meaning));
  }
  void end_section() override { close(); }

  std::optional<std::size_t> begin_list(std::string_view key, std::size_t size,
                                        const ListSize& allowed,
                                        std::string_view meaning) override {
    keys_.emplace_back(key);
    open_.push_back({{"type", "array"},
                     {"description", meaning},
                     {"minItems", allowed.min},
                     {"maxItems", allowed.max}});
    return allowed.min == allowed.max ? size : 1;  // one item describes them all
  }
  void end_list() override { close(); }

  void begin_item(std::size_t) override { open_.push_back(object("One of the list.")); }
  void end_item() override {
    Json item = std::move(open_.back());
    open_.pop_back();
    if (!open_.back().contains("items")) open_.back()["items"] = std::move(item);
  }

  void close() {
    Json closed = std::move(open_.back());
    open_.pop_back();
    Json& place = open_.back()["properties"][keys_.back()];
    place = place.is_null() ? std::move(closed) : Json{{"oneOf", {place, std::move(closed)}}};
    keys_.pop_back();
  }

  std::vector<std::string> keys_;
  std::vector<Json> open_;
};

}  // namespace

std::string scenario_json_schema() {
  SchemaWriter writer;
  Scenario defaults;
  fields(writer, defaults);
  return writer.root().dump(2) + '\n';
}

}  // namespace gnbv
