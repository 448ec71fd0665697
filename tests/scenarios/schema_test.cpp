#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>

#include "scenarios/fields.hpp"
#include "scenarios/load.hpp"
#include "tests/scenarios/scenario_text.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::json;

struct Leaf {
  std::string path;
  Json schema;
};

/// As kMinimal, with one of all that the schema describes one of.
const std::string kOneOfEach = kMinimal + "planner: {routes: {views: [{}]}}\n";

/// Leaves of a schema; lists by their first item, vectors are leaves. What may be a value or a
/// section is a value by default.
void collect(const Json& schema, const std::string& path, std::vector<Leaf>& out) {
  if (schema.contains("oneOf")) {
    collect(schema.at("oneOf").at(0), path, out);
  } else if (schema.at("type") == "object") {
    for (const auto& [key, below] : schema.at("properties").items()) {
      collect(below, path.empty() ? key : fmt::format("{}.{}", path, key), out);
    }
  } else if (schema.at("type") == "array" && schema.at("items").at("type") == "object") {
    collect(schema.at("items"), path + ".0", out);
  } else {
    out.push_back({path, schema});
  }
}

std::vector<Leaf> leaves() {
  std::vector<Leaf> out;
  collect(Json::parse(scenario_json_schema()), "", out);
  return out;
}

/// An allowed number unlike the default but near it, so that it still goes with its neighbours.
double other_number(const Json& schema, double now) {
  const double low = schema.value("exclusiveMinimum", schema.value("minimum", -1e300));
  const double high = schema.value("exclusiveMaximum", schema.value("maximum", 1e300));
  if (low == -1.0 && high == 1.0) return -now;  // a rotor's spin
  for (const double candidate : {now * 0.99, now + 0.5, now - 0.5, now + 0.01}) {
    if (candidate != now && candidate > low && candidate < high) return candidate;
  }
  return 0.5 * (low + high);
}

std::string other_value(const Leaf& leaf, const std::string& mesh) {
  const Json& schema = leaf.schema;
  const Json& now = schema.at("default");
  if (schema.contains("enum")) return schema.at("enum").at(now == schema["enum"][0] ? 1 : 0);
  if (schema.at("type") == "boolean") return now.get<bool>() ? "false" : "true";
  if (schema.at("type") == "integer") return std::to_string(now.get<std::int64_t>() + 1);
  if (schema.at("type") == "number") {
    return fmt::format("{}", other_number(schema, now.get<double>()));
  }
  if (schema.at("type") == "array") {
    return fmt::format("[{}, {}, {}]", other_number(schema["items"], now[0].get<double>()),
                       now[1].get<double>(), now[2].get<double>());
  }
  return leaf.path.ends_with(".path") ? mesh : "other";
}

TEST(Schema, EveryKeyCanBeSet) {
  const ScenarioFile mesh(kMinimal);  // a file, that is all
  const ScenarioFile file(fmt::format(
      "{}start: {{position_m: [0, 0, 5]}}\nstructure: {{files: [{{path: '{}'}}]}}\n"
      "obstacles: [{{box_m: {{min: [-1, -1, -1], max: [1, 1, 1]}}, motion: {{waypoints: "
      "[{{offset_m: [1, 0, 0]}}]}}}}]\n"
      "no_fly: [{{min: [-1, -1, -1], max: [1, 1, 1]}}]\n",
      kOneOfEach, mesh.path().string()));
  // only such an estimate can have them, and nothing but it
  const ScenarioFile outages(kOneOfEach + "vehicle: {estimate: {model: gnss, outages: [{}]}}\n");
  for (const Leaf& leaf : leaves()) {
    const bool is_of_outages = leaf.path.starts_with("vehicle.estimate.outages");
    const std::string path = (is_of_outages ? outages : file).path().string();
    const auto before = scenario_values(load_scenario(path, {}));
    if (leaf.path == "obstacles.0.file.path") continue;  // a box excludes it
    if (leaf.path == "cameras.0.calibration") continue;  // names a file: Calibration has it
    // one alone leaves a vehicle that cannot hover: Layouts has them
    if (leaf.path.starts_with("vehicle.airframe.rotors")) continue;
    // the authors' first start lies below the floor of navigation
    const std::string value =
        leaf.path == "start.preset" ? "authors_south" : other_value(leaf, path);
    std::vector<std::pair<std::string, std::string>> after;
    ASSERT_NO_THROW(
        after = scenario_values(load_scenario(path, {fmt::format("{}={}", leaf.path, value)})))
        << leaf.path << '=' << value;
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_EQ(after[i].first, before[i].first);
      if (before[i].first == leaf.path) {
        EXPECT_NE(after[i].second, before[i].second) << leaf.path << '=' << value;
      } else if (!leaf.path.ends_with("preset") && leaf.path != "planner.fvs.mode" &&
                 !leaf.path.starts_with("cameras.0.fov_")) {
        // which are there to set their neighbours
        EXPECT_EQ(after[i].second, before[i].second) << leaf.path << '=' << value;
      }
    }
  }
}

