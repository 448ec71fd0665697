#include "tools/sweep/read_methods.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenarios/document.hpp"
#include "sim/core/error.hpp"
#include "tools/mission/user_function.hpp"

namespace gnbv {
namespace {

using Kind = YamlNode::Kind;

// What two methods of one name make with a grid of thousands of points is told in few words.
constexpr std::size_t kMostNamed = 20;

struct NamedSettings {
  std::string name;
  Settings settings;
};

class MethodReader {
 public:
  MethodReader(const std::filesystem::path& folder, SweepYaml& yaml)
      : folder_(folder), yaml_(yaml) {}

  std::vector<SweepMethod> read(const YamlNode& root) {
    std::vector<NamedSettings> bases = read_utilities(root);
    for (NamedSettings& base : read_presets(root)) {
      bases.push_back(std::move(base));
    }
    for (NamedSettings& base : read_variants(root.find("variants"))) {
      bases.push_back(std::move(base));
    }
    refuse_double_keys(root.find("grid"), bases);
    if (bases.empty()) bases.push_back({"", {}});
    const std::vector<NamedSettings> points = read_grid(root.find("grid"));
    if (bases.size() * points.size() > kMaxCells) {
      yaml_.fault(*root.find("grid"), "grid", fmt::format("makes more than {} methods", kMaxCells));
      return {};
    }
    std::vector<SweepMethod> methods;
    std::set<std::string> names;
    std::size_t twice = 0;
    for (const NamedSettings& base : bases) {
      for (const NamedSettings& point : points) {
        Settings settings = base.settings;
        settings.add(point.settings);
        std::string name = base.name;
        if (!point.name.empty()) name += (name.empty() ? "" : " ") + point.name;
        if (name.empty()) name = "default";
        if (!names.insert(name).second && twice++ < kMostNamed) {
          yaml_.fault(root, "", fmt::format("the name '{}' is given twice", name));
        }
        methods.push_back({name, std::move(settings.overrides), std::move(settings.sources)});
      }
    }
    return methods;
  }

 private:
  struct GivenName {
    const YamlNode& node;
    std::string path, name;
  };
  std::vector<GivenName> names_in(const YamlNode& root, const std::string& section) {
    const YamlNode* const list = root.find(section);
    if (list == nullptr) return {};
    std::vector<GivenName> names;
    int index = 0;
    for (const YamlNode* node : yaml_.items_of(*list, section)) {
      const std::string path = fmt::format("{}.{}", section, index++);
      const std::string name = yaml_.text_of(node, path, "a name");
      if (!name.empty()) names.push_back({*node, path, name});
    }
    return names;
  }

  std::vector<NamedSettings> read_presets(const YamlNode& root) {
    std::vector<NamedSettings> bases;
    for (const GivenName& given : names_in(root, "presets")) {
      bases.push_back({given.name, {}});
      bases.back().settings.add("planner.preset=" + flow_yaml(given.node), given.node.location);
    }
    return bases;
  }

  std::vector<NamedSettings> read_utilities(const YamlNode& root) {
    std::vector<NamedMethod> methods;
    std::vector<SourceLocation> locations;
    for (const GivenName& given : names_in(root, "utilities")) {
      try {
        methods.push_back(named_method(given.name, "utilities", folder_));
        locations.push_back(given.node.location);
      } catch (const BadInput& error) {
        yaml_.fault(given.node, given.path, error.what());
      }
    }
    tell_apart(methods);
    std::vector<NamedSettings> bases;
    for (std::size_t i = 0; i < methods.size(); ++i) {
      bases.push_back({std::move(methods[i].label), {}});
      for (Override& set : methods[i].overrides) {
        bases.back().settings.add(std::move(set.text), locations[i]);
      }
    }
    return bases;
  }

