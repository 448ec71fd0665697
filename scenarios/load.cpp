#include "scenarios/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "scenarios/builtin.hpp"
#include "scenarios/problems.hpp"
#include "scenarios/reader.hpp"
#include "scenarios/values.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct Source {
  std::string text;
  std::string label;   // as errors show it
  std::string folder;  // where its relative paths begin
  bool is_builtin = false;
};

std::string here() { return fs::current_path().string(); }

Source open_source(const std::string& name_or_path) {
  const std::vector<BuiltinFile> files = builtin_files("scenarios");
  const auto file = std::ranges::find(files, name_or_path, &BuiltinFile::name);
  if (file != files.end()) {
    return {std::string(file->yaml), fmt::format("{} (built in)", file->name), here(), true};
  }
  const std::vector<std::string_view> names = builtin_names("scenarios");
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

/// A key and where it, or the preset that set it, or the nearest section around it, was given.
struct GivenKey {
  std::string key;
  SourceLocation location;
  bool is_given_itself = false;
};

/// Of keys that do not go together, the one given last; of those, one given itself; of those, the
/// first. At `source` when all are at their defaults.
GivenKey latest_given(const std::vector<std::string>& keys, const SourceLocations& locations,
                      const SourceLocation& source) {
  GivenKey latest = {keys.front(), {source.source, 0, -1}, false};
  for (const std::string& key : keys) {
    std::string path = key;
    auto given = locations.find(path);
    while (given == locations.end() && path.find('.') != std::string::npos) {
      path.resize(path.rfind('.'));
      if (path + ".preset" == preset_over(key)) given = locations.find(path + ".preset");
      if (given == locations.end()) given = locations.find(path);
    }
    if (given == locations.end()) continue;
    const bool is_given_itself = path == key;
    if (std::pair(given->second.rank, is_given_itself) >
        std::pair(latest.location.rank, latest.is_given_itself)) {
      latest = {key, given->second, is_given_itself};
    }
  }
  return latest;
}

/// Of any key of mesh_files().
bool is_mesh_path(std::string_view key) {
  return key.ends_with(".path") && (key.starts_with("structure.file") || key == "terrain.path" ||
                                    key.starts_with("obstacles."));
}

enum class MeshFile { has_to_be_there, may_be_missing };

/// Adds what does not go together. Keys that are wrong already are left out: it would only repeat
/// them.
void add_problems(const Scenario& scenario, MeshFile mesh_file, const SourceLocation& source,
                  const SourceLocations& locations, ValidationErrors& errors) {
  const ValidationErrors given = errors;
  const auto is_wrong_already = [&](const std::string& key) { return given.concerns(key); };
  Problems found = problems(scenario);
  require(!scenario.cameras.empty() || locations.contains("cameras"), found, {"cameras"},
          "names no camera; at least one has to look, or `cameras: []` says that the LIDARs do");
  for (const auto& [keys, what] : found) {
    if (mesh_file == MeshFile::may_be_missing && is_mesh_path(keys.front())) continue;
    if (std::ranges::any_of(keys, is_wrong_already)) continue;
    const auto& [key, location, is_given_itself] = latest_given(keys, locations, source);
    const auto values = scenario_values(scenario);
    const auto value = std::ranges::find(values, key, [](const auto& v) { return v.first; });
    // a scenario keeps no calibration's name
    const bool is_known = value != values.end() && !key.ends_with(".calibration");
    errors.add(location, key, is_known ? value->second : "", what);
  }
}

/// What was not given and is another afterwards is the filling's.
void fill_in(const Filling& filling, Scenario& scenario, SourceLocations& locations) {
  const auto is_given = [&](std::string_view key) {
    return std::ranges::any_of(locations, [&](const auto& given) {
      return given.second.rank > 0 && is_at_or_below(given.first, key);
    });
  };
  const auto before = scenario_values(scenario);
  filling.fill(scenario, is_given);
  const auto after = scenario_values(scenario);
  GNBV_CHECK(before.size() == after.size(), "a filling made keys");
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (after[i] == before[i]) continue;
    const SourceLocation location = {filling.source, 0, 1};
    const std::string& key = after[i].first;
    locations[key] = location;
    // problems may name the section, which is the user's if it was given
    SourceLocation& section = locations[key.substr(0, key.find('.'))];
    if (section.rank == 0) section = location;
  }
}

/// Whom to tell that the structure is not in the workspace, which nobody knows before its mesh is
/// read.
std::string placed_at(const SourceLocations& locations, const SourceLocation& source) {
  std::vector<std::string> keys = {"workspace_m.min", "workspace_m.max", "structure.builtin",
                                   "structure.offset_m"};
  for (const auto& [key, given] : locations) {
    if (is_at_or_below(key, "structure.file") || is_at_or_below(key, "structure.files")) {
      keys.push_back(key);
    }
  }
  const GivenKey last = latest_given(keys, locations, source);
  return text_of(last.location) + ": " +
         (last.key.starts_with("workspace_m") ? "workspace_m" : last.key);
}

struct Loaded {
  Scenario scenario;
  std::vector<std::string> removed_notes;  // a sentence for each source with removed keys
};

