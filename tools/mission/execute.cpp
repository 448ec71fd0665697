#include "tools/mission/execute.hpp"

#include <optional>
#include <thread>

#include "bench/limits/oracle.hpp"
#include "planner/map/memory.hpp"
#include "planner/routes.hpp"
#include "planner/symmetry/symmetry_module.hpp"
#include "sim/core/error.hpp"
#include "sim/core/stopwatch.hpp"
#include "sim/core/text.hpp"
#include "tools/mission/belief_log.hpp"
#include "tools/mission/coverage_goal.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/mission.hpp"
#include "tools/mission/own_utility.hpp"
#include "tools/mission/reference.hpp"
#include "tools/mission/start_pose.hpp"
#include "tools/mission/view_pipe.hpp"
#include "tools/run_files/candidates_jsonl.hpp"
#include "tools/run_files/file_names.hpp"
#include "tools/run_files/frames_folder.hpp"
#include "tools/run_files/iterations_csv.hpp"
#include "tools/run_files/profile_map.hpp"
#include "tools/run_files/run_claim.hpp"
#include "tools/run_files/run_commands.hpp"
#include "tools/run_files/run_directory.hpp"
#include "tools/run_files/run_inputs.hpp"
#include "tools/run_files/summary_json.hpp"
#include "tools/run_files/words.hpp"
#include "tools/terminal/interrupt.hpp"
#include "tools/terminal/progress.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// Memory that grows with the threads is not in the scenario's own budget.
void need_memory_for(const Scenario& scenario, int threads) {
  const GridGeometry grid(scenario.workspace_m, scenario.planner.map.resolution_m);
  const auto bytes = static_cast<double>(map_bytes(grid, threads, scenario.cameras.size()));
  if (bytes <= kMapBudget_bytes) return;
  throw BadInput(
      fmt::format("--threads {}: a map of {} voxels needs {:.1f} GiB with so many, the "
                  "budget is {:.0f} GiB",
                  threads, grid.voxel_count(), bytes / 0x1p30, kMapBudget_bytes / 0x1p30));
}

/// A saved profile that cannot be used is found before anything is written.
void need_saved_profile(const Scenario& scenario) {
  const ProfilingConfig& profiling = scenario.planner.profiling;
  if (profiling.method != ProfilingMethod::saved) return;
  read_belief(profiling.file,
              PlannerModel(scenario.planner, scenario.workspace_m, camera_models(scenario), {}));
}

/// Who flies given views needs some.
void need_views(const Scenario& scenario, bool are_piped) {
  const std::string& utility = scenario.planner.utility.name;
  if (are_piped || !is_given_route(utility) || !scenario.planner.routes.views.empty()) return;
  throw BadInput(fmt::format(
      "planner.routes.views: holds no view, and planner.utility.name = {} flies what it holds; "
      "--views FILE gives some",
      kGivenRouteName));
}

/// On stderr, and to whoever wants to know.
class Shown {
 public:
  Shown(ProgressBar& bar, const MissionOptions& options) : bar_(bar), options_(options) {}
  void show(double share_done, const std::string& note) {
    bar_.show(share_done, note);
    if (options_.on_progress) options_.on_progress(share_done, note);
  }

 private:
  ProgressBar& bar_;
  const MissionOptions& options_;
};

/// The views of an oracle, which knows the structure; nothing for those who have to find out.
std::optional<std::vector<Decision>> oracle_route(const Scenario& scenario, const World& world,
                                                  const RayScene& scene, Shown& progress,
                                                  int threads) {
  const std::string& utility = scenario.planner.utility.name;
  if (!is_oracle(utility)) return std::nullopt;
  progress.show(0.0, "planning on the true structure");
  return plan_oracle(scenario, world, scene, start_pose(scenario, scene), aim_of(utility), threads);
}

MissionHooks make_hooks(const Scenario& scenario, const MissionOptions& options,
                        RunDirectory& directory, Shown& progress) {
  MissionHooks hooks;
  hooks.on_profile = [&progress](double share) { progress.show(0.1 * share, "profile"); };
  hooks.on_profile_belief = [&](const Belief& belief) { directory.write_profile(belief); };
  hooks.on_view = [&](const ViewRecord& view) {
    directory.need_as_recorded(view);
    directory.append(view);
    const int last = scenario.planner.termination.max_iterations;
    progress.show(0.1 + 0.9 * (view.iteration + 1) / last,
                  fmt::format("view {}/{}  {:.0f} m  {} points", view.iteration + 1, last,
                              view.straight_m, grouped(view.cloud_points)));
  };
  hooks.should_stop = [&options] { return InterruptGuard::requested() || options.should_stop(); };
  hooks.replay = directory.recorded_decisions();
  return hooks;
}

/// The folder of the mission, which nobody else flies into until it is over.
RunClaim claim_folder(const Scenario& scenario, const MissionOptions& options) {
  if (options.out.empty()) {
    return RunClaim::of_free_folder(fmt::format(
        "{}-{}-seed{}", scenario.name, utility_label(scenario.planner.utility), scenario.seed));
  }
  need_usable(options.out, scenario, options.resume);
  return RunClaim(options.out);
}

