#include "tools/suite/entry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>

#include "assets/random/random_structure.hpp"
#include "bench/score/content_cache.hpp"
#include "planner/planners.hpp"
#include "scenarios/validation_error.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/resolve.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

Override route_setting() { return {fmt::format("planner.utility.name={}", kRouteName)}; }

/// `cameras.*.KEY=VALUE` for every camera of the scenario, other settings as they are.
std::vector<std::string> for_all_cameras(const std::string& setting, std::size_t cameras) {
  constexpr std::string_view kAll = "cameras.*.";
  if (!setting.starts_with(kAll)) return {setting};
  std::vector<std::string> all;
  for (std::size_t i = 0; i < cameras; ++i) {
    all.push_back(fmt::format("cameras.{}.{}", i, setting.substr(kAll.size())));
  }
  return all;
}

bool is_free(const std::string& key, const SuiteTrack& track) {
  const auto is_below = [&](std::string_view above) { return is_at_or_below(key, above); };
  return std::ranges::any_of(kFreeKeys, is_below) || std::ranges::any_of(track.free, is_below);
}

/// The keys that differ and that a planner may not set.
std::vector<std::string> keys_beyond(const Scenario& task, const Scenario& entry,
                                     const SuiteTrack& track) {
  std::map<std::string, std::string> values;
  for (auto& [key, value] : scenario_values(task)) values[key] = std::move(value);
  std::vector<std::string> keys;
  for (const auto& [key, value] : scenario_values(entry)) {
    if (!is_free(key, track) && values[key] != value) keys.push_back(key);
    values.erase(key);
  }
  for (const auto& [key, value] : values) {
    if (!is_free(key, track)) keys.push_back(key);
  }
  return keys;
}

/// Throws BadInput where settings or the name stand for another planner than is entered.
void need_one_planner(const EntryPlanner& planner, const SuiteTask& task,
                      TaskScenarios& scenarios) {
  const bool is_own = planner.asks.empty() && !planner.settings.empty();  // others give views
  const auto begin = planner.settings.begin();
  const std::vector<Override> first(begin, is_own ? begin + 1 : begin);
  const std::string entered = scenarios.of(task, first).planner.utility.name;
  const std::string flown = scenarios.of(task, planner.settings).planner.utility.name;
  if (flown != entered) {
    throw BadInput(
        "settings: planner.utility.name: value '{}': names another planner than the one that is "
        "entered",
        flown);
  }
  if (is_own && planner.name != entered && std::ranges::count(planner_names(), planner.name) > 0) {
    throw BadInput("name: value '{}': is another planner of gnbv's than {}, which flies",
                   planner.name, entered);
  }
}

}  // namespace

EntryPlanner entry_planner(const std::string& text, const std::vector<std::string>& settings,
                           const std::string& name) {
  EntryPlanner planner;
  const std::vector<std::string_view> known = planner_names();
  const bool is_known = std::ranges::count(known, text) > 0;
  const bool is_command = text.find(' ') != text.npos || (!is_known && fs::is_regular_file(text) &&
                                                          fs::path(text).extension() != ".py");
  if (is_command) {
    const std::string program = text.substr(0, text.find(' '));
    planner = {.name = fs::path(program).filename().string(),
               .kind = EntryKind::views,
               .asks = {route_setting()},
               .run_arguments = {"--views", "|" + text}};
  } else if (is_known && text != kUserUtilityName) {
    planner = {.name = text, .settings = {{"planner.utility.name=" + text}}};
  } else if (text.find(".py") != text.npos) {
    const NamedMethod method = named_method(text, "--planner");
    const auto is_planner = [](const Override& set) {
      return set.text == "planner.utility.python.kind=planner";
    };
    if (std::ranges::none_of(method.overrides, is_planner)) {
      throw BadInput(
          "--planner {}: is a utility, which nobody could fly again without running it; a planner "
          "is a function of two parameters (docs/tutorials/planner-python.md)",
          text);
    }
    planner = {.name = method.name,
               .kind = EntryKind::views,
               .asks = method.overrides,
               .run_arguments = {"--round-views"}};
  } else {
    throw BadInput(
        "--planner {}: is no planner of gnbv ({}allowed: {}), no FILE.py:FUNCTION and no command "
        "with its words",
        text, did_you_mean(text, known), join(known));
  }
  if (text == kRouteName) throw BadInput("--planner route: its views come from a command");
  for (const std::string& setting : settings) planner.settings.push_back({setting});
  if (!name.empty()) planner.name = name;
  need_text("--planner " + text, "name", planner.name);
  for (const std::string& setting : settings) need_text("--planner " + text, "--set", setting);
  return planner;
}

std::string TaskScenarios::mesh_of(const SuiteStructure& structure) {
  if (structure.random.empty()) return "";
  const fs::path file = meshes_ / (structure.name + ".ply");
  if (!fs::exists(file)) {
    make_folder(meshes_);
    // by rename: other processes may share the folder
    const fs::path part = meshes_ / fmt::format("{}.{}.ply", structure.name, getpid());
    write_mesh(make_random_structure(structure.seed, structure.random), part);
    fs::rename(part, file);
  }
  return file.string();
}

