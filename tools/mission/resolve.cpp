#include "tools/mission/resolve.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "scenarios/document.hpp"
#include "sim/core/file.hpp"
#include "tools/mission/auto_bounds.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/user_function.hpp"
#include "tools/run/user_views.hpp"

namespace gnbv {

namespace fs = std::filesystem;

StructureExtent structure_extent(const Scenario& scenario) {
  std::vector<std::string> warnings;  // repeated when the mission loads the structure
  StructureExtent extent = extent_of(load_structure(scenario, warnings));
  extent.around = scene_around(scenario);
  return extent;
}

Scenario resolve_scenario(const ScenarioOptions& options) {
  return resolve_scenario(options, std::vector<Override>{});
}

Scenario resolve_scenario(const ScenarioOptions& options, std::vector<std::string>& unused_notes) {
  return resolve_scenario(options, {}, structure_extent, &unused_notes);
}

Scenario resolve_scenario(const ScenarioOptions& options, const std::vector<Override>& overrides,
                          const std::function<StructureExtent(const Scenario&)>& extent,
                          std::vector<std::string>* unused_notes) {
  std::vector<Override> all;
  const auto add = [&all](std::string text) { all.push_back({.text = std::move(text)}); };
  // absolute, since a relative path in a scenario file is relative to that file
  if (!options.mesh.empty()) {
    if (!fs::is_regular_file(options.mesh)) read_file(options.mesh);  // throws, with the cause
    add("structure.files=[]");
    add(fmt::format("structure.file.path={}", yaml_in_quotes(fs::absolute(options.mesh).string())));
  }
  if (!options.utility.empty()) {
    const NamedMethod method = named_method(options.utility);
    all.insert(all.end(), method.overrides.begin(), method.overrides.end());
  }
  if (!options.preset.empty()) add("planner.preset=" + options.preset);
  if (!options.seed.empty()) add("seed=" + options.seed);
  if (!options.views.empty()) {
    all.push_back({.text = views_override(read_user_views(options.views)),
                   .source = fmt::format("--views {}", options.views)});
  }
  for (const std::string& text : options.overrides) add(text);
  all.insert(all.end(), overrides.begin(), overrides.end());
  Filling bounds{.source = "--bounds auto", .fill = {}};
  if (options.bounds_auto) {
    bounds.fill = [&](Scenario& scenario, const auto& is_given) {
      scenario = with_bounds_around(scenario, extent(scenario),
                                    {.workspace = is_given("workspace_m"),
                                     .position = is_given("start.position_m"),
                                     .yaw = is_given("start.yaw_deg")});
    };
  }
  return load_with_overrides(options.scenario, all, bounds, unused_notes);
}

}  // namespace gnbv