Loaded load(const std::string& name_or_path, const std::vector<Override>& overrides,
            MeshFile mesh_file, const Filling& filling = {},
            std::vector<std::string>* unused_notes = nullptr) {
  const Source source = open_source(name_or_path);
  const SourceLocation location = {source.label, 1, 0};
  ValidationErrors errors;
  SourceLocations locations;
  Loaded loaded;
  Scenario& scenario = loaded.scenario;
  const auto read = [&](const YamlNode& tree, const std::string& folder,
                        const SourceLocation& given) {
    const auto removed = read_scenario(tree, folder, scenario, errors, locations);
    if (removed.empty()) return;
    loaded.removed_notes.push_back(fmt::format(
        "{}: passes over {}{}: removed after version 0.1, and given at the former default",
        given.source, removed.front(),
        removed.size() == 1 ? "" : fmt::format(" and {} more", removed.size() - 1)));
  };
  const std::optional<YamlNode> root = parse_document(source.text, location, errors);
  if (!root) errors.throw_if_any();
  GNBV_CHECK(root.has_value(), "no tree and no error in {}", source.label);
  read(*root, source.folder, location);
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    const auto& [text, given_by, folder] = overrides[i];
    const SourceLocation given = {given_by.empty() ? fmt::format("--set {}", text) : given_by, 0,
                                  static_cast<int>(i) + 1};
    const auto picks = parse_override(text, given, errors);
    if (picks) read(*picks, folder.empty() ? here() : folder, given);
  }
  set_preset_flight(scenario, locations);
  set_square_pixels(scenario, locations);
  SourceLocations given_by_user = locations;
  if (source.is_builtin) {
    std::erase_if(given_by_user, [](const auto& given) { return given.second.rank == 0; });
  }
  if (filling.fill && errors.empty()) fill_in(filling, scenario, locations);
  if (root->kind == YamlNode::Kind::map) {
    add_problems(scenario, mesh_file, location, locations, errors);
  }
  errors.throw_if_any();
  scenario.placed_at = placed_at(locations, location);
  if (unused_notes != nullptr) *unused_notes = unused_parameter_notes(scenario, given_by_user);
  return loaded;
}

/// Says the notes on stderr.
Scenario noting_removed(Loaded loaded) {
  for (const std::string& note : loaded.removed_notes) fmt::print(stderr, "gnbv: {}\n", note);
  return std::move(loaded.scenario);
}

}  // namespace

void set_square_pixels(Scenario& scenario, const SourceLocations& given) {
  for (std::size_t i = 0; i < scenario.cameras.size(); ++i) {
    CameraConfig& c = scenario.cameras[i];
    const bool has_x = given.contains(fmt::format("cameras.{}.fov_x_deg", i));
    const bool has_y = given.contains(fmt::format("cameras.{}.fov_y_deg", i));
    if (has_x == has_y || c.fx_px != 0.0) continue;
    const double shape = static_cast<double>(c.height_px) / c.width_px;
    const auto opening_rad = [](double half_tan) {
      return written_angle_rad(2.0 * std::atan(half_tan));
    };
    if (has_x) c.fov_y_rad = opening_rad(shape * std::tan(0.5 * c.fov_x_rad));
    if (has_y) c.fov_x_rad = opening_rad(std::tan(0.5 * c.fov_y_rad) / shape);
  }
}

void set_preset_flight(Scenario& scenario, const SourceLocations& given) {
  constexpr double kGazebos_m = 5.0;
  constexpr double kAuthorsRadius_m = 0.8;
  constexpr double kFrames_hz = 5.0;
  const bool is_takeoff = scenario.planner.preset == kTakeoff;
  const bool is_authors = scenario.planner.preset == "authors_2018";
  const auto radius = given.find("planner.validity.collision_radius_m");
  const auto preset = given.find("planner.preset");
  if (is_authors && (radius == given.end() || radius->second.rank < preset->second.rank)) {
    scenario.planner.validity.collision_radius_m = kAuthorsRadius_m;
  }
  if (is_takeoff && !given.contains("guidance.trajectory")) {
    scenario.guidance.trajectory = Trajectory::smooth;
  }
  for (std::size_t i = 0; i < scenario.cameras.size(); ++i) {
    const auto is_given = [&](std::string_view key) {
      return given.contains(fmt::format("cameras.{}.{}", i, key));
    };
    CameraConfig& camera = scenario.cameras[i];
    if (is_takeoff && !is_given("rate_hz")) camera.rate_hz = kFrames_hz;
    if (is_authors && !is_given("return_max_m")) camera.return_max_m = kGazebos_m;
  }
}

std::vector<std::string> builtin_scenario_names() {
  const std::vector<std::string_view> names = builtin_names("scenarios");
  return {names.begin(), names.end()};
}

Scenario load_scenario(const std::string& name_or_path, const std::vector<std::string>& overrides) {
  std::vector<Override> all;
  for (const std::string& text : overrides) all.push_back({.text = text});
  return load_with_overrides(name_or_path, all);
}

Scenario load_flown_scenario(const std::string& path) {
  return noting_removed(load(path, {}, MeshFile::may_be_missing));
}

bool is_written_in(const std::string& path, const Scenario& scenario) {
  const std::string yaml = to_yaml(scenario);
  if (read_file(path) == yaml) return true;
  try {
    return to_yaml(load(path, {}, MeshFile::may_be_missing).scenario) == yaml;
  } catch (const BadInput&) {
    return false;  // it is no scenario at all
  }
}

Scenario load_with_overrides(const std::string& name_or_path,
                             const std::vector<Override>& overrides, const Filling& filling,
                             std::vector<std::string>* unused_notes) {
  return noting_removed(
      load(name_or_path, overrides, MeshFile::has_to_be_there, filling, unused_notes));
}

}  // namespace gnbv
