#include "bench/suite/suite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "assets/random/random_structure.hpp"
#include "scenarios/document.hpp"
#include "scenarios/load.hpp"
#include "sim/core/embed.hpp"
#include "sim/core/error.hpp"
#include "sim/core/sha256.hpp"
#include "sim/core/text.hpp"

namespace gnbv {

GNBV_EMBED(builtin_suite, GNBV_SUITE);

const std::vector<std::string_view> kFreeKeys = {
    "planner.utility",     "planner.agvs",           "planner.fvs",    "planner.tour",
    "planner.oracle",      "planner.routes",         "planner.preset", "planner.symmetry",
    "planner.termination", "planner.object_bounds_m"};

namespace {

constexpr std::string_view kHead =
    "# The tasks of gnbv-bench. `gnbv bench freeze` writes this file. A changed number is a new\n"
    "# version: results name the SHA-256 of their track. docs/suite.md has the rules.\n";

/// No number of a suite is larger; a seed has 32 bits.
template <typename Number>
constexpr Number kMost = static_cast<Number>(sizeof(Number) > 4 ? 1e12 : 1e9);

/// A map of the file, key by key; what is wrong is kept.
class SuiteMap {
 public:
  SuiteMap(const YamlNode& node, std::string path, ValidationErrors& errors)
      : node_(node), path_(std::move(path)), errors_(errors) {
    if (node.kind != YamlNode::Kind::map) fault(node, "", "expects a map");
  }
  ~SuiteMap() {
    const std::vector<std::string_view> known(known_.begin(), known_.end());
    for (const YamlEntry& entry : node_.entries) {
      if (known_.contains(entry.key)) continue;
      errors_.add(entry.location, path_ + entry.key, "",
                  fmt::format("is no known key ({}known here: {})", did_you_mean(entry.key, known),
                              join(known)));
    }
  }
  SuiteMap(const SuiteMap&) = delete;
  SuiteMap& operator=(const SuiteMap&) = delete;

  const YamlNode* find(const std::string& key, bool may_be_absent = false) {
    known_.insert(key);
    const YamlNode* const found = node_.find(key);
    if (found == nullptr && !may_be_absent) fault(node_, key, "is missing");
    return found;
  }
  void read(const std::string& key, std::string& value, bool may_be_absent = false) {
    const YamlNode* const node = find(key, may_be_absent);
    if (node == nullptr) return;
    if (node->kind != YamlNode::Kind::scalar || node->text.empty()) {
      return fault(*node, key, "expects a text");
    }
    value = node->text;
  }
  template <typename Number>
  void read_number(const std::string& key, Number& value, bool may_be_absent = false) {
    const YamlNode* const node = find(key, may_be_absent);
    if (node == nullptr) return;
    const auto number = number_in<Number>(node->text);
    const bool is_read = number && node->kind == YamlNode::Kind::scalar && !node->is_quoted;
    if (!is_read || !(*number >= Number{0}) || *number > kMost<Number>) {
      return fault(*node, key, "expects a number, 0 or more");
    }
    value = *number;
  }
  void read_number(const std::string& key, std::optional<double>& value) {
    if (find(key, true) != nullptr) read_number(key, value.emplace());
  }
  void read(const std::string& key, std::vector<std::string>& list) {
    const YamlNode* const node = find(key, true);
    if (node == nullptr) return;
    if (node->kind != YamlNode::Kind::list) return fault(*node, key, "expects a list of texts");
    for (const YamlNode& item : node->items) {
      if (item.kind != YamlNode::Kind::scalar) fault(item, key, "expects a text");
      list.push_back(item.text);
    }
  }
  void fault(const YamlNode& node, const std::string& key, const std::string& what) {
    errors_.add(node.location, path_ + key, excerpt(node), what);
  }
  void fault(const std::string& key, const std::string& what) {
    const YamlNode* const found = node_.find(key);
    fault(found != nullptr ? *found : node_, key, what);
  }

