#include "tools/gnbv/execute.hpp"

#include <chrono>
#include <csignal>
#include <thread>

#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "tools/gnbv/progress.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/mission.hpp"
#include "tools/mission/run_directory.hpp"
#include "tools/mission/start_pose.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// a signal handler can reach nothing else
volatile std::sig_atomic_t interrupt_count = 0;

/// While it lives, the first Ctrl-C asks the mission to stop and the second one kills.
class InterruptGuard {
 public:
  InterruptGuard() {
    interrupt_count = 0;
    previous_ = std::signal(SIGINT, [](int) {
      interrupt_count = 1;
      std::signal(SIGINT, SIG_DFL);
    });
  }
  ~InterruptGuard() { std::signal(SIGINT, previous_); }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  static bool requested() { return interrupt_count != 0; }

 private:
  void (*previous_)(int) = SIG_DFL;
};

fs::path free_folder(const Scenario& scenario) {
  const std::string name =
      fmt::format("{}-{}-seed{}", scenario.name, scenario.planner.utility.name, scenario.seed);
  fs::path folder = fs::path("runs") / name;
  for (int n = 2; fs::exists(folder); ++n)
    folder = fs::path("runs") / fmt::format("{}-{}", name, n);
  return folder;
}

MissionHooks make_hooks(const Scenario& scenario, RunDirectory& directory, Progress& progress) {
  MissionHooks hooks;
  hooks.on_profile = [&progress](double share) { progress.show(0.1 * share, "profile"); };
  hooks.on_view = [&](const ViewRecord& view) {
    directory.append(view);
    const int last = scenario.planner.termination.max_iterations;
    progress.show(0.1 + 0.9 * (view.iteration + 1) / last,
                  fmt::format("view {}/{}  {:.0f} m  {} points", view.iteration + 1, last,
                              view.straight_m, view.cloud_points));
  };
  hooks.should_stop = InterruptGuard::requested;
  hooks.replay = directory.recorded();
  return hooks;
}

}  // namespace

Scenario resolve_scenario(const MissionOptions& options) {
  std::vector<std::string> overrides;
  // absolute, since a relative path in a scenario file is relative to that file
  if (!options.mesh.empty()) {
    overrides.push_back(fmt::format("structure.file.path={}", fs::absolute(options.mesh).string()));
  }
  if (!options.utility.empty()) {
    overrides.push_back(fmt::format("planner.utility.name={}", options.utility));
  }
  if (options.seed) overrides.push_back(fmt::format("seed={}", *options.seed));
  overrides.insert(overrides.end(), options.overrides.begin(), options.overrides.end());
  return load_scenario(options.scenario, overrides);
}

ExecutedMission execute_mission(const Scenario& scenario, const MissionOptions& options) {
  const auto begin = Clock::now();
  const int threads = options.threads > 0
                          ? options.threads
                          : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  // all that can be wrong with the input is found before the first file is written
  std::vector<std::string> warnings;
  const World world = load_world(scenario, warnings);
  for (const std::string& warning : warnings) fmt::print(stderr, "gnbv: {}\n", warning);
  const RayScene scene(world);
  start_pose(scenario, scene);
  RunDirectory directory(options.out.empty() ? free_folder(scenario) : options.out, scenario,
                         options.resume);
  const InterruptGuard interrupt;
  Progress progress(fmt::format("{} {}", scenario.name, scenario.planner.utility.name),
                    options.quiet);
  try {
    MissionResult result =
        run_mission(scenario, world, scene, make_hooks(scenario, directory, progress), threads);
    const auto scoring = Clock::now();
    progress.show(1.0, "scoring");
    const SurfaceReference reference =
        make_surface_reference(world, scene, {.floor_z_m = scenario.planner.floor_z_m}, threads);
    const MissionScore score = score_mission(reference, result);
    result.wall.score_s = seconds_since(scoring);
    directory.finish(scenario, result, score, seconds_since(begin));
    return {directory.path(), std::move(result), score, seconds_since(begin)};
  } catch (const BrokenInvariant& broken) {
    throw BrokenInvariant(fmt::format("{}\nreplay with: gnbv run {} --out REPLAY", broken.what(),
                                      (directory.path() / "scenario.yaml").string()));
  }
}

}  // namespace gnbv
