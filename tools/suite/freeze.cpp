#include <fmt/format.h>

#include <algorithm>

#include "bench/limits/ceiling.hpp"
#include "sim/core/file.hpp"
#include "tools/run/summary_json.hpp"
#include "tools/suite/suite_work.hpp"
#include "tools/sweep/bench_runs.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

std::string triple(const Vec3& p_m) {
  return fmt::format("[{}, {}, {}]", p_m.x(), p_m.y(), p_m.z());
}

/// Where it is flown around, and from where: numbers instead of the rule, and no seed moves them.
std::vector<std::string> frozen_settings(const Scenario& scenario, bool is_random) {
  const Box3& room_m = scenario.workspace_m;
  const Box3& object_m = scenario.planner.object_bounds_m;
  const ViewPose& start = scenario.start.pose;
  std::vector<std::string> settings = {fmt::format("start.position_m={}", triple(start.p_world_m)),
                                       fmt::format("start.yaw_deg={}", rad_to_deg(start.yaw_rad)),
                                       "start.jitter_m=[0, 0, 0]"};
  if (!is_random) return settings;
  settings.push_back(
      fmt::format("workspace_m={{min: {}, max: {}}}", triple(room_m.min()), triple(room_m.max())));
  settings.push_back(fmt::format("planner.object_bounds_m={{min: {}, max: {}}}",
                                 triple(object_m.min()), triple(object_m.max())));
  return settings;
}

/// Mean coverage over the budget of each planner's mission; the best of them.
void find_best(const Suite& suite, const std::vector<std::string>& planners, const fs::path& folder,
               const SuiteFlights& flights, SuiteTask& task) {
  const SuiteTrack& track = suite.track(task.track);
  for (const std::string& name : planners) {
    const EntryFolder entry{suite, task.track, entry_planner(name, {}, "")};
    fly_entry(folder, entry, {task}, flights);
    TaskScenarios scenarios(suite, folder / "meshes");
    const Cell cell = cells_of_entry(suite, {task}, entry.planner, scenarios).front();
    const RunFigures run = read_run_figures(look_up(folder, cell).run);
    const double integral =
        mean_coverage(run.curve, run.before, track.effort, task.budget, is_lost(run.termination));
    if (!flights.quiet) {
      say("{}, {}, {}: {:.4f}", task.track, task.structure, name, integral);
    }
    if (task.best && *task.best >= integral) continue;
    task.best = integral;
    task.best_planner = name;
  }
}

}  // namespace

void freeze_track(const fs::path& suite_file, const std::string& track,
                  const std::vector<std::string>& planners, const fs::path& folder,
                  const SuiteFlights& flights) {
  Suite suite = read_suite(read_file(suite_file), suite_file.string());
  suite.track(track);  // throws
  const auto write = [&] { write_file_atomically(suite_file, suite_yaml(suite)); };
  for (std::size_t i = 0; i < suite.tasks.size(); ++i) {
    if (suite.tasks[i].track != track || suite.tasks[i].is_frozen()) continue;
    auto& structure =
        *std::ranges::find(suite.structures, suite.tasks[i].structure, &SuiteStructure::name);
    TaskScenarios scenarios(suite, folder / "meshes");
    structure.sha256 = scenarios.mesh_sha256(structure);
    if (structure.settings.empty()) {
      Suite without = suite;  // whatever the track does to cameras
      for (SuiteTrack& each : without.tracks) each.settings.clear();
      structure.settings = frozen_settings(
          TaskScenarios(without, folder / "meshes").of(suite.tasks[i]), !structure.random.empty());
    }
    write();
    SuiteTask task = suite.tasks[i];
    const Ceiling ceiling =
        ceiling_of(scenarios.of(task), {.threads = flights.threads, .quiet = flights.quiet});
    task.ceiling = ceiling.leaf_counted[0];
    find_best(suite, planners, folder, flights, task);
    suite.tasks[i] = task;
    write();
  }
}

}  // namespace gnbv
