#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/limits/ceiling.hpp"
#include "bench/limits/oracle.hpp"
#include "bench/score/voxel_set.hpp"
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
  bool oracle = false;
};

/// The rows of the report: a name for readers, one for programs, and the shares.
struct Row {
  const char* text;
  const char* key;
  std::array<double, 3> share;
};

std::array<Row, 4> rows_of(const Ceiling& ceiling) {
  return {{{"seen, of the surface visible from outside", "outside", ceiling.outside},
           {"seen, of all surface", "raw", ceiling.raw},
           {"kept by the cloud, visible from outside", "leaf_outside", ceiling.leaf_outside},
           {"kept by the cloud, of all surface", "leaf_raw", ceiling.leaf_raw}}};
}

std::string json_text(const Scenario& scenario, const Ceiling& ceiling,
                      const nlohmann::ordered_json& oracle, double wall_s) {
  nlohmann::ordered_json out = {{"schema", "gnbv-ceiling-1"},
                                {"scenario", scenario.name},
                                {"structure", structure_name(scenario.structure)},
                                {"seed", scenario.seed},
                                {"positions", ceiling.positions}};
  for (const Row& row : rows_of(ceiling)) {
    out[row.key] = {{"0.05", row.share[0]}, {"0.10", row.share[1]}, {"0.50", row.share[2]}};
  }
  if (!oracle.empty()) out["oracle"] = oracle;
  out["wall_s"] = wall_s;
  return out.dump(2) + "\n";
}

std::string terminal_text(const Ceiling& ceiling, double wall_s) {
  std::string text =
      fmt::format("{:<44}{:>9}{:>9}{:>9}\n", "share of the voxels", "0.05 m", "0.10 m", "0.50 m");
  for (const Row& row : rows_of(ceiling)) {
    text += fmt::format("{:<44}{:>7.1f} %{:>7.1f} %{:>7.1f} %\n", row.text, 100.0 * row.share[0],
                        100.0 * row.share[1], 100.0 * row.share[2]);
  }
  return text +
         fmt::format(
             "{} legal positions and the places between them, {:.1f} s\n"
             "of exact sensors, the profile's LIDAR among them: noise can lift a mission above it\n"
             "a voxel counts with surface of a tenth of its face\n",
             ceiling.positions, wall_s);
}

std::string oracle_text(std::span<const OracleReach> reaches) {
  std::string text =
      "known the structure, metres and views planned for that share of the cloud's "
      "0.05 m voxels alone:\n";
  for (const OracleReach& reach : reaches) {
    text += fmt::format("{:>4.0f} %{:>9.1f} m in {} views; greedily {:.1f} m in {}\n",
                        100.0 * reach.share, reach.length_m, reach.views, reach.greedy_m,
                        reach.greedy_views);
  }
  return text;
}

nlohmann::ordered_json oracle_json(std::span<const OracleReach> reaches) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const OracleReach& reach : reaches) {
    out.push_back({{"share", reach.share},
                   {"views", reach.views},
                   {"length_m", reach.length_m},
                   {"greedy_views", reach.greedy_views},
                   {"greedy_m", reach.greedy_m}});
  }
  return out;
}

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
        fmt::format("{}: no run directory: {} is missing; a scenario is a built-in name "
                    "or a YAML file",
                    run.string(), yaml.string()));
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
  progress.show(0.0, "where viewpoints are legal");
  const ViewPose start = start_pose(scenario, scene);
  const Ceiling found = find_ceiling(scenario, world, scene, start, threads, [&](double share) {
    progress.show(share, "of the surface searched for");
  });
  std::vector<OracleReach> reaches;
  if (options.oracle) {
    progress.show(0.99, "planning on the true structure");
    reaches = oracle_reaches(scenario, world, scene, reference_of(scenario, world, scene, threads),
                             start, threads);
  }
  progress.show(1.0, "done");
  const double wall_s = watch.elapsed_s();
  if (options.json) {
    fmt::print("{}", json_text(scenario, found, oracle_json(reaches), wall_s));
    return;
  }
  fmt::print("{}", terminal_text(found, wall_s));
  if (options.oracle) fmt::print("{}", oracle_text(reaches));
}

}  // namespace

void add_ceiling_command(CLI::App& app) {
  auto options = std::make_shared<CeilingOptions>();
  CLI::App* const command =
      app.add_subcommand("ceiling", "print the most that any legal viewpoint can see");
  add_scenario_options(*command, options->scenario);
  command->get_option("SCENARIO")->description("built-in name, YAML file or run directory");
  add_threads_option(*command, options->threads);
  add_quiet_option(*command, options->quiet);
  command->add_flag("--json", options->json, "print JSON instead of a table");
  command->add_flag("--oracle", options->oracle,
                    "also plan with the structure known: metres to 90, 95, 98 and 99 %; minutes");
  command->callback([options] { ceiling(*options); });
}

}  // namespace gnbv
