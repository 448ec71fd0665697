#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "bench/limits/ceiling.hpp"
#include "sim/core/error.hpp"
#include "sim/core/stopwatch.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/mission/execute.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/reference.hpp"
#include "tools/mission/start_pose.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/run_inputs.hpp"
#include "tools/terminal/progress.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

struct CeilingOptions {
  ScenarioOptions scenario;
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

/// Unless the user asks for another world than that of the run.
void need_inputs_of_run(const ScenarioOptions& options, const Scenario& scenario,
                        const World& world) {
  const bool is_as_flown = options.mesh.empty() && options.overrides.empty();
  if (!is_as_flown || !std::filesystem::is_directory(options.scenario)) return;
  need_same_inputs(options.scenario, world_inputs(scenario, world),
                   "the ceiling would be of another structure; put it back");
}

/// A run directory stands for its scenario.yaml.
ScenarioOptions of_run(ScenarioOptions options) {
  const std::filesystem::path run = options.scenario;
  if (!std::filesystem::is_directory(run)) return options;
  const std::filesystem::path yaml = run / kScenarioFile;
  if (!std::filesystem::exists(yaml)) {
    throw BadInput(
        "{}: no run directory: {} is missing; a scenario is a built-in name or a YAML file",
        run.string(), yaml.string());
  }
  options.scenario = yaml.string();
  return options;
}

void ceiling(const CeilingOptions& options) {
  const Stopwatch watch;
  const Scenario scenario = resolve_scenario(of_run(options.scenario));
  const int threads = thread_count(options.threads);
  std::vector<std::string> warnings;
  const World world = load_world(scenario, warnings);
  for (const std::string& warning : warnings) say(warning);
  need_inputs_of_run(options.scenario, scenario, world);
  const RayScene scene(world);
  ProgressBar progress(fmt::format("{} ceiling", scenario.name), options.quiet);
  reference_of(scenario, world, scene, threads,
               [&](const std::string& note) { progress.show(0.0, note); });
  progress.show(0.0, "where viewpoints are legal");
  const ViewPose start = start_pose(scenario, scene);
  const Ceiling found = find_ceiling(scenario, world, scene, start, threads, [&](double share) {
    progress.show(share, "of the surface searched for");
  });
  progress.show(1.0, "done");
  const double wall_s = watch.elapsed_s();
  fmt::print("{}",
             options.json ? ceiling_json(scenario, found, wall_s) : ceiling_text(found, wall_s));
}

}  // namespace

void add_ceiling_command(CLI::App& app) {
  auto options = std::make_shared<CeilingOptions>();
  CLI::App* const command = app.add_subcommand(
      "ceiling", "print the most that any planner could cover from allowed positions");
  add_scenario_options(*command, options->scenario);
  command->get_option("SCENARIO")->description("built-in name, YAML file or run directory");
  add_threads_option(*command, options->threads);
  add_quiet_option(*command, options->quiet);
  command->add_flag("--json", options->json, "print JSON instead of a table");
  command->callback([options] { ceiling(*options); });
}

}  // namespace gnbv
