#include "tools/mission/resolve.hpp"

#include <filesystem>

#include "scenarios/document.hpp"
#include "sim/core/file.hpp"
#include "sim/core/portable.hpp"
#include "sim/mesh/model_parts.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/run/user_views.hpp"

namespace gnbv {

namespace fs = std::filesystem;

Override views_of_file(const std::string& file) {
  return {views_override(read_user_views(file)), "--views " + file};
}

StructureExtent structure_extent(const Scenario& scenario) {
  std::vector<std::string> warnings;  // repeated when the mission loads the structure
  StructureExtent extent = extent_of(load_structure(scenario, warnings));
  extent.around = scene_around(scenario);
  return extent;
}

Scenario resolve_scenario(const ScenarioOptions& options, std::vector<std::string>* unused_notes,
                          const std::vector<Override>& overrides,
                          const std::function<StructureExtent(const Scenario&)>& extent) {
  std::vector<Override> all;
  const auto add = [&all](const std::vector<Override>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  // absolute, since a relative path in a scenario file is relative to that file
  if (!options.mesh.empty()) {
    const fs::path file = model_file_of(options.mesh);
    if (!fs::is_regular_file(file)) read_file(file);  // throws, with the cause
    const std::string path = yaml_in_quotes(fs::absolute(options.mesh).string());
    add(overrides_of(
        {"structure.files=[]", "structure.offset_m=[0,0,0]", "structure.file.path=" + path}));
  }
  if (!options.utility.empty()) add(named_method(options.utility).overrides);
  if (!options.preset.empty()) {
    all.push_back({"planner.preset=" + options.preset, "--preset " + options.preset});
  }
  if (!options.seed.empty()) all.push_back({"seed=" + options.seed, "--seed " + options.seed});
  if (!options.views.empty()) add({views_of_file(options.views)});
  add(overrides_of(options.overrides));
  add(overrides);
  Filling bounds{.source = "--bounds auto", .fill = {}};
  if (options.bounds_auto) {
    bounds.fill = [&](Scenario& scenario, const auto& is_given) {
      scenario = with_bounds_around(scenario, extent(scenario),
                                    {.workspace = is_given("workspace_m"),
                                     .object_bounds = is_given("planner.object_bounds_m"),
                                     .position = is_given("start.position_m"),
                                     .yaw = is_given("start.yaw_deg")});
    };
  }
  const Scenario scenario = load_with_overrides(options.scenario, all, bounds, unused_notes);
  if (scenario.portable) need_portable_mathematics();  // before anything is begun
  return scenario;
}

}  // namespace gnbv
