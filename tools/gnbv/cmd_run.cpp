#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "bench/compare/paper_table.hpp"
#include "sim/core/file.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/mission/execute.hpp"
#include "tools/run_files/run_directory.hpp"
#include "tools/run_files/run_figures_file.hpp"

namespace gnbv {
namespace {

struct RunOptions : MissionOptions {
  bool json = false;
};

void run(const RunOptions& options) {
  const Scenario scenario = resolve_scenario(options);
  const ExecutedMission mission = execute_mission(scenario, options);
  if (options.json) {
    fmt::print("{}", read_file(mission.folder / "summary.json"));
  } else {
    fmt::print("{}\n{}\n", one_row_summary(read_run_figures(mission.folder)),
               mission.folder.string());
  }
  if (mission.result.termination == Termination::collision) {
    throw CommandFailed("the vehicle hit something; the run directory shows where");
  }
  if (mission.result.termination == Termination::interrupted) {
    throw CommandFailed(fmt::format("interrupted after {} views; {} continues it",
                                    mission.result.views.size(),
                                    command_to_resume(mission.folder)));
  }
}

}  // namespace

void add_structure_options(CLI::App& command, MissionOptions& options) {
  command.add_option("--mesh", options.mesh, "a mesh file instead of the scenario's structure");
  command.add_option("--seed", options.seed, "moves the start pose and keys all noise");
  command.add_option("--set", options.overrides, "KEY=VALUE of the scenario file; repeatable")
      ->allow_extra_args(false);
  command
      .add_option_function<std::string>(
          "--bounds",
          [&options](const std::string& bounds) { options.bounds_auto = bounds == "auto"; },
          "auto: lay workspace and start around the structure, wherever it is; scenario: as it "
          "says")
      ->check(CLI::IsMember({"auto", "scenario"}));
}

void add_scenario_options(CLI::App& command, MissionOptions& options) {
  command.add_option("SCENARIO", options.scenario, "built-in name or YAML file")->required();
  add_structure_options(command, options);
}

void add_work_options(CLI::App& command, MissionOptions& options) {
  command.add_option("--out", options.out, "run directory (default: a new one under runs/)");
  command.add_option("--threads", options.threads, "0 = all; the result does not depend on it")
      ->check(CLI::Range(0, 1024));
  command.add_flag("--quiet", options.quiet, "no progress on stderr");
}

void add_mission_options(CLI::App& command, MissionOptions& options) {
  add_scenario_options(command, options);
  add_work_options(command, options);
}

void add_run_command(CLI::App& app) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* const command = app.add_subcommand("run", "fly one mission and score it");
  add_mission_options(*command, *options);
  command->add_option("--utility", options->utility, "utility by name");
  command->add_option("--preset", options->preset, "paper, or released: the authors' own code");
  command->add_flag("--resume", options->resume, "continue the interrupted run in --out");
  command->add_flag("--frames", options->frames, "also write what the cameras saw, to frames/");
  command->add_flag("--candidates", options->candidates,
                    "also write every candidate's terms or reason of rejection");
  command->add_flag("--json", options->json, "print summary.json instead of a table");
  command->callback([options] { run(*options); });
}

}  // namespace gnbv
