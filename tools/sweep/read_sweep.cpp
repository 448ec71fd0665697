#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

#include "scenarios/document.hpp"
#include "scenarios/faults.hpp"
#include "scenarios/flow_yaml.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/sweep/sweep.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Kind = YamlNode::Kind;
using Keys = std::initializer_list<std::string_view>;

/// Overrides with where they were given.
struct Settings {
  std::vector<std::string> overrides;
  std::vector<std::string> sources;

  void add(std::string text, const Origin& origin) {
    overrides.push_back(std::move(text));
    sources.push_back(text_of(origin));
  }
  void add(const Settings& others) {
    overrides.insert(overrides.end(), others.overrides.begin(), others.overrides.end());
    sources.insert(sources.end(), others.sources.begin(), others.sources.end());
  }
};

struct NamedSettings {
  std::string name;
  Settings settings;
};

class SweepReader {
 public:
  explicit SweepReader(const fs::path& yaml)
      : yaml_(yaml), folder_(fs::absolute(yaml).parent_path()) {}

  Sweep read() {
    const std::optional<YamlNode> root =
        parse_document(read_file(yaml_), {yaml_.string(), 1, 0}, faults_);
    if (!root) faults_.throw_if_any();
    GNBV_CHECK(root.has_value(), "no tree and no fault in {}", yaml_.string());
    sweep_.folder = folder_;
    if (require_map(*root, "",
                    {"scenarios", "utilities", "presets", "variants", "grid", "set", "seeds"})) {
      read_scenarios(*root);
      read_methods(*root);
      read_seeds(root->find("seeds"));
    }
    if (!faults_.empty()) throw_with_faults_of_cells();
    return std::move(sweep_);
  }

 private:
  /// What can be said about the cells is said at once, too.
  void throw_with_faults_of_cells() const {
    std::string text;
    try {
      faults_.throw_if_any();
    } catch (const BadInput& error) {
      text = error.what();
    }
    try {
      cells_of(sweep_);
    } catch (const BadInput& error) {
      text += fmt::format("\n{}", error.what());
    }
    throw BadInput(text);
  }

  void fault(const YamlNode& node, const std::string& path, const std::string& what) {
    Origin origin = node.origin;
    if (origin.line == 0) origin = {yaml_.string(), 1, 0};
    faults_.add(origin, path, excerpt(node), what);
  }

  /// Whether it is a map; keys that are not known are named.
  bool require_map(const YamlNode& node, const std::string& path, Keys known) {
    if (node.kind != Kind::map) {
      fault(node, path, "expects a map of keys");
      return false;
    }
    const std::vector<std::string_view> names(known);
    for (const YamlEntry& entry : node.entries) {
      if (std::find(names.begin(), names.end(), entry.key) != names.end()) continue;
      const auto near = nearest_name(entry.key, names, slip_limit(entry.key));
      faults_.add(entry.origin, path.empty() ? entry.key : path + '.' + entry.key, "",
                  near ? fmt::format("is no known key (did you mean '{}'?)", *near)
                       : fmt::format("is no known key (known here: {})", join(names)));
    }
    return true;
  }

  /// The items of a list; a single value is a list of one.
  static std::vector<const YamlNode*> items_of(const YamlNode& node) {
    std::vector<const YamlNode*> items;
    for (const YamlNode& item : node.items) items.push_back(&item);
    if (node.kind != Kind::list) items.push_back(&node);
    return items;
  }

  /// The text of a scalar; empty, and a fault, when it is none.
  std::string text_of_node(const YamlNode* node, const std::string& path, const std::string& what) {
    if (node != nullptr && node->kind == Kind::scalar && !node->text.empty()) return node->text;
    if (node != nullptr) fault(*node, path, "expects " + what);
    return "";
  }

  Settings read_settings(const YamlNode* node, const std::string& path) {
    Settings settings;
    if (node == nullptr) return settings;
    if (node->kind != Kind::map) {
      fault(*node, path, "expects a map of scenario keys, as in planner.agvs.step_m: 0.5");
      return settings;
    }
    for (const YamlEntry& entry : node->entries) {
      if (entry.key == "seed") {
        faults_.add(entry.origin, path + ".seed", "", "seeds are given by the key 'seeds'");
        continue;
      }
      settings.add(fmt::format("{}={}", entry.key, flow_yaml(entry.value)), entry.origin);
    }
    return settings;
  }

  std::string absolute(const std::string& path) const {
    return fs::absolute(folder_ / path).lexically_normal().string();
  }

  void require_unique(const std::string& name, std::set<std::string>& names, const YamlNode& node,
                      const std::string& path) {
    if (names.insert(name).second) return;
    fault(node, path, fmt::format("the name '{}' is given twice", name));
  }

  // ---- scenarios

