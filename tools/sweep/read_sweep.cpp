#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "tools/sweep/sweep_yaml.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Kind = YamlNode::Kind;

class SweepReader {
 public:
  explicit SweepReader(const fs::path& yaml)
      : yaml_(yaml), folder_(fs::absolute(yaml).parent_path()), values_(yaml.string()) {}

  Sweep read() {
    const std::optional<YamlNode> root =
        parse_document(read_file(yaml_), {yaml_.string(), 1, 0}, values_.errors());
    if (!root) values_.errors().throw_if_any();
    GNBV_CHECK(root.has_value(), "no tree and no fault in {}", yaml_.string());
    sweep_.folder = folder_;
    if (values_.require_map(
            *root, "", {"scenarios", "utilities", "presets", "variants", "grid", "set", "seeds"})) {
      read_scenarios(*root);
      sweep_.methods = read_methods(*root, folder_, values_);
      read_seeds(root->find("seeds"));
      refuse_too_many(*root);
    }
    if (!values_.errors().empty()) throw_with_faults_of_cells();
    return std::move(sweep_);
  }

 private:
  /// What can be said about the cells is said at once, too.
  [[noreturn]] void throw_with_faults_of_cells() {
    std::string text;
    try {
      values_.errors().throw_if_any();
    } catch (const BadInput& error) {
      text = error.what();
    }
    sweep_.seeds = {1};  // a seed changes none of them, and its own fault is among those above
    try {
      if (cell_count(sweep_) <= kMaxCells) cells_of(sweep_);
    } catch (const BadInput& error) {
      text += fmt::format("\n{}", error.what());
    }
    throw BadInput(in_order_of_lines(text));
  }

  std::string absolute(const std::string& path) const {
    return fs::absolute(folder_ / path).lexically_normal().string();
  }

  // ---- scenarios

  void read_scenarios(const YamlNode& root) {
    const YamlNode* const list = root.find("scenarios");
    if (list == nullptr) return values_.fault(root, "scenarios", "is missing: which scenarios?");
    const std::vector<Override> common = values_.settings_of(root.find("set"), "set");
    std::set<std::string> names;
    int index = 0;
    for (const YamlNode* node : values_.items_of(list, "scenarios")) {
      const std::string path = fmt::format("scenarios.{}", index++);
      SweepScenario scenario{.overrides = common};
      if (node->kind == Kind::map) {
        read_scenario_map(*node, path, scenario);
      } else {
        scenario.scenario = scenario_of(node, path);
        scenario.name = fs::path(scenario.scenario).stem().string();
      }
      if (scenario.scenario.empty()) continue;  // named already
      if (!names.insert(scenario.name).second) {
        values_.fault(*node, path, fmt::format("the name '{}' is given twice", scenario.name));
      }
      sweep_.scenarios.push_back(std::move(scenario));
    }
  }

  void read_scenario_map(const YamlNode& node, const std::string& path, SweepScenario& scenario) {
    values_.require_map(node, path, {"name", "scenario", "mesh", "bounds", "set"});
    if (node.find("scenario") == nullptr) values_.fault(node, path, "has no key 'scenario'");
    scenario.scenario = scenario_of(node.find("scenario"), path + ".scenario");
    const std::string mesh =
        values_.text_of(node.find("mesh"), path + ".mesh", "the path of a mesh");
    if (!mesh.empty() && fs::exists(absolute(mesh))) {  // a file, or the folder of a model
      scenario.mesh = absolute(mesh);
    } else if (!mesh.empty()) {
      values_.fault(*node.find("mesh"), path + ".mesh", "no such file");
    }
    if (const YamlNode* const bounds = node.find("bounds")) {
      scenario.bounds_auto = bounds->text == "auto";
      if (bounds->text != "auto" && bounds->text != "scenario") {
        values_.fault(*bounds, path + ".bounds", "expects auto or scenario");
      }
    }
    const std::vector<Override> own = values_.settings_of(node.find("set"), path + ".set");
    scenario.overrides.insert(scenario.overrides.end(), own.begin(), own.end());
    scenario.name = values_.text_of(node.find("name"), path + ".name", "a name");
    if (scenario.name.empty()) {
      scenario.name = fs::path(mesh.empty() ? scenario.scenario : mesh).stem().string();
    }
  }

  /// A built-in name stays; a path becomes absolute; "" where it is neither, which is a fault.
  std::string scenario_of(const YamlNode* node, const std::string& path) {
    const std::string name =
        values_.text_of(node, path, "the name of a built-in scenario or the path of one");
    const std::vector<std::string> builtin = builtin_scenario_names();
    if (name.empty() || std::find(builtin.begin(), builtin.end(), name) != builtin.end()) {
      return name;
    }
    if (fs::is_regular_file(absolute(name))) return absolute(name);
    const std::vector<std::string_view> names(builtin.begin(), builtin.end());
    values_.fault(*node, path,
                  fmt::format("no such file, and no built-in scenario ({}built in: {})",
                              did_you_mean(name, names), join(names)));
    return "";
  }

  // ---- seeds

  std::optional<std::uint64_t> read_seed(const YamlNode& node, const std::string& path) {
    const auto value = number_in<std::uint64_t>(node.text);
    if (value && node.kind == Kind::scalar && !node.is_quoted) return value;
    values_.fault(node, path, "expects a whole number, 0 or more");
    return std::nullopt;
  }

  void read_seeds(const YamlNode* node) {
    if (node == nullptr) {
      sweep_.seeds = {1};
      return;
    }
    if (node->kind != Kind::list) {
      const auto count = read_seed(*node, "seeds");
      if (count && (*count == 0 || *count > kMaxCells)) {
        values_.fault(*node, "seeds",
                      fmt::format("is out of range (allowed: from 1 to {})", kMaxCells));
      } else if (count) {
        for (std::uint64_t seed = 1; seed <= *count; ++seed) sweep_.seeds.push_back(seed);
      }
      return;
    }
    std::set<std::uint64_t> seen;
    int index = 0;
    for (const YamlNode* item : values_.items_of(node, "seeds")) {
      const std::string path = fmt::format("seeds.{}", index++);
      const auto seed = read_seed(*item, path);
      if (!seed) continue;
      if (!seen.insert(*seed).second) values_.fault(*item, path, "is given twice");
      sweep_.seeds.push_back(*seed);
    }
  }

  /// At the first of these keys that is there: what is multiplied last.
  void refuse_too_many(const YamlNode& root) {
    if (cell_count(sweep_) <= kMaxCells) return;
    for (const char* key : {"seeds", "grid", "variants", "utilities", "scenarios"}) {
      if (root.find(key) == nullptr) continue;
      return values_.fault(
          *root.find(key), key,
          fmt::format("makes {} cells of the sweep, more than {}", cell_count(sweep_), kMaxCells));
    }
  }

  const fs::path& yaml_;
  const fs::path folder_;
  SweepYaml values_;
  Sweep sweep_;
};

}  // namespace

Sweep read_sweep(const fs::path& yaml) { return SweepReader(yaml).read(); }

}  // namespace gnbv
