#include "tools/mission/execute.hpp"

#include <optional>
#include <thread>

#include "bench/limits/oracle.hpp"
#include "planner/core/belief.hpp"
#include "planner/map/grid_geometry.hpp"
#include "planner/planners.hpp"
#include "planner/symmetry/symmetry.hpp"
#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/stopwatch.hpp"
#include "sim/core/text.hpp"
#include "tools/mission/decision_log.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/mission.hpp"
#include "tools/mission/start_pose.hpp"
#include "tools/mission/view_pipe.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/frames_folder.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/run_claim.hpp"
#include "tools/run/run_directory.hpp"
#include "tools/run/run_files.hpp"
#include "tools/run/run_inputs.hpp"
#include "tools/run/summary_json.hpp"
#include "tools/run/user_views.hpp"
#include "tools/terminal/progress.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// Memory that grows with the threads is not in the scenario's own budget.
void need_memory_for(const Scenario& scenario, int threads) {
  const GridGeometry grid(scenario.workspace_m, scenario.planner.map.resolution_m);
  const double bytes =
      planning_bytes(scenario.planner, scenario.workspace_m, threads, scenario.cameras.size());
  if (bytes <= kMapBudget_bytes) return;
  throw BadInput(
      "--threads {}: a map of {} voxels needs {:.1f} GiB with so many, the budget is {:.0f} GiB",
      threads, grid.voxel_count(), bytes / 0x1p30, kMapBudget_bytes / 0x1p30);
}

void need_cameras(const Scenario& scenario) {
  if (!scenario.cameras.empty()) return;
  throw BadInput("--frames: {} has no camera whose frames could be kept", scenario.name);
}

/// A saved profile that cannot be used is found before anything is written.
void need_saved_profile(const Scenario& scenario) {
  const ProfilingConfig& profiling = scenario.planner.profiling;
  if (profiling.method != ProfilingMethod::saved) return;
  std::vector<std::string> notes;
  read_belief(profiling.file, planner_model(scenario), &notes);
  for (const std::string& note : notes) say(note);
}

/// That the structure can be scored, and flown around from the start; tells what that is.
void need_room_to_fly(const Scenario& scenario, const World& world, const RayScene& scene,
                      int threads, bool is_quiet) {
  need_room_for(scenario.score.sizes_m, world.structure);
  const ViewPose start = start_pose(scenario, scene);
  need_way_out(scenario, scene, bounds_m(world.structure), start, threads);
  need_way_up(scenario, world, scene, start);
  const std::string moved = moved_start_note(scenario, start);
  if (!moved.empty() && !is_quiet) say(moved);
  if (const std::string warning = profile_warning(scenario, scene, start); !warning.empty()) {
    say(warning);
  }
  need_saved_profile(scenario);
}

/// Who flies given views needs some.
void need_views(const Scenario& scenario, bool are_asked_for) {
  if (are_asked_for || !traits_of(scenario.planner).takes_views) return;
  if (!scenario.planner.routes.views.empty()) return;
  throw BadInput(
      "planner.routes.views: holds no view, and planner.utility.name = {} flies what it holds; "
      "--views FILE gives some",
      scenario.planner.utility.name);
}

/// Who is given views one by one goes on with those that the run was given: all are in its
/// scenario.yaml or, when it was killed, on their way there.
Scenario with_views_of_run(const Scenario& asked, const MissionOptions& options) {
  Scenario scenario = asked;
  const fs::path yaml = options.out / kScenarioFile;
  if (!options.resume || !traits_of(asked.planner).takes_views || !fs::exists(yaml)) return asked;
  std::vector<ViewPose> given = views_on_the_way(options.out);
  if (given.empty() && options.piped_views) {
    given = load_flown_scenario(yaml.string()).planner.routes.views;
  }
  std::vector<ViewPose>& views = scenario.planner.routes.views;
  if (given_rows(given).starts_with(given_rows(views))) views = std::move(given);
  return scenario;
}

/// On stderr, and to whoever wants to know.
using Progress = std::function<void(double share_done, const std::string& note)>;

/// The views of who knows the structure; nothing for those who have to find out.
KnownRoute known_route(const Scenario& scenario, const World& world, const RayScene& scene,
                       const SurfaceReference& reference, const Progress& show_progress,
                       const std::function<bool()>& should_stop, int threads) {
  if (!traits_of(scenario.planner).knows_structure) return {};
  show_progress(0.0, "looking at the true structure");
  try {
    return plan_oracle(scenario, world, scene, reference, start_pose(scenario, scene), threads,
                       [&] {
                         if (should_stop()) throw StopRequested();
                       });
  } catch (const StopRequested&) {  // the mission ends before its first view
    return [](const SurfaceCloud&, const HeedStop&) { return std::vector<Decision>(); };
  }
}

/// Keeps the mission's record while it flies, and says how far it is.
class RunRecorder final : public MissionObserver {
 public:
  RunRecorder(const Scenario& scenario, RunDirectory& directory, const Progress& show_progress)
      : last_(scenario.planner.termination.max_iterations),
        directory_(directory),
        show_progress_(show_progress) {}
  void on_profile(double share_done) override { show_progress_(0.1 * share_done, "profile"); }
  void on_profile_belief(const Belief& belief) override { directory_.write_profile(belief); }
  void on_view(const ViewRecord& view, const Belief&) override {
    directory_.need_as_recorded(view);
    directory_.append(view);
    show_progress_(0.1 + 0.9 * (view.iteration + 1) / last_,
                   fmt::format("view {}/{}  {:.0f} m  {} points", view.iteration + 1, last_,
                               view.straight_m, grouped(view.cloud_points)));
  }