  void read_scenarios(const YamlNode& root) {
    const YamlNode* const list = root.find("scenarios");
    if (list == nullptr) return fault(root, "scenarios", "is missing: which scenarios?");
    const Settings common = read_settings(root.find("set"), "set");
    std::set<std::string> names;
    int index = 0;
    for (const YamlNode* node : items_of(*list)) {
      const std::string path = fmt::format("scenarios.{}", index++);
      SweepScenario scenario =
          node->kind == Kind::map ? read_scenario_map(*node, path, common) : SweepScenario{};
      if (node->kind != Kind::map) {
        set_scenario(node, path, scenario);
        scenario.overrides = common.overrides;
        scenario.sources = common.sources;
        scenario.name = fs::path(scenario.scenario).stem().string();
      }
      if (scenario.scenario.empty()) continue;  // named already
      require_unique(scenario.name, names, *node, path);
      sweep_.scenarios.push_back(std::move(scenario));
    }
  }

  SweepScenario read_scenario_map(const YamlNode& node, const std::string& path,
                                  const Settings& common) {
    SweepScenario scenario;
    require_map(node, path, {"name", "scenario", "mesh", "bounds", "set"});
    const YamlNode* const base = node.find("scenario");
    if (base == nullptr) fault(node, path, "has no key 'scenario'");
    set_scenario(base, path + ".scenario", scenario);
    const std::string mesh = text_of_node(node.find("mesh"), path + ".mesh", "the path of a mesh");
    if (!mesh.empty()) {
      scenario.mesh = absolute(mesh);
      if (!fs::is_regular_file(scenario.mesh)) {
        fault(*node.find("mesh"), path + ".mesh", "no such file");
        scenario.mesh.clear();
      }
    }
    if (const YamlNode* const bounds = node.find("bounds")) {
      scenario.bounds_auto = bounds->text == "auto";
      if (bounds->text != "auto" && bounds->text != "scenario") {
        fault(*bounds, path + ".bounds", "expects auto or scenario");
      }
    }
    Settings settings = common;
    settings.add(read_settings(node.find("set"), path + ".set"));
    scenario.overrides = std::move(settings.overrides);
    scenario.sources = std::move(settings.sources);
    scenario.name = text_of_node(node.find("name"), path + ".name", "a name");
    if (scenario.name.empty()) {
      scenario.name = fs::path(mesh.empty() ? scenario.scenario : mesh).stem().string();
    }
    return scenario;
  }

  /// A built-in name stays; a path becomes absolute.
  void set_scenario(const YamlNode* node, const std::string& path, SweepScenario& scenario) {
    const std::string name =
        text_of_node(node, path, "the name of a built-in scenario or the path of one");
    if (name.empty()) return;
    const std::vector<std::string> builtin = builtin_scenario_names();
    if (std::find(builtin.begin(), builtin.end(), name) != builtin.end()) {
      scenario.scenario = name;
    } else if (fs::is_regular_file(absolute(name))) {
      scenario.scenario = absolute(name);
    } else {
      const std::vector<std::string_view> names(builtin.begin(), builtin.end());
      const auto near = nearest_name(name, names, slip_limit(name));
      fault(*node, path,
            fmt::format("no such file, and no built-in scenario ({}built in: {})",
                        near ? fmt::format("did you mean '{}'? ", *near) : "", join(names)));
    }
  }

  // ---- methods

  void read_methods(const YamlNode& root) {
    std::vector<NamedSettings> bases = named_by_value(root, "utilities", "planner.utility.name");
    for (NamedSettings& base : named_by_value(root, "presets", "planner.preset")) {
      bases.push_back(std::move(base));
    }
    for (NamedSettings& base : read_variants(root.find("variants"))) {
      bases.push_back(std::move(base));
    }
    if (bases.empty()) bases.push_back({"", {}});
    const std::vector<NamedSettings> points = read_grid(root.find("grid"));
    if (bases.size() * points.size() > kMaxCells) return;  // refused with the grid
    std::set<std::string> names;
    for (const NamedSettings& base : bases) {
      for (const NamedSettings& point : points) {
        Settings settings = base.settings;
        settings.add(point.settings);
        std::string name = base.name;
        if (!point.name.empty()) name += (name.empty() ? "" : " ") + point.name;
        if (name.empty()) name = "default";
        require_unique(name, names, root, "");
        sweep_.methods.push_back(
            {name, std::move(settings.overrides), std::move(settings.sources)});
      }
    }
  }