TEST(Schema, NamesTheKeysOfTheFileAndTheirDefaults) {
  std::map<std::string, std::string> written;
  Scenario scenario = load_text(kOneOfEach);
  scenario.structure.files.resize(1);
  scenario.obstacles.resize(1);
  scenario.obstacles[0].motion.waypoints.resize(1);
  scenario.no_fly.resize(1);
  scenario.vehicle.estimate.outages.resize(1);
  const auto is_further_rotor = [](const std::string& path) {
    return path.find("rotors.") != path.npos && path.find("rotors.0") == path.npos;
  };
  for (const auto& [path, text] : scenario_values(scenario)) {
    if (!is_further_rotor(path)) written[path] = text;
  }
  const auto all = leaves();
  EXPECT_EQ(all.size(), written.size());
  for (const Leaf& leaf : all) {
    ASSERT_TRUE(written.contains(leaf.path)) << leaf.path;
    const std::string& text = written[leaf.path];
    const Json& value = leaf.schema.at("default");
    if (leaf.schema.at("type") == "number") {
      EXPECT_EQ(value.get<double>(), std::stod(text)) << leaf.path;
    } else if (leaf.schema.at("type") == "string") {
      EXPECT_EQ(value.get<std::string>(), text == "\"\"" ? "" : text) << leaf.path;
    } else if (leaf.schema.at("type") != "array") {
      EXPECT_EQ(value.dump(), text) << leaf.path;
    }
  }
}

TEST(Schema, EveryLeafHasTypeMeaningAndAnAllowedDefault) {
  for (const Leaf& leaf : leaves()) {
    const std::string type = leaf.schema.at("type");
    EXPECT_FALSE(leaf.schema.at("description").get<std::string>().empty()) << leaf.path;
    if (type == "number" || type == "integer") {
      const double value = leaf.schema.at("default");
      EXPECT_GE(value, leaf.schema.value("minimum", -1e300)) << leaf.path;
      EXPECT_GT(value, leaf.schema.value("exclusiveMinimum", -1e300)) << leaf.path;
      EXPECT_LE(value, leaf.schema.value("maximum", 1e300)) << leaf.path;
      EXPECT_LT(value, leaf.schema.value("exclusiveMaximum", 1e300)) << leaf.path;
      EXPECT_TRUE(leaf.schema.contains("minimum") || leaf.schema.contains("exclusiveMinimum"));
    }
    if (type == "string" && leaf.schema.contains("enum")) {
      EXPECT_THAT(leaf.schema.at("enum").get<std::vector<std::string>>(),
                  testing::Contains(leaf.schema.at("default").get<std::string>()))
          << leaf.path;
    }
  }
}

TEST(Schema, ForbidsUnknownKeysEverywhere) {
  const std::function<void(const Json&)> check = [&](const Json& schema) {
    if (schema.contains("oneOf")) {
      for (const Json& form : schema.at("oneOf")) check(form);
    } else if (schema.at("type") == "object") {
      EXPECT_EQ(schema.at("additionalProperties"), false);
      EXPECT_FALSE(schema.at("description").get<std::string>().empty());
      for (const auto& below : schema.at("properties")) check(below);
    } else if (schema.at("type") == "array") {
      check(schema.at("items"));
    }
  };
  check(Json::parse(scenario_json_schema()));
}

}  // namespace
}  // namespace gnbv
