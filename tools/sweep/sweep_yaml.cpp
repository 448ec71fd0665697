#include "tools/sweep/sweep_yaml.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenarios/flow_yaml.hpp"

namespace gnbv {

void Settings::add(std::string text, const Origin& origin) {
  overrides.push_back(std::move(text));
  sources.push_back(text_of(origin));
}

void Settings::add(const Settings& others) {
  overrides.insert(overrides.end(), others.overrides.begin(), others.overrides.end());
  sources.insert(sources.end(), others.sources.begin(), others.sources.end());
}

void SweepYaml::fault(const YamlNode& node, const std::string& path, const std::string& what) {
  const Origin origin = node.origin.line > 0 ? node.origin : Origin{file_, 1, 0};
  faults_.add(origin, path, excerpt(node), what);
}

bool SweepYaml::require_map(const YamlNode& node, const std::string& path,
                            std::initializer_list<std::string_view> known) {
  if (node.kind != YamlNode::Kind::map) {
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

void SweepYaml::require_unique(const std::string& name, std::set<std::string>& names,
                               const YamlNode& node, const std::string& path) {
  if (!names.insert(name).second) {
    fault(node, path, fmt::format("the name '{}' is given twice", name));
  }
}

std::vector<const YamlNode*> SweepYaml::items_of(const YamlNode& node, const std::string& path) {
  if (node.kind != YamlNode::Kind::list) return {&node};
  std::vector<const YamlNode*> items;
  for (const YamlNode& item : node.items) items.push_back(&item);
  if (items.empty()) fault(node, path, "the list is empty");
  return items;
}

std::string SweepYaml::text_of(const YamlNode* node, const std::string& path,
                               const std::string& what) {
  if (node == nullptr) return "";
  if (node->kind == YamlNode::Kind::scalar && !node->text.empty()) return node->text;
  fault(*node, path, "expects " + what);
  return "";
}

Settings SweepYaml::settings_of(const YamlNode* node, const std::string& path) {
  Settings settings;
  if (node == nullptr) return settings;
  if (node->kind != YamlNode::Kind::map) {
    fault(*node, path, "expects a map of scenario keys, as in planner.agvs.step_m: 0.5");
    return settings;
  }
  for (const YamlEntry& entry : node->entries) {
    if (entry.key == "seed") {
      faults_.add(entry.origin, path + ".seed", "", "seeds are given by the key 'seeds'");
    } else {
      settings.add(fmt::format("{}={}", entry.key, flow_yaml(entry.value)), entry.origin);
    }
  }
  return settings;
}

}  // namespace gnbv