  std::vector<NamedSettings> named_by_value(const YamlNode& root, const std::string& section,
                                            const std::string& key) {
    std::vector<NamedSettings> bases;
    const YamlNode* const list = root.find(section);
    if (list == nullptr) return bases;
    int index = 0;
    for (const YamlNode* node : items_of(*list)) {
      const std::string name = text_of_node(node, fmt::format("{}.{}", section, index++), "a name");
      if (name.empty()) continue;
      NamedSettings base = {name, {}};
      base.settings.add(fmt::format("{}={}", key, flow_yaml(*node)), node->origin);
      bases.push_back(std::move(base));
    }
    return bases;
  }

  std::vector<NamedSettings> read_variants(const YamlNode* list) {
    std::vector<NamedSettings> bases;
    if (list == nullptr) return bases;
    int index = 0;
    for (const YamlNode* node : items_of(*list)) {
      const std::string path = fmt::format("variants.{}", index++);
      if (!require_map(*node, path, {"name", "set"})) continue;
      if (node->find("name") == nullptr) fault(*node, path, "has no key 'name'");
      const std::string name = text_of_node(node->find("name"), path + ".name", "a name");
      Settings settings = read_settings(node->find("set"), path + ".set");
      if (!name.empty()) bases.push_back({name, std::move(settings)});
    }
    return bases;
  }

  /// The points of the grid, its last key fastest; one point without a name when there is none.
  std::vector<NamedSettings> read_grid(const YamlNode* grid) {
    std::vector<NamedSettings> points = {{"", {}}};
    if (grid == nullptr) return points;
    if (grid->kind != Kind::map) {
      fault(*grid, "grid", "expects a map of scenario keys, each with a list of values");
      return points;
    }
    for (const YamlEntry& entry : grid->entries) {
      const std::string path = "grid." + entry.key;
      const auto values = items_of(entry.value);
      if (values.empty()) fault(entry.value, path, "the list is empty");
      if (entry.key == "seed") fault(entry.value, path, "seeds are given by the key 'seeds'");
      if (values.empty() || entry.key == "seed") continue;
      if (points.size() * values.size() > kMaxCells) {
        fault(*grid, "grid", fmt::format("has more than {} points", kMaxCells));
        return {{"", {}}};
      }
      const std::string label = short_name(*grid, entry.key);
      std::vector<NamedSettings> next;
      for (const NamedSettings& point : points) {
        for (const YamlNode* value : values) {
          const std::string text = flow_yaml(*value);
          NamedSettings added = point;
          added.name += fmt::format("{}{}={}", point.name.empty() ? "" : " ", label, text);
          added.settings.add(fmt::format("{}={}", entry.key, text), value->origin);
          next.push_back(std::move(added));
        }
      }
      points = std::move(next);
    }
    return points;
  }

  /// The last word of a key, or all of it where another key of the grid ends alike.
  static std::string short_name(const YamlNode& grid, const std::string& key) {
    const auto last_word = [](const std::string& path) {
      return path.substr(path.rfind('.') + 1);  // npos + 1 = 0: all of it
    };
    const bool is_unique =
        std::count_if(grid.entries.begin(), grid.entries.end(), [&](const YamlEntry& entry) {
          return last_word(entry.key) == last_word(key);
        }) == 1;
    return is_unique ? last_word(key) : key;
  }

  // ---- seeds

  std::optional<std::uint64_t> read_seed(const YamlNode& node, const std::string& path) {
    std::uint64_t value = 0;
    const char* const end = node.text.data() + node.text.size();
    const auto [last, error] = std::from_chars(node.text.data(), end, value);
    const bool is_plain = node.kind == Kind::scalar && !node.is_quoted && !node.text.empty();
    if (is_plain && error == std::errc{} && last == end) return value;
    fault(node, path, "expects a whole number, 0 or more");
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
        fault(*node, "seeds", fmt::format("is out of range (allowed: from 1 to {})", kMaxCells));
      } else if (count) {
        for (std::uint64_t seed = 1; seed <= *count; ++seed) sweep_.seeds.push_back(seed);
      }
    } else if (node->items.empty()) {
      fault(*node, "seeds", "the list is empty");
    }
    std::set<std::uint64_t> seen;
    for (std::size_t i = 0; i < node->items.size(); ++i) {
      const std::string path = fmt::format("seeds.{}", i);
      const auto seed = read_seed(node->items[i], path);
      if (!seed) continue;
      if (!seen.insert(*seed).second) fault(node->items[i], path, "is given twice");
      sweep_.seeds.push_back(*seed);
    }
    if (cell_count(sweep_) > kMaxCells) {
      fault(
          *node, "seeds",
          fmt::format("makes {} cells of the sweep, more than {}", cell_count(sweep_), kMaxCells));
      sweep_.seeds.resize(1);
    }
  }

  const fs::path& yaml_;
  const fs::path folder_;
  Faults faults_;
  Sweep sweep_;
};

}  // namespace

Sweep read_sweep(const fs::path& yaml) { return SweepReader(yaml).read(); }

}  // namespace gnbv