 private:
  int last_;  // view at most
  RunDirectory& directory_;
  const Progress& show_progress_;
};

class FramesRecorder final : public MissionObserver {
 public:
  FramesRecorder(const fs::path& run, const Scenario& scenario)
      : folder_(run, camera_models(scenario)) {}
  bool wants_colour() const override { return true; }
  void on_sensed(const SensedView& view) override {
    folder_.write(view.iteration, view.time_s, view.depth, view.colour);
  }

 private:
  FramesFolder folder_;
};

/// All that keeps a mission's record, and who gives it views: connected to its inputs by the
/// options. Keeps references to all but the inputs.
struct Attached {
  Attached(const Scenario& scenario, const MissionOptions& options,
           const SurfaceReference& reference, const UserPlanner* asked,
           const Progress& show_progress, RunDirectory& directory, MissionInputs& inputs)
      : planned(scenario), recorder(scenario, directory, show_progress) {
    inputs.replay = directory.recorded_decisions();
    inputs.observers = {&recorder};
    if (options.candidates) {
      decisions.emplace(scenario, directory.path(), directory.recorded().size());
      inputs.observers.push_back(&*decisions);
    }
    if (options.frames) {
      inputs.observers.push_back(&frames.emplace(directory.path(), scenario));
    }
    if (options.piped_views) {
      pipe.emplace(scenario, directory, options.frames, options.coverage ? &reference : nullptr,
                   options.views_fault)
          .connect(inputs);
    }
    if (asked != nullptr) planner.emplace(*asked, scenario, options.rounds_views).connect(inputs);
    if (options.observer != nullptr) inputs.observers.push_back(options.observer);
  }

  /// With the views that were given, which fly the mission again.
  Scenario as_flown(Termination end) const {
    if (pipe) return pipe->scenario();
    return planner ? planner->repeatable(end) : planned;
  }

  const Scenario& planned;
  RunRecorder recorder;
  std::optional<DecisionLog> decisions;
  std::optional<FramesRecorder> frames;  // `--frames`
  std::optional<ViewPipe> pipe;
  std::optional<UserPlannerLink> planner;
};

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

ExecutedMission execute_mission(const Scenario& asked, const MissionOptions& options) {
  const Stopwatch watch;
  if (options.resume && options.out.empty()) {
    throw BadInput("--resume: needs --out, the run directory to continue");
  }
  const Scenario scenario = with_views_of_run(asked, options);
  const bool asks_planner = options.planner != nullptr || is_user_planner(scenario.planner.utility);
  need_views(scenario, options.piped_views || asks_planner);
  const int threads = thread_count(options.threads);
  need_memory_for(scenario, threads);
  // all that can be wrong with the input is found before the first file is written
  std::vector<std::string> warnings;
  const World world = load_world(scenario, warnings);
  for (const std::string& warning : warnings) say(warning);
  const RayScene scene(world);
  need_room_to_fly(scenario, world, scene, threads, options.quiet);
  if (options.frames) need_cameras(scenario);
  const UserScores user_scores = start_user_utility(scenario.planner.utility);
  const std::unique_ptr<UserPlanner> in_file = start_user_planner(scenario, threads);
  if (scenario.planner.symmetry.enabled) symmetry_module();  // throws when it is missing
  const RunClaim claim = claim_folder(scenario, options);    // an oracle may think for minutes
  ProgressBar bar(fmt::format("{} {}", scenario.name, utility_label(scenario.planner.utility)),
                  options.quiet);
  const Progress show_progress = [&](double share_done, const std::string& note) {
    bar.show(share_done, note);
    if (options.on_progress) options.on_progress(share_done, note);
  };
  show_progress(0.0, "finding what there is to see");
  const SurfaceReference reference = reference_of(
      scenario, world, scene, threads, [&](const std::string& note) { show_progress(0.0, note); });
  auto interrupt = std::make_unique<const InterruptGuard>();
  const auto should_stop = [&] { return InterruptGuard::requested() || options.should_stop(); };
  auto route = known_route(scenario, world, scene, reference, show_progress, should_stop, threads);
  const auto as_begun = inputs_as_begun(scenario, world, claim.folder());
  RunDirectory directory(claim.folder(), scenario, options.resume);
  write_inputs(directory.path(), as_begun);
  try {
    MissionInputs inputs;
    inputs.should_stop = should_stop;
    inputs.is_covered = coverage_goal(scenario.benchmark, reference, scene);
    inputs.sources.user_scores = user_scores;
    inputs.sources.route = std::move(route);
    const UserPlanner* const asked_planner = in_file ? in_file.get() : options.planner;
    Attached attached(scenario, options, reference, asked_planner, show_progress, directory,
                      inputs);
    MissionResult result = run_mission(scenario, world, scene, inputs, threads);
    directory.need_as_recorded(result);
    const Stopwatch scoring;
    show_progress(1.0, "scoring");
    MissionScore score =
        score_as_asked(scenario, world, scene, reference, scored_cloud(scenario, result), threads);
    result.wall.score_s = scoring.elapsed_s();
    score.ceiling = run_ceiling(scenario, world, scene, options.ceiling, threads);
    if (attached.decisions) attached.decisions->finish();  // the summary says that all is there
    directory.finish(attached.as_flown(result.termination), result, score, watch.elapsed_s());
    return {directory.path(), std::move(result), score, watch.elapsed_s(), std::move(interrupt)};
  } catch (const BrokenInvariant& broken) {
    throw BrokenInvariant(fmt::format("{}\nreplay with: gnbv run {} --out REPLAY", broken.what(),
                                      shell_word((directory.path() / kScenarioFile).string())));
  }
}

}  // namespace gnbv
