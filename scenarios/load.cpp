#include "scenarios/load.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenarios/builtin.hpp"
#include "scenarios/document.hpp"
#include "scenarios/faults.hpp"
#include "scenarios/idle_keys.hpp"
#include "scenarios/problems.hpp"
#include "scenarios/reader.hpp"
#include "scenarios/write.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct Source {
  std::string text;
  std::string label;   // as faults show it
  std::string folder;  // where its relative paths begin
  bool is_builtin = false;
};

std::string here() { return fs::current_path().string(); }

Source open_source(const std::string& name_or_path) {
  std::vector<std::string_view> names;
  for (const BuiltinScenario& builtin : builtin_scenarios()) {
    if (builtin.name == name_or_path) {
      return {std::string(builtin.yaml), fmt::format("{} (built in)", builtin.name), here(), true};
    }
    names.push_back(builtin.name);
  }
  std::error_code ignored;
  const fs::path path = name_or_path;
  if (fs::is_directory(path, ignored)) {
    throw BadInput(fmt::format("{}: is a folder; a scenario is a YAML file or one of: {}",
                               name_or_path, join(names)));
  }
  if (!fs::exists(path, ignored)) {
    throw BadInput(fmt::format("{}: no such file, and no built-in scenario ({}built in: {})",
                               name_or_path, did_you_mean(path.stem().string(), names),
                               join(names)));
  }
  return {read_file(path), name_or_path, fs::absolute(path).parent_path().string()};
}

std::string value_of(const Scenario& scenario, const std::string& key) {
  for (const auto& [path, text] : scenario_values(scenario)) {
    if (path == key) return text;
  }
  return "";
}

/// A key and where it, or the nearest section around it, was given.
struct Culprit {
  std::string key;
  Origin origin;
  bool is_given_itself = false;
};

/// Of keys that do not go together, the one given last; of those, one given itself; of those, the
/// first. At `source` when all are at their defaults.
Culprit culprit_of(const std::vector<std::string>& keys, const Origins& origins,
                   const Origin& source) {
  Culprit culprit = {keys.front(), {source.source, 0, -1}, false};
  for (const std::string& key : keys) {
    std::string path = key;
    auto given = origins.find(path);
    while (given == origins.end() && path.find('.') != std::string::npos) {
      path.resize(path.rfind('.'));
      given = origins.find(path);
    }
    if (given == origins.end()) continue;
    const bool is_given_itself = path == key;
    if (std::pair(given->second.rank, is_given_itself) >
        std::pair(culprit.origin.rank, culprit.is_given_itself)) {
      culprit = {key, given->second, is_given_itself};
    }
  }
  return culprit;
}

/// Of any key of mesh_files().
bool is_mesh_path(std::string_view key) {
  return key.ends_with(".path") && (key.starts_with("structure.file") || key == "terrain.path" ||
                                    key.starts_with("obstacles."));
}

enum class MeshFile { has_to_be_there, may_be_missing };

/// Adds what does not go together. Keys already at fault are left out: it would only repeat them.
void add_problems(const Scenario& scenario, MeshFile mesh_file, const Origin& source,
                  const Origins& origins, Faults& faults) {
  const Faults given = faults;
  for (const Problem& problem : problems(scenario)) {
    if (mesh_file == MeshFile::may_be_missing && is_mesh_path(problem.keys.front())) {
      continue;
    }
    if (std::any_of(problem.keys.begin(), problem.keys.end(),
                    [&](const std::string& key) { return given.concerns(key); })) {
      continue;
    }
    const Culprit culprit = culprit_of(problem.keys, origins, source);
    faults.add(culprit.origin, culprit.key, value_of(scenario, culprit.key), problem.what);
  }
}

/// What was not given and is another afterwards is the filling's.
void fill_in(const Filling& filling, Scenario& scenario, Origins& origins) {
  const auto is_given = [&](std::string_view key) {
    return std::any_of(origins.begin(), origins.end(), [&](const auto& given) {
      return given.second.rank > 0 && is_at_or_below(given.first, key);
    });
  };
  const auto before = scenario_values(scenario);
  filling.fill(scenario, is_given);
  const auto after = scenario_values(scenario);
  GNBV_CHECK(before.size() == after.size(), "a filling made keys");
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (after[i] == before[i]) continue;
    const Origin origin = {filling.source, 0, 1};
    const std::string& key = after[i].first;
    origins[key] = origin;
    // problems may name the section, which is the user's if it was given
    Origin& section = origins[key.substr(0, key.find('.'))];
    if (section.rank == 0) section = origin;
  }
}

/// Whom to tell that the structure is not in the workspace, which nobody knows before its mesh is
/// read.
std::string placed_at(const Origins& origins, const Origin& source) {
  std::vector<std::string> keys = {"workspace_m.min", "workspace_m.max", "structure.builtin"};
  for (const auto& [key, given] : origins) {
    if (is_at_or_below(key, "structure.file") || is_at_or_below(key, "structure.files")) {
      keys.push_back(key);
    }
  }
  const Culprit last = culprit_of(keys, origins, source);
  const std::string& key = last.key;
  return text_of(last.origin) + ": " + (key.starts_with("workspace_m") ? "workspace_m" : key);
}

Scenario load(const std::string& name_or_path, const std::vector<Override>& overrides,
              MeshFile mesh_file, const Filling& filling, std::vector<std::string>* idle_notes) {
  const Source source = open_source(name_or_path);
  const Origin origin = {source.label, 1, 0};
  Faults faults;
  Origins origins;
  Scenario scenario;
  const std::optional<YamlNode> root = parse_document(source.text, origin, faults);
  if (!root) faults.throw_if_any();
  GNBV_CHECK(root.has_value(), "no tree and no fault in {}", source.label);
  read_scenario(*root, source.folder, scenario, faults, origins);
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    const auto& [text, given_by, folder] = overrides[i];
    const Origin given = {given_by.empty() ? fmt::format("--set {}", text) : given_by, 0,
                          static_cast<int>(i) + 1};
    const auto picks = parse_override(text, given, faults);
    if (picks) read_scenario(*picks, folder.empty() ? here() : folder, scenario, faults, origins);
  }
  Origins given_by_user = origins;
  if (source.is_builtin) {
    std::erase_if(given_by_user, [](const auto& given) { return given.second.rank == 0; });
  }
  if (filling.fill && faults.empty()) fill_in(filling, scenario, origins);
  if (root->kind == YamlNode::Kind::map) {
    add_problems(scenario, mesh_file, origin, origins, faults);
  }
  faults.throw_if_any();
  scenario.placed_at = placed_at(origins, origin);
  if (idle_notes != nullptr) *idle_notes = idle_key_notes(scenario, given_by_user);
  return scenario;
}

}  // namespace

std::vector<std::string> builtin_scenario_names() {
  std::vector<std::string> names;
  for (const BuiltinScenario& builtin : builtin_scenarios()) names.emplace_back(builtin.name);
  return names;
}

Scenario load_scenario(const std::string& name_or_path, const std::vector<std::string>& overrides) {
  std::vector<Override> all;
  for (const std::string& text : overrides) all.push_back({.text = text});
  return load_with_overrides(name_or_path, all);
}

Scenario load_flown_scenario(const std::string& path) {
  return load(path, {}, MeshFile::may_be_missing, {}, nullptr);
}

Scenario load_with_overrides(const std::string& name_or_path,
                             const std::vector<Override>& overrides, const Filling& filling,
                             std::vector<std::string>* idle_notes) {
  return load(name_or_path, overrides, MeshFile::has_to_be_there, filling, idle_notes);
}

}  // namespace gnbv
