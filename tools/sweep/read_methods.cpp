#include <fmt/format.h>

#include <algorithm>

#include "sim/core/error.hpp"
#include "tools/sweep/sweep_yaml.hpp"

namespace gnbv {
namespace {

// What two methods of one name make with a grid of thousands of points is told in few words.
constexpr std::size_t kMostNamed = 20;

void append(std::vector<Override>& overrides, const std::vector<Override>& more) {
  overrides.insert(overrides.end(), more.begin(), more.end());
}

class MethodReader {
 public:
  MethodReader(const YamlNode& root, const std::filesystem::path& folder, SweepYaml& yaml)
      : root_(root), grid_(root.find("grid")), folder_(folder), yaml_(yaml) {}

  std::vector<SweepMethod> read() {
    std::vector<SweepMethod> bases = read_utilities();
    read_presets(bases);
    read_variants(bases);
    refuse_double_keys(bases);
    if (bases.empty()) bases.push_back({});
    const std::vector<SweepMethod> points = read_grid();
    if (bases.size() * points.size() > kMaxCells) {
      yaml_.fault(*grid_, "grid", fmt::format("makes more than {} methods", kMaxCells));
      return {};
    }
    std::vector<SweepMethod> methods;
    std::set<std::string> names;
    std::size_t twice = 0;
    for (const SweepMethod& base : bases) {
      for (const SweepMethod& point : points) {
        SweepMethod& method = methods.emplace_back(base);
        append(method.overrides, point.overrides);
        method.name += (base.name.empty() || point.name.empty() ? "" : " ") + point.name;
        if (method.name.empty()) method.name = "default";
        if (!names.insert(method.name).second && twice++ < kMostNamed) {
          yaml_.fault(root_, "", fmt::format("the name '{}' is given twice", method.name));
        }
      }
    }
    return methods;
  }

 private:
  std::vector<SweepMethod> read_utilities() {
    std::vector<SweepMethod> methods;
    int index = 0;
    for (const YamlNode* node : yaml_.items_of(root_.find("utilities"), "utilities")) {
      const std::string path = fmt::format("utilities.{}", index++);
      const std::string name = yaml_.text_of(node, path, "a name");
      if (name.empty()) continue;
      try {
        methods.push_back(named_method(name, "utilities", folder_));
        for (Override& set : methods.back().overrides) set.source = text_of(node->location);
      } catch (const BadInput& error) {
        yaml_.fault(*node, path, error.what());
      }
    }
    tell_apart(methods);
    return methods;
  }

  void read_presets(std::vector<SweepMethod>& bases) {
    int index = 0;
    for (const YamlNode* node : yaml_.items_of(root_.find("presets"), "presets")) {
      const std::string name = yaml_.text_of(node, fmt::format("presets.{}", index++), "a name");
      if (name.empty()) continue;
      bases.push_back({name, {{"planner.preset=" + flow_yaml(*node), text_of(node->location)}}});
    }
  }

  void read_variants(std::vector<SweepMethod>& bases) {
    int index = 0;
    for (const YamlNode* node : yaml_.items_of(root_.find("variants"), "variants")) {
      const std::string path = fmt::format("variants.{}", index++);
      if (!yaml_.require_map(*node, path, {"name", "set"})) continue;
      if (node->find("name") == nullptr) yaml_.fault(*node, path, "has no key 'name'");
      const std::string name = yaml_.text_of(node->find("name"), path + ".name", "a name");
      std::vector<Override> settings = yaml_.settings_of(node->find("set"), path + ".set");
      if (!name.empty()) bases.push_back({name, std::move(settings)});
    }
  }

  /// The points of the grid, its last key fastest; one point without a name when there is none.
  std::vector<SweepMethod> read_grid() {
    std::vector<SweepMethod> points(1);
    if (grid_ == nullptr) return points;
    if (grid_->kind != YamlNode::Kind::map) {
      yaml_.fault(*grid_, "grid", "expects a map of scenario keys, each with a list of values");
      return points;
    }
    for (const YamlEntry& entry : grid_->entries) {
      const std::string path = "grid." + entry.key;
      const auto values = values_of(entry.value, path);
      if (entry.key == "seed") yaml_.fault(entry.value, path, "seeds are given by the key 'seeds'");
      if (values.empty() || entry.key == "seed") continue;
      if (points.size() * values.size() > kMaxCells) {
        yaml_.fault(*grid_, "grid", fmt::format("has more than {} points", kMaxCells));
        return std::vector<SweepMethod>(1);
      }
      const std::string label = short_name(entry.key);
      std::vector<SweepMethod> next;
      for (const SweepMethod& point : points) {
        for (const YamlNode* value : values) {
          const std::string text = flow_yaml(*value);
          SweepMethod& added = next.emplace_back(point);
          added.name += fmt::format("{}{}={}", point.name.empty() ? "" : " ", label, text);
          added.overrides.push_back({entry.key + "=" + text, text_of(value->location)});
        }
      }
      points = std::move(next);
    }
    return points;
  }

  /// Each once.
  std::vector<const YamlNode*> values_of(const YamlNode& list, const std::string& path) {
    std::vector<const YamlNode*> values = yaml_.items_of(&list, path);
    std::set<std::string> texts;
    std::erase_if(values, [&](const YamlNode* value) {
      const std::string text = flow_yaml(*value);
      if (texts.insert(text).second) return false;
      yaml_.fault(*value, path, fmt::format("the value '{}' is given twice", text));
      return true;
    });
    return values;
  }

  /// The grid comes last: what a method says by the same key, or by a part of it, would count for
  /// nothing.
  void refuse_double_keys(const std::vector<SweepMethod>& bases) {
    if (grid_ == nullptr || grid_->kind != YamlNode::Kind::map) return;
    for (const YamlEntry& entry : grid_->entries) {
      const auto key_set_twice = [&](const SweepMethod& base) -> std::string {
        for (const Override& set : base.overrides) {
          const std::string key = set.text.substr(0, set.text.find('='));
          if (is_at_or_below(key, entry.key) || is_at_or_below(entry.key, key)) return key;
        }
        return "";
      };
      for (const SweepMethod& base : bases) {
        const std::string key = key_set_twice(base);
        if (key.empty()) continue;
        yaml_.fault(entry.value, "grid." + entry.key,
                    fmt::format("the method '{}' sets {}, too", base.name, key));
        break;  // one is enough to see it
      }
    }
  }

  /// The last word of a key, or all of it where another key of the grid ends alike.
  std::string short_name(const std::string& key) const {
    const auto last_word = [](const std::string& path) {
      return path.substr(path.rfind('.') + 1);  // npos + 1 = 0: all of it
    };
    const bool is_unique =
        std::count_if(grid_->entries.begin(), grid_->entries.end(), [&](const YamlEntry& entry) {
          return last_word(entry.key) == last_word(key);
        }) == 1;
    return is_unique ? last_word(key) : key;
  }

  const YamlNode& root_;
  const YamlNode* grid_;
  const std::filesystem::path& folder_;
  SweepYaml& yaml_;
};

}  // namespace

std::vector<SweepMethod> read_methods(const YamlNode& root, const std::filesystem::path& folder,
                                      SweepYaml& yaml) {
  return MethodReader(root, folder, yaml).read();
}

}  // namespace gnbv
