#include "scenarios/idle_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "planner/planners.hpp"
#include "scenarios/write.hpp"

namespace gnbv {
namespace {

using Idle = std::vector<IdleKey>;

void add(Idle& out, std::string_view section, std::initializer_list<std::string_view> keys,
         const std::string& why) {
  for (const std::string_view key : keys) out.push_back({fmt::format("{}.{}", section, key), why});
}

void add_structure(const StructureConfig& c, Idle& out) {
  if (c.file.path.empty()) {
    const std::string what = is_builtin(c)
                                 ? fmt::format("the structure is built in, '{}'", c.builtin)
                                 : "the meshes are those of structure.files";
    add(out, "structure.file", {"scale", "offset_m", "up_axis", "unit_m", "yaw_deg"},
        what + "; structure.file.path is empty");
  }
  if (!is_builtin(c))
    add(out, "structure", {"builtin"},
        c.files.empty() ? "structure.file.path names a mesh" : "structure.files names meshes");
}

void add_profiling(const Scenario& s, Idle& out) {
  constexpr const char* kSection = "planner.profiling";
  const ProfilingMethod method = s.planner.profiling.method;
  if (method != ProfilingMethod::saved) {
    add(out, kSection, {"file"}, "planner.profiling.method is not saved");
  }
  if (method != ProfilingMethod::circular) {
    add(out, kSection, {"circle_stations", "climb_step_m"},
        "planner.profiling.method is not circular");
  }
  if (method == ProfilingMethod::saved || method == ProfilingMethod::none) {
    const std::string why = "planner.profiling.method flies no profile";
    add(out, kSection, {"scan_in_transit"}, why);
    add(out, "guidance", {"profile_speed_m_s"}, why);
  }
}

/// Of the samplers, when views are sampled at all.
void add_sampling(const PlannerConfig& c, Idle& out) {
  constexpr const char* kAgvs = "planner.agvs";
  constexpr const char* kFvs = "planner.fvs";
  if (!c.agvs.scales) {
    add(out, kAgvs,
        {"scale_factor", "scale_max", "utility_threshold", "utility_window", "repeated_moves",
         "entropy_threshold_nat", "entropy_window"},
        "planner.agvs.scales is false");
  } else if (c.agvs.entropy_threshold_nat == 0.0) {
    add(out, kAgvs, {"entropy_window"}, "planner.agvs.entropy_threshold_nat is 0");
  }
  if (!c.fvs.enabled) {
    add(out, kFvs,
        {"entropy_threshold_nat", "entropy_window", "order", "tries", "pool_clusters", "looks_max",
         "views_per_layer", "radius_m", "layer_step_m", "needs_visible_cluster", "agvs_when_stuck",
         "when_grid_finds_nothing", "frontier.neighbour_voxels", "frontier.min_cluster_voxels",
         "frontier.max_extent_m"},
        "planner.fvs.enabled is false");
  } else if (c.fvs.entropy_threshold_nat == 0.0) {
    add(out, kFvs, {"entropy_window"}, "planner.fvs.entropy_threshold_nat is 0");
  }
}

bool is_one_of(const std::string& name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Of the formulas, when candidates are scored at all.
void add_formulas(const UtilityConfig& c, Idle& out) {
  constexpr const char* kSection = "planner.utility";
  const std::string why = fmt::format("planner.utility.name is {}", c.name);
  const auto only = [&](std::initializer_list<std::string_view> of,
                        std::initializer_list<std::string_view> keys) {
    if (!is_one_of(c.name, of)) add(out, kSection, keys, why);
  };
  only({"proposed"}, {"alpha", "beta", "density_term", "normalise_weights"});
  only({"proposed", "bircher_volume", "aep"}, {"lambda_per_m"});
  only({"bircher"}, {"bircher_lambda_per_m"});
  only({"bircher", "isler"}, {"ig_counting", "hit_voxel", "prediction_hides_hits"});
  only({"bircher_volume"}, {"volume_weights"});
  only({"proximity_count", "area_factor", kUserUtilityName}, {"shadow"});
  only({"proposed", "bircher", "bircher_volume", "aep", "nearest_frontier", kUserUtilityName},
       {"distance"});
  const bool hides_hits = is_one_of(c.name, {"bircher", "isler"}) && c.prediction_hides_hits;
  if (!hides_hits) only({"proposed"}, {"gamma"});
}

void add_decisions(const PlannerConfig& c, Idle& out) {
  const std::string& name = c.utility.name;
  const PlannerTraits planner = traits_of(c);
  if (!planner.scores_views) {
    const std::string why = planner.makes_tours
                                ? "a tour weighs what its views bring by itself"
                                : fmt::format("the views of {} are laid all at once", name);
    add(out, "planner", {"agvs", "fvs"}, why);
    add(out, "planner.utility",
        {"alpha", "beta", "gamma", "lambda_per_m", "density_term", "bircher_lambda_per_m",
         "distance", "normalise_weights", "ig_counting", "hit_voxel", "prediction_hides_hits",
         "legacy_visibility", "volume_weights", "shadow"},
        why);
  } else {
    add_sampling(c, out);
    add_formulas(c.utility, out);
  }
  const std::string why = fmt::format("planner.utility.name is {}", name);
  if (!planner.lays_views) add(out, "planner.routes", {"standoff_m"}, why);
  if (!planner.spaces_rows) add(out, "planner.routes", {"overlap"}, why);
  if (!planner.takes_views) add(out, "planner.routes", {"views"}, why);
  if (!is_user_utility(name)) add(out, "planner.utility", {"python"}, why);
  if (!planner.makes_tours) add(out, "planner", {"tour"}, why);
  if (c.validity.path == PathCheck::unchecked) {
    add(out, "planner.validity", {"path_search"}, "planner.validity.path is unchecked");
  }
  if (c.validity.recent_poses == 0) {
    add(out, "planner.validity", {"recent_distance_m", "recent_yaw_deg"},
        "planner.validity.recent_poses is 0");
  }
}

void add_termination(const PlannerConfig& c, Idle& out) {
  constexpr const char* kSection = "planner.termination";
  const PlannerTraits planner = traits_of(c);
  if (planner.makes_tours) {
    add(out, kSection, {"entropy_change_percent", "entropy_window", "repeated_moves"},
        "a tour ends by itself");
  } else if (planner.knows_structure || planner.takes_views) {
    add(out, kSection,
        {"entropy_change_percent", "entropy_window", "repeated_moves", "min_new_voxels_per_m",
         "new_voxels_window", "max_views_without_new_points"},
        fmt::format("{} flies its route to the end", c.utility.name));
    return;
  }
  if (c.termination.entropy_change_percent == 0.0) {
    add(out, kSection, {"entropy_window"}, "planner.termination.entropy_change_percent is 0");
  }
  if (c.termination.min_new_voxels_per_m == 0.0) {
    add(out, kSection, {"new_voxels_window"}, "planner.termination.min_new_voxels_per_m is 0");
  }
}

/// An ideal vehicle has no autopilot, but lands as fast as one would, and counts on what that
/// takes.
void add_autopilot(const Scenario& scenario, Idle& out) {
  const std::string section = "vehicle.autopilot";
  for (const auto& [key, text] : scenario_values(scenario)) {
    if (!is_at_or_below(key, section)) continue;
    if (is_one_of(key.substr(section.size() + 1),
                  {"commander.land_speed_m_s", "commander.land_detection_s",
                   "commander.disarm_after_landing_s"})) {
      continue;
    }
    out.push_back({key, "vehicle.kind is ideal"});
  }
}

/// What a file that names only its presets stands for.
std::map<std::string, std::string> defaults_of(const Scenario& scenario) {
  Scenario plain;
  plain.planner.preset = scenario.planner.preset;
  set_preset_switches(plain.planner);
  plain.vehicle = vehicle_preset(scenario.vehicle.preset);
  std::map<std::string, std::string> values;
  for (auto& [key, text] : scenario_values(plain)) values.emplace(key, text);
  return values;
}

struct Given {
  Origin origin;
  std::string sentence;
};

}  // namespace

std::vector<IdleKey> idle_keys(const Scenario& scenario) {
  Idle out;
  add_structure(scenario.structure, out);
  add_profiling(scenario, out);
  add_decisions(scenario.planner, out);
  if (!scenario.planner.symmetry.enabled) {
    add(out, "planner.symmetry", {"min_support", "min_confirmed"},
        "planner.symmetry.enabled is false");
  }
  add_termination(scenario.planner, out);
  if (scenario.vehicle.kind == VehicleKind::ideal) add_autopilot(scenario, out);
  return out;
}

std::vector<std::string> idle_key_notes(const Scenario& scenario, const Origins& origins) {
  const auto values = scenario_values(scenario);
  const auto defaults = defaults_of(scenario);
  const std::vector<IdleKey> idle = idle_keys(scenario);
  const auto given_by_file = [&](const auto& value) {
    const auto at = origins.find(value.first);
    return at != origins.end() && at->second.line > 0;
  };
  const bool is_whole_file = std::all_of(values.begin(), values.end(), given_by_file);
  std::vector<Given> found;
  for (const auto& [key, text] : values) {
    const auto at = origins.find(key);
    if (at == origins.end()) continue;
    const auto is_of = [&k = key](const IdleKey& i) { return is_at_or_below(k, i.key); };
    const auto why = std::find_if(idle.begin(), idle.end(), is_of);
    if (why == idle.end()) continue;
    const auto plain = defaults.find(key);
    const bool is_default = plain != defaults.end() && plain->second == text;
    if (at->second.rank == 0 && (is_whole_file || is_default)) continue;
    found.push_back(
        {at->second, fmt::format("{} ({}) has no effect: {}", key, text_of(at->second), why->why)});
  }
  std::stable_sort(found.begin(), found.end(), [](const Given& a, const Given& b) {
    return std::pair(a.origin.rank, a.origin.line) < std::pair(b.origin.rank, b.origin.line);
  });
  std::vector<std::string> notes;
  for (Given& given : found) notes.push_back(std::move(given.sentence));
  return notes;
}

}  // namespace gnbv