/// A run goes on in the world that it began in.
std::vector<RunInput> inputs_as_begun(const Scenario& scenario, const World& world,
                                      const fs::path& run) {
  std::vector<RunInput> inputs = run_inputs(scenario, world);
  need_same_inputs(run, inputs, "put it back, or fly anew: " + command_to_fly_again(run));
  return inputs;
}

}  // namespace

void need_unchanged(const fs::path& run, const Scenario& scenario) {
  std::vector<std::string> told_by_run;
  inputs_as_begun(scenario, load_world_anywhere(scenario, told_by_run), run);
  const fs::path csv = run / kIterationsFile;
  need_views_of_summary(csv, read_summary(run), read_view_records(csv));
}

int thread_count(int threads) {
  if (threads > 0) return threads;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

ExecutedMission execute_mission(const Scenario& scenario, const MissionOptions& options) {
  const Stopwatch watch;
  if (options.resume && options.out.empty()) {
    throw BadInput("--resume: needs --out, the run directory to continue");
  }
  need_views(scenario, options.piped_views || options.planner != nullptr);
  const int threads = thread_count(options.threads);
  need_memory_for(scenario, threads);
  // all that can be wrong with the input is found before the first file is written
  std::vector<std::string> warnings;
  const World world = load_world(scenario, warnings);
  for (const std::string& warning : warnings) say(warning);
  const RayScene scene(world);
  need_room_for(scenario.score.sizes_m, world.structure);
  const ViewPose start = start_pose(scenario, scene);
  need_way_out(scenario, scene, bounds_m(world.structure), start, threads);
  if (const std::string warning = profile_warning(scenario, scene, start); !warning.empty()) {
    say(warning);
  }
  need_saved_profile(scenario);
  const OwnScores own_scores = start_own_utility(scenario.planner.utility);
  if (scenario.planner.symmetry.enabled) symmetry_module();  // throws when it is missing
  const RunClaim claim = claim_folder(scenario, options);    // an oracle may think for minutes
  ProgressBar bar(fmt::format("{} {}", scenario.name, utility_label(scenario.planner.utility)),
                  options.quiet);
  Shown progress(bar, options);
  progress.show(0.0, "finding what there is to see");
  const SurfaceReference reference = reference_of(scenario, world, scene, threads);
  std::optional<std::vector<Decision>> route =
      oracle_route(scenario, world, scene, progress, threads);
  RunDirectory directory(claim.folder(), scenario, options.resume);
  write_inputs(directory.path(), inputs_as_begun(scenario, world, directory.path()));
  const InterruptGuard interrupt;
  try {
    MissionHooks hooks = make_hooks(scenario, options, directory, progress);
    hooks.route = std::move(route);
    hooks.own_scores = own_scores;
    hooks.is_covered = coverage_goal(scenario.benchmark, reference, scene);
    std::optional<FramesFolder> frames;
    if (options.frames) {
      frames.emplace(directory.path(), camera_models(scenario));
      hooks.on_frames = [&](const auto&... all) { frames->write(all...); };
    }
    std::optional<CandidatesFile> candidates;
    std::optional<BeliefLog> beliefs;
    if (options.candidates) {
      candidates.emplace(directory.path(), directory.recorded().size());
      hooks.on_candidates = [&](const auto&... all) { candidates->write(all...); };
      beliefs.emplace(scenario, directory.path(), directory.recorded().size());
      beliefs->connect(hooks);
    }
    std::optional<ViewPipe> pipe;
    if (options.piped_views) {
      pipe.emplace(scenario, directory, options.frames, options.coverage ? &reference : nullptr);
      pipe->connect(hooks);
    }
    std::optional<OwnPlannerHooks> planner;
    if (options.planner != nullptr) {
      planner.emplace(*options.planner, scenario, directory);
      planner->connect(hooks);
    }
    MissionResult result = run_mission(scenario, world, scene, hooks, threads);
    directory.need_as_recorded(result);
    const Stopwatch scoring;
    progress.show(1.0, "scoring");
    ScoredCloud cloud = scored_cloud(result);
    cloud.region_m = scenario.score.region_m;
    MissionScore score =
        score_cloud(reference, scene, cloud, scenario.planner.map.resolution_m, threads);
    score.more = score_more_sizes(scenario.score.sizes_m, world, scene, scenario.planner.floor_z_m,
                                  cloud, threads);
    result.wall.score_s = scoring.elapsed_s();
    score.ceiling = run_ceiling(scenario, world, scene, options.ceiling, threads);
    // before the summary, which says that all is there
    if (candidates) candidates->finish();
    if (beliefs) beliefs->finish();
    const Scenario& flown = pipe ? pipe->scenario() : planner ? planner->scenario() : scenario;
    directory.finish(flown, result, score, watch.elapsed_s());
    return {directory.path(), std::move(result), score, watch.elapsed_s()};
  } catch (const BrokenInvariant& broken) {
    throw BrokenInvariant(fmt::format("{}\nreplay with: gnbv run {} --out REPLAY", broken.what(),
                                      shell_word((directory.path() / kScenarioFile).string())));
  }
}

}  // namespace gnbv