  std::vector<NamedSettings> read_variants(const YamlNode* list) {
    std::vector<NamedSettings> bases;
    if (list == nullptr) return bases;
    int index = 0;
    for (const YamlNode* node : yaml_.items_of(*list, "variants")) {
      const std::string path = fmt::format("variants.{}", index++);
      if (!yaml_.require_map(*node, path, {"name", "set"})) continue;
      if (node->find("name") == nullptr) yaml_.fault(*node, path, "has no key 'name'");
      const std::string name = yaml_.text_of(node->find("name"), path + ".name", "a name");
      Settings settings = yaml_.settings_of(node->find("set"), path + ".set");
      if (!name.empty()) bases.push_back({name, std::move(settings)});
    }
    return bases;
  }

  /// The points of the grid, its last key fastest; one point without a name when there is none.
  std::vector<NamedSettings> read_grid(const YamlNode* grid) {
    std::vector<NamedSettings> points = {{"", {}}};
    if (grid == nullptr) return points;
    if (grid->kind != Kind::map) {
      yaml_.fault(*grid, "grid", "expects a map of scenario keys, each with a list of values");
      return points;
    }
    for (const YamlEntry& entry : grid->entries) {
      const std::string path = "grid." + entry.key;
      const auto values = values_of(entry.value, path);
      if (entry.key == "seed") yaml_.fault(entry.value, path, "seeds are given by the key 'seeds'");
      if (values.empty() || entry.key == "seed") continue;
      if (points.size() * values.size() > kMaxCells) {
        yaml_.fault(*grid, "grid", fmt::format("has more than {} points", kMaxCells));
        return {{"", {}}};
      }
      const std::string label = short_name(*grid, entry.key);
      std::vector<NamedSettings> next;
      for (const NamedSettings& point : points) {
        for (const YamlNode* value : values) {
          const std::string text = flow_yaml(*value);
          NamedSettings added = point;
          added.name += fmt::format("{}{}={}", point.name.empty() ? "" : " ", label, text);
          added.settings.add(fmt::format("{}={}", entry.key, text), value->location);
          next.push_back(std::move(added));
        }
      }
      points = std::move(next);
    }
    return points;
  }

  /// Each once.
  std::vector<const YamlNode*> values_of(const YamlNode& list, const std::string& path) {
    std::vector<const YamlNode*> values = yaml_.items_of(list, path);
    std::set<std::string> texts;
    std::erase_if(values, [&](const YamlNode* value) {
      const std::string text = flow_yaml(*value);
      if (texts.insert(text).second) return false;
      yaml_.fault(*value, path, fmt::format("the value '{}' is given twice", text));
      return true;
    });
    return values;
  }

  /// Whether setting one of the keys sets the other, or a part of it.
  static bool overlap(const std::string& a, const std::string& b) {
    return a == b || a.starts_with(b + '.') || b.starts_with(a + '.');
  }

  /// The grid comes last: what a method says by the same key would count for nothing.
  void refuse_double_keys(const YamlNode* grid, const std::vector<NamedSettings>& bases) {
    if (grid == nullptr || grid->kind != Kind::map) return;
    for (const YamlEntry& entry : grid->entries) {
      for (const NamedSettings& base : bases) {
        const auto& set = base.settings.overrides;
        const auto text = std::find_if(set.begin(), set.end(), [&](const std::string& one) {
          return overlap(one.substr(0, one.find('=')), entry.key);
        });
        if (text == set.end()) continue;
        yaml_.fault(entry.value, "grid." + entry.key,
                    fmt::format("the method '{}' sets {}, too", base.name,
                                text->substr(0, text->find('='))));
        break;  // one is enough to see it
      }
    }
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

  const std::filesystem::path& folder_;
  SweepYaml& yaml_;
};

}  // namespace

std::vector<SweepMethod> read_methods(const YamlNode& root, const std::filesystem::path& folder,
                                      SweepYaml& yaml) {
  return MethodReader(folder, yaml).read(root);
}

}  // namespace gnbv