 private:
  const YamlNode& node_;
  std::string path_;
  ValidationErrors& errors_;
  std::set<std::string> known_;
};

void read_structure(SuiteMap& map, const std::string& drawn_from, SuiteStructure& structure) {
  map.read("name", structure.name);
  map.read("set", structure.set);
  map.read("scenario", structure.scenario);
  map.read("random", structure.random, true);
  map.read_number("seed", structure.seed, structure.random.empty());
  map.read_number("draw", structure.draw, true);
  map.read("sha256", structure.sha256, true);
  map.read("settings", structure.settings);
  const auto known = builtin_scenario_names();
  if (!structure.scenario.empty() && std::ranges::count(known, structure.scenario) == 0) {
    map.fault("scenario", "is no built-in scenario");
  }
  const std::string_view kind = structure.random;
  if (!kind.empty() && std::ranges::count(kRandomKinds, kind) == 0) {
    return map.fault("random", fmt::format("is no kind ({})", join(kRandomKinds)));
  }
  if (structure.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-") !=
      std::string::npos) {
    map.fault("name", "expects small letters, digits, _ and -");
  }
  if (structure.draw > 0 && structure.seed != drawn_seed(drawn_from, kind, structure.draw)) {
    map.fault("seed", fmt::format("does not follow from drawn_from and draw, which give {}",
                                  drawn_seed(drawn_from, kind, structure.draw)));
  }
}

void read_track(SuiteMap& map, SuiteTrack& track) {
  std::string effort;
  map.read("name", track.name);
  map.read("what", track.what);
  map.read("effort", effort);
  map.read("free", track.free);
  map.read("settings", track.settings);
  track.effort = effort == "seconds" ? Effort::seconds_with_profile : Effort::metres;
  if (effort != "seconds" && effort != "metres") map.fault("effort", "expects metres or seconds");
}

void read_task(SuiteMap& map, SuiteTask& task) {
  map.read("track", task.track);
  map.read("structure", task.structure);
  map.read_number("budget", task.budget);
  map.read_number("ceiling", task.ceiling);
  map.read_number("best", task.best);
  map.read("best_planner", task.best_planner, true);
  if (task.budget <= 0.0) map.fault("budget", "expects a number above 0");
  if (task.best && *task.best <= 0.0) map.fault("best", "expects a number above 0");
}

/// Reads a list of maps; each has a name that no other has.
template <typename Item, typename Read, typename Name>
void read_list(SuiteMap& root, const std::string& key, ValidationErrors& errors,
               std::vector<Item>& items, const Read& read, const Name& name) {
  const YamlNode* const list = root.find(key);
  if (list == nullptr) return;
  if (list->kind != YamlNode::Kind::list) return root.fault(*list, key, "expects a list");
  std::set<std::string> seen;
  for (const YamlNode& node : list->items) {
    SuiteMap map(node, fmt::format("{}.{}.", key, items.size()), errors);
    read(map, items.emplace_back());
    if (!seen.insert(name(items.back())).second) map.fault(node, "", "stands there twice");
  }
}

std::string listed(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + yaml_in_quotes(text);
  return "[" + list + "]";
}

std::string key_value(std::string_view key, const std::string& value) {
  return value.empty() || value == "[]" ? "" : fmt::format(", {}: {}", key, value);
}

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "";
}

}  // namespace

const SuiteTrack& Suite::track(std::string_view name) const {
  std::vector<std::string_view> names;
  for (const SuiteTrack& track : tracks) {
    if (track.name == name) return track;
    names.push_back(track.name);
  }
  throw BadInput("track '{}': is none of the suite ({}allowed: {})", name,
                 did_you_mean(name, names), join(names));
}

const SuiteStructure& Suite::structure_of(const SuiteTask& task) const {
  const auto at = std::ranges::find(structures, task.structure, &SuiteStructure::name);
  GNBV_CHECK(at != structures.end(), "no structure {}", task.structure);
  return *at;
}

