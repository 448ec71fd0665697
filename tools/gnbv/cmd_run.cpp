#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "bench/compare/paper_table.hpp"
#include "planner/planners.hpp"
#include "scenarios/load.hpp"
#include "scenarios/problems.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/early_end.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/live/live_report.hpp"
#include "tools/mesh_lint/mesh_report.hpp"
#include "tools/mission/execute.hpp"
#include "tools/mission/view_pipe.hpp"
#include "tools/page/page_text.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/frames_folder.hpp"
#include "tools/run/run_directory.hpp"
#include "tools/run/run_files.hpp"
#include "tools/run/summary_json.hpp"
#include "tools/terminal/piped_command.hpp"
#include "tools/terminal/say.hpp"
#include "tools/terminal/streams.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct RunOptions {
  ScenarioOptions scenario;
  MissionOptions mission;
  bool json = false;
  std::optional<int> live_port = {};
  std::string command = {};  // that sends the views
};

void need_route(const RunOptions& options, const Scenario& scenario) {
  if (options.mission.coverage && !options.mission.piped_views) {
    throw BadInput("--coverage: goes with --views -, whose answers it adds to");
  }
  if (options.mission.piped_views && options.json && options.command.empty()) {
    throw BadInput("--json: with --views -, stdout belongs to whoever sends views");
  }
  if (options.mission.rounds_views && !is_user_planner(scenario.planner.utility)) {
    throw BadInput("--round-views: goes with a planner of yours, --utility FILE.py:FUNCTION");
  }
  const bool has_views = options.mission.piped_views || !options.scenario.views.empty();
  if (!has_views || scenario.planner.utility.name == kRouteName) return;
  throw BadInput("--views {}: goes with --utility {}, not {}",
                 options.mission.piped_views ? "-" : options.scenario.views, kRouteName,
                 scenario.planner.utility.name);
}

void set_views(const std::string& file, RunOptions& options) {
  const bool is_command = file.starts_with('|');
  options.command = is_command ? file.substr(1) : "";
  options.mission.piped_views = file == "-" || is_command;
  options.scenario.views = options.mission.piped_views ? "" : file;
}

/// What a mission flies in spite of: keys that do nothing, surface that is cleared through, and
/// what lint warns of in a mesh. What its reader left out is said when the mission loads it.
void say_doubts(const Scenario& scenario, const std::vector<std::string>& unused_notes) {
  for (const std::string& note : unused_notes) say(note);
  if (const std::string note = clearing_note(scenario); !note.empty()) say(note);
  for (const std::string& warning : mesh_warnings(scenario, thread_count(0))) say(warning);
}

void print_summary(const RunOptions& options, const Scenario& scenario, const fs::path& folder) {
  if (options.json) {
    fmt::print("{}", read_file(folder / kSummaryFile));
  } else {
    fmt::print("{}\n{}\n",
               one_row_summary(mission_row(read_run_figures(folder)), has_papers_setting(scenario),
                               stdout_columns()),
               folder.string());
  }
}

/// Whether there are frames of the last view: a run that was resumed without them lacks some.
bool has_all_frames(const fs::path& run) {
  try {
    const std::optional<std::uint64_t> views = read_summary(run).iterations;
    return views && std::cmp_equal(read_frames(run).frames.back().iteration + 1, *views);
  } catch (const BadInput&) {
    return false;
  }
}

/// Whether a finished run has what is asked for beside its record.
bool has_extras(const MissionOptions& asked) {
  return (!asked.frames || has_all_frames(asked.out)) &&
         (!asked.candidates || RunFiles(asked.out).find(kCandidatesFile)) &&
         (asked.ceiling != CeilingFrom::search || read_run_figures(asked.out).ceiling);
}

/// Whether the run to be resumed has ended by itself, and all that is asked for is there: its
/// summary is printed, and no file of it is touched.
bool has_ended(const RunOptions& options, const Scenario& scenario) {
  const MissionOptions& mission = options.mission;
  if (!mission.resume || !RunFiles(mission.out).is_finished() || mission.piped_views) return false;
  if (!has_extras(mission)) return false;
  need_usable(mission.out, scenario, mission.resume);
  need_unchanged(mission.out, scenario);
  const std::string ended = *read_summary(mission.out).termination;
  say("{}: is finished already ({}): nothing to resume", mission.out.string(), ended);
  print_summary(options, scenario, mission.out);
  if (ended == "off_course" || ended == "collision") throw CommandFailed("it ended by " + ended);
  return true;
}

