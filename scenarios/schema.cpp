#include <cmath>
#include <nlohmann/json.hpp>

#include "scenarios/fields.hpp"
#include "scenarios/load.hpp"
#include "scenarios/values.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

/// A whole number without a decimal point.
Json bound_of(double bound) {
  if (std::isinf(bound) || bound != std::round(bound)) return bound;
  return static_cast<std::int64_t>(bound);
}

Json number_schema(const char* type, const Range& allowed) {
  return {{"type", type},
          {allowed.is_min_open ? "exclusiveMinimum" : "minimum", bound_of(allowed.min)},
          {allowed.is_max_open ? "exclusiveMaximum" : "maximum", bound_of(allowed.max)}};
}

Json array_schema(const Field& field, std::size_t min, std::size_t max) {
  return {{"type", "array"},
          {"items", number_schema("number", field.allowed)},
          {"minItems", min},
          {"maxItems", max}};
}

Json object(std::string_view meaning) {
  return {{"type", "object"},
          {"description", meaning},
          {"additionalProperties", false},
          {"properties", Json::object()}};
}

double written(const Field& field, double value) {
  return field.kind == FieldKind::angle ? degrees_of(value) : value;
}

// Without the default.

Json schema_of(const Field& field, double) { return number_schema("number", field.allowed); }
Json schema_of(const Field& field, int) { return number_schema("integer", field.allowed); }
Json schema_of(const Field&, std::uint64_t) {
  return {{"type", "integer"}, {"minimum", 0}, {"maximum", ~std::uint64_t{0}}};
}
Json schema_of(const Field&, bool) { return {{"type", "boolean"}}; }
Json schema_of(const Field& field, const std::string&) {
  Json schema = {{"type", "string"}};
  if (!field.choices.empty()) schema["enum"] = field.choices;
  if (field.kind == FieldKind::word) {
    schema["pattern"] = "^[A-Za-z0-9_][A-Za-z0-9._-]*$";
    schema["maxLength"] = kLongestWord;
  }
  return schema;
}
Json schema_of(const Field& field, const Vec3&) { return array_schema(field, 3, 3); }
Json schema_of(const Field& field, const std::vector<double>&) {
  Json schema = array_schema(field, 1, kMostNumbers);
  schema["uniqueItems"] = true;
  return schema;
}

Json default_of(const Field& field, double value) { return written(field, value); }
Json default_of(const Field& field, const Vec3& value) {
  return {written(field, value.x()), written(field, value.y()), written(field, value.z())};
}
template <typename T>
Json default_of(const Field&, const T& value) {
  return value;
}

/// Draft 7, the one that editors know. Defaults are those of the config structs.
class SchemaWriter final : public FieldVisitor {
 public:
  Json& root() { return open_.front(); }

  Form form_of(std::string_view, bool) override { return Form::both; }

  void leaf(const Field& field, const FieldValue& value) override {
    Json& schema = open_.back()["properties"][std::string(field.key)];
    std::visit(
        [&](const auto* v) {
          schema = schema_of(field, *v);
          schema["default"] = default_of(field, *v);
        },
        value);
    schema["description"] = field.meaning;
  }

  std::optional<std::size_t> begin(const Group& group) override {
    if (group.kind != Group::Kind::list) {
      open_.push_back(object(group.meaning));
      return std::nullopt;
    }
    open_.push_back({{"type", "array"},
                     {"description", group.meaning},
                     {"minItems", bound_of(group.allowed.min)},
                     {"maxItems", bound_of(group.allowed.max)}});
    return 1;  // item describes them all
  }

  void end(const Group& group) override {
    Json closed = std::move(open_.back());
    open_.pop_back();
    Json& above = open_.back();
    if (group.kind == Group::Kind::item) {
      above.emplace("items", std::move(closed));  // of the first item
      return;
    }
    Json& place = above["properties"][group.key];
    place = place.is_null() ? std::move(closed) : Json{{"oneOf", {place, std::move(closed)}}};
  }

 private:
  std::vector<Json> open_ = {object("A scenario of gnbv.")};
};

}  // namespace

std::string scenario_json_schema() {
  SchemaWriter writer;
  Scenario defaults;
  fields(Keys(writer), defaults);
  return writer.root().dump(2) + '\n';
}

}  // namespace gnbv