std::vector<SuiteTask> Suite::tasks_of(std::string_view track) const {
  std::vector<SuiteTask> own;
  std::ranges::copy_if(tasks, std::back_inserter(own),
                       [&](const SuiteTask& task) { return task.track == track; });
  return own;
}

Suite read_suite(const std::string& text, const std::string& file) {
  ValidationErrors errors;
  const std::optional<YamlNode> node = parse_document(text, {file, 1, 0}, errors);
  errors.throw_if_any();
  GNBV_CHECK(node.has_value(), "no tree and no fault in {}", file);
  Suite suite;
  {
    SuiteMap root(*node, "", errors);
    std::string name;
    root.read("suite", name);
    if (name != "gnbv") root.fault("suite", "expects gnbv: is no suite of this program");
    root.read_number("version", suite.version);
    root.read("drawn_from", suite.drawn_from, true);
    read_list(
        root, "structures", errors, suite.structures,
        [&](SuiteMap& map, SuiteStructure& s) { read_structure(map, suite.drawn_from, s); },
        [](const SuiteStructure& s) { return s.name; });
    read_list(root, "tracks", errors, suite.tracks, read_track,
              [](const SuiteTrack& t) { return t.name; });
    const auto read_known_task = [&](SuiteMap& map, SuiteTask& task) {
      read_task(map, task);
      if (std::ranges::count(suite.tracks, task.track, &SuiteTrack::name) == 0) {
        map.fault("track", "is none of the tracks");
      }
      if (std::ranges::count(suite.structures, task.structure, &SuiteStructure::name) == 0) {
        map.fault("structure", "is none of the structures");
      }
    };
    read_list(root, "tasks", errors, suite.tasks, read_known_task,
              [](const SuiteTask& t) { return t.track + " " + t.structure; });
  }
  errors.throw_if_any();
  return suite;
}

std::string suite_yaml(const Suite& suite) {
  std::string yaml = fmt::format("{}suite: gnbv\nversion: {}\n", kHead, suite.version);
  if (!suite.drawn_from.empty()) yaml += fmt::format("drawn_from: \"{}\"\n", suite.drawn_from);
  yaml += "structures:\n";
  for (const SuiteStructure& s : suite.structures) {
    const bool is_random = !s.random.empty();
    yaml += fmt::format("  - {{name: {}, set: {}, scenario: {}{}{}{}{}{}}}\n", s.name, s.set,
                        s.scenario, key_value("random", s.random),
                        is_random ? fmt::format(", seed: {}", s.seed) : "",
                        s.draw > 0 ? fmt::format(", draw: {}", s.draw) : "",
                        key_value("sha256", s.sha256.empty() ? "" : '"' + s.sha256 + '"'),
                        key_value("settings", listed(s.settings)));
  }
  yaml += "tracks:\n";
  for (const SuiteTrack& t : suite.tracks) {
    yaml +=
        fmt::format("  - {{name: {}, effort: {}, what: {}{}{}}}\n", t.name,
                    t.effort == Effort::metres ? "metres" : "seconds", yaml_in_quotes(t.what),
                    key_value("free", listed(t.free)), key_value("settings", listed(t.settings)));
  }
  yaml += "tasks:\n";
  for (const SuiteTask& t : suite.tasks) {
    yaml +=
        fmt::format("  - {{track: {}, structure: {}, budget: {}{}{}{}}}\n", t.track, t.structure,
                    t.budget, key_value("ceiling", number(t.ceiling)),
                    key_value("best", number(t.best)), key_value("best_planner", t.best_planner));
  }
  return yaml;
}

std::string track_sha256(const Suite& suite, std::string_view track) {
  Suite own = suite;
  own.tracks = {suite.track(track)};
  own.tasks = suite.tasks_of(track);
  std::erase_if(own.structures, [&](const SuiteStructure& structure) {
    return std::ranges::count(own.tasks, structure.name, &SuiteTask::structure) == 0;
  });
  return sha256_of(suite_yaml(own));
}

}  // namespace gnbv
