#include "tools/sweep/sweep_yaml.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <utility>

namespace gnbv {
namespace {

/// "file:12: what" is in line 12 of the file; line 0 without one.
std::pair<std::string, int> place_of(const std::string& fault) {
  for (std::size_t at = fault.find(':'); at != std::string::npos; at = fault.find(':', at + 1)) {
    int line = 0;
    const char* const end = fault.data() + fault.size();
    const auto read = std::from_chars(fault.data() + at + 1, end, line);
    if (read.ec == std::errc{} && read.ptr != end && *read.ptr == ':') {
      return {fault.substr(0, at), line};
    }
  }
  return {"", 0};
}

}  // namespace

void SweepYaml::fault(const YamlNode& node, const std::string& path, const std::string& what) {
  const SourceLocation location =
      node.location.line > 0 ? node.location : SourceLocation{file_, 1, 0};
  errors_.add(location, path, excerpt(node), what);
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
    const auto near = nearest_name(entry.key, names);
    errors_.add(entry.location, path.empty() ? entry.key : path + '.' + entry.key, "",
                near ? fmt::format("is no known key (did you mean '{}'?)", *near)
                     : fmt::format("is no known key (known here: {})", join(names)));
  }
  return true;
}

std::vector<const YamlNode*> SweepYaml::items_of(const YamlNode* node, const std::string& path) {
  if (node == nullptr) return {};
  if (node->kind != YamlNode::Kind::list) return {node};
  std::vector<const YamlNode*> items;
  for (const YamlNode& item : node->items) items.push_back(&item);
  if (items.empty()) fault(*node, path, "the list is empty");
  return items;
}

std::string SweepYaml::text_of(const YamlNode* node, const std::string& path,
                               const std::string& what) {
  if (node == nullptr) return "";
  if (node->kind == YamlNode::Kind::scalar && !node->text.empty()) return node->text;
  fault(*node, path, "expects " + what);
  return "";
}

std::vector<Override> SweepYaml::settings_of(const YamlNode* node, const std::string& path) {
  std::vector<Override> settings;
  if (node == nullptr) return settings;
  if (node->kind != YamlNode::Kind::map) {
    fault(*node, path, "expects a map of scenario keys, as in planner.agvs.step_m: 0.5");
    return settings;
  }
  for (const YamlEntry& entry : node->entries) {
    if (entry.key == "seed") {
      errors_.add(entry.location, path + ".seed", "", "seeds are given by the key 'seeds'");
    } else {
      settings.push_back({.text = fmt::format("{}={}", entry.key, flow_yaml(entry.value)),
                          .source = gnbv::text_of(entry.location)});
    }
  }
  return settings;
}

std::string in_order_of_lines(const std::string& faults) {
  std::vector<std::string> lines;
  std::istringstream stream(faults);
  std::set<std::string> seen;
  for (std::string line; std::getline(stream, line);) {
    if (seen.insert(line).second) lines.push_back(line);
  }
  std::stable_sort(lines.begin(), lines.end(), [](const std::string& a, const std::string& b) {
    return place_of(a) < place_of(b);
  });
  return fmt::format("{}", fmt::join(lines, "\n"));
}

}  // namespace gnbv