/// Who serves the page of the mission while it flies, where that is asked for.
std::unique_ptr<LiveChild> watched(const RunOptions& options) {
  if (!options.live_port) return nullptr;
  if (options.mission.out.empty()) throw BadInput("--live: needs --out, the run directory to show");
  if (!why_no_page().empty()) {
    throw CommandFailed("--live: this gnbv was built without its page: {}", why_no_page());
  }
  auto live = std::make_unique<LiveChild>(options.mission.out, *options.live_port);
  say("live: {}", live->url());
  return live;
}

void need_end_in_order(const ExecutedMission& mission, bool has_piped_views) {
  const MissionResult& result = mission.result;
  switch (result.termination) {
    case Termination::utility_failed:
      throw CommandFailed(result.failure);
    case Termination::off_course:
      throw CommandFailed(
          "the vehicle was carried out of the workspace; the run directory shows where");
    case Termination::collision:
      throw CommandFailed("the vehicle hit something; the run directory shows where");
    case Termination::interrupted:
      throw CommandFailed("interrupted after {} views; {} continues it", result.views.size(),
                          command_to_resume(mission.folder, has_piped_views ? "--views -" : ""));
    default:
      return;
  }
}

/// The mission, with whoever is at the other end of the pipe.
ExecutedMission fly(const RunOptions& options, const Scenario& scenario) {
  std::optional<PipedCommand> command;
  MissionOptions how = options.mission;
  if (!options.command.empty()) {
    PipedCommand& started = command.emplace(options.command);
    how.views_fault = [&started] { return started.fault(); };
  }
  ExecutedMission mission = execute_mission(scenario, how);
  if (how.piped_views) fmt::print("{}", pipe_end_line(mission.result, mission.folder.string()));
  return mission;
}

void run(const RunOptions& options) {
  std::vector<std::string> unused_notes;
  const Scenario scenario = resolve_scenario(options.scenario, &unused_notes);
  need_route(options, scenario);
  if (has_ended(options, scenario)) return;
  say_doubts(scenario, unused_notes);
  const std::unique_ptr<LiveChild> live = watched(options);
  const ExecutedMission mission = fly(options, scenario);
  if (!options.mission.piped_views || !options.command.empty()) {
    print_summary(options, scenario, mission.folder);
  }
  const MissionResult& result = mission.result;
  for (const std::string& note :
       {refused_views_note(result),
        early_end_note(result, mission.score.final[0], traits_of(scenario.planner)),
        margin_note(scenario, result.path_error)}) {
    if (!note.empty()) say(note);
  }
  need_end_in_order(mission, options.mission.piped_views);
}

}  // namespace

void add_run_command(CLI::App& app) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* const command = app.add_subcommand("run", "fly one mission and score it");
  MissionOptions& mission = options->mission;
  add_scenario_options(*command, options->scenario);
  command->add_option(
      "--utility", options->scenario.utility,
      "utility by name, or a utility or planner of yours in Python: [NAME=]FILE.py[:FUNCTION]");
  command->add_option_function<std::string>(
      "--views", [options](const std::string& file) { set_views(file, *options); },
      "with --utility route: body poses to fly, CSV or TUM; -: one per line from stdin, each "
      "answered by one line of JSON on stdout; '|COMMAND': the same with a command of the shell");
  command->add_flag("--coverage", mission.coverage,
                    "with --views -: answers tell the true coverage");
  add_preset_option(*command, options->scenario);
  command->add_flag_callback(
      "--portable", [options] { options->scenario.overrides.emplace_back("portable=true"); },
      "the same digits on every x86-64 processor; sensing takes longer");
  command->add_option("--out", mission.out, "run directory (default: a new one under runs/)");
  add_threads_option(*command, mission.threads);
  add_quiet_option(*command, mission.quiet);
  command->add_flag("--resume", mission.resume, "continue the interrupted run in --out");
  command->add_flag("--frames", mission.frames, "also write what the cameras saw, to frames/");
  command->add_flag("--round-views", mission.rounds_views,
                    "of a planner of yours in Python: angles as files hold them, so that its views "
                    "alone fly the same again, bit by bit");
  command->add_flag("--candidates", mission.candidates,
                    "also write the terms of every candidate, or why it was rejected, and the "
                    "voxels that each view was chosen for");
  command->add_flag_callback(
      "--ceiling", [options] { options->mission.ceiling = CeilingFrom::search; },
      "find the ceiling if no earlier command did, so that summary.json has the effort to reach "
      "it");
  command
      ->add_option("--live", options->live_port,
                   "PORT: serve the report of the mission to browsers of this machine while it "
                   "flies; 0: any free port")
      ->check(CLI::Range(0, 65535));
  command->add_flag("--json", options->json, "print summary.json instead of a table");
  command->callback([options] { run(*options); });
}

}  // namespace gnbv