Scenario TaskScenarios::resolved(const SuiteTask& task, const std::vector<Override>& planner) {
  const SuiteStructure& structure = suite_.structure_of(task);
  const SuiteTrack& track = suite_.track(task.track);
  const bool is_metres = track.effort == Effort::metres;
  const std::size_t cameras = load_scenario(structure.scenario, {}).cameras.size();
  std::vector<Override> all;
  for (const auto& settings : {track.settings, structure.settings}) {
    for (const std::string& setting : settings) {
      for (const std::string& one : for_all_cameras(setting, cameras)) {
        all.push_back({one, "the suite's " + setting});
      }
    }
  }
  const char* const score = is_metres ? "score.budget_m" : "score.budget_s";
  const char* const end =
      is_metres ? "planner.termination.max_distance_m" : "planner.termination.max_flight_time_s";
  all.push_back({fmt::format("{}={}", score, task.budget)});
  all.push_back({fmt::format("{}={}", end, task.budget)});
  all.insert(all.end(), planner.begin(), planner.end());
  ScenarioOptions options;
  options.scenario = structure.scenario;
  options.mesh = mesh_of(structure);
  options.bounds_auto = !structure.random.empty() && structure.settings.empty();
  return resolve_scenario(options, nullptr, all);
}

Scenario TaskScenarios::of(const SuiteTask& task) { return resolved(task, {}); }

Scenario TaskScenarios::of(const SuiteTask& task, const std::vector<Override>& planner) {
  const SuiteTrack& track = suite_.track(task.track);
  const auto need_none = [&](const std::vector<std::string>& keys) {
    if (keys.empty()) return;
    throw BadInput("{}, {}: a planner may not set {} in this track", task.track, task.structure,
                   fmt::join(keys, ", "));
  };
  std::vector<std::string> beyond;
  for (const Override& set : planner) {  // first: such a one may name a file that would be read
    const std::size_t equals = set.text.find('=');
    const std::string key = set.text.substr(0, equals);
    if (equals != key.npos && !is_free(key, track)) beyond.push_back(key);
  }
  need_none(beyond);
  Scenario scenario = resolved(task, planner);
  need_none(keys_beyond(resolved(task, {}), scenario, track));  // what a preset brings with it
  if (!scenario.planner.profiling.file.empty()) need_none({"planner.profiling.file"});
  return scenario;
}

std::string TaskScenarios::mesh_sha256(const SuiteStructure& structure) {
  std::string& hash = hashes_[structure.name];
  if (!hash.empty()) return hash;
  ScenarioOptions options;
  options.scenario = structure.scenario;
  options.mesh = mesh_of(structure);
  std::vector<std::string> warnings;
  Sha256 sha;
  add_mesh(sha, load_structure(resolve_scenario(options), warnings));
  return hash = sha.hex();
}

std::vector<SuiteTask> asked_tasks(const Suite& suite, const std::string& track,
                                   const std::vector<std::string>& only) {
  std::vector<SuiteTask> tasks = suite.tasks_of(suite.track(track).name);
  for (const std::string& name : only) {
    if (std::ranges::count(tasks, name, &SuiteTask::structure) > 0) continue;
    throw BadInput("--task {}: track {} has no such task", name, track);
  }
  std::erase_if(tasks, [&](const SuiteTask& task) {
    return !only.empty() && std::ranges::count(only, task.structure) == 0;
  });
  return tasks;
}

std::vector<Cell> cells_of_entry(const Suite& suite, const std::vector<SuiteTask>& tasks,
                                 const EntryPlanner& planner, TaskScenarios& scenarios) {
  CellNamer namer;
  std::vector<Cell> cells;
  for (const SuiteTask& task : tasks) {
    const SuiteStructure& structure = suite.structure_of(task);
    const std::string mesh = scenarios.mesh_sha256(structure);
    if (!structure.sha256.empty() && structure.sha256 != mesh) {
      throw BadInput(
          "{}: its mesh has the SHA-256 {}, in the suite it is {}: this program makes another "
          "structure than the suite was frozen with",
          structure.name, mesh, structure.sha256);
    }
    std::vector<Override> all = planner.settings;
    all.insert(all.end(), planner.asks.begin(), planner.asks.end());
    Scenario scenario = scenarios.of(task, all);
    if (planner.kind == EntryKind::planner && user_function(scenario.planner.utility) != nullptr) {
      throw BadInput(
          "settings: name a function of the user's own, which nobody could fly again without "
          "running it");
    }
    const std::string& utility = scenario.planner.utility.name;
    if (traits_of(scenario.planner).knows_structure && !planner.name.starts_with(utility)) {
      throw BadInput(
          "name: value '{}': of {}, which knows the mesh: the name has to begin with that",
          planner.name, utility);
    }
    if (cells.empty()) need_one_planner(planner, task, scenarios);
    const std::string id = namer.id_of(scenario);
    cells.push_back({task.structure, planner.name, scenario.seed, id, std::move(scenario)});
  }
  return cells;
}

}  // namespace gnbv
