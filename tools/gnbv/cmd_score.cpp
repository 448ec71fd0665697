#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>

#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/mission/execute.hpp"
#include "tools/mission/rescore.hpp"
#include "tools/run/cloud_file.hpp"
#include "tools/run/run_claim.hpp"
#include "tools/run/summary_json.hpp"
#include "tools/terminal/say.hpp"
#include "tools/terminal/streams.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct ScoreOptions {
  ScenarioOptions scenario;
  std::string target;
  std::string floor_z_m;
  int threads = 0;
  bool update = false;
  ScoreWish wish;
  std::vector<double> offset_m;  // x, y, z; empty: none
  std::vector<double> box_m;     // x0, y0, z0, x1, y1, z1
  bool json = false;
};

/// What a cloud is compared with is not written in it.
Scored score_file(ScoreOptions options, int threads) {
  if (!std::filesystem::exists(options.target)) {
    throw BadInput("{}: no such run directory or cloud", options.target);
  }
  if (options.update) throw BadInput("--update: {} is no run directory", options.target);
  if (options.wish.ceiling == CeilingFrom::search) {
    throw BadInput("--ceiling: {} is no run directory", options.target);
  }
  if (options.scenario.mesh.empty() && options.scenario.scenario.empty()) {
    throw BadInput("score: needs --mesh FILE or --scenario NAME, whose surface is the true one");
  }
  if (options.scenario.scenario.empty()) options.scenario.scenario = "aircraft";
  if (!options.floor_z_m.empty()) {
    options.scenario.overrides.push_back("planner.floor_z_m=" + options.floor_z_m);
  }
  const std::vector<double>& d = options.offset_m;
  const Vec3 offset_m = d.empty() ? Vec3::Zero() : Vec3(d[0], d[1], d[2]);
  std::vector<std::string> warnings;
  const std::vector<Vec3f> points = read_cloud(options.target, offset_m, &warnings);
  const Scored scored = score_any_cloud(options.target, points, resolve_scenario(options.scenario),
                                        options.wish, threads, warnings);
  for (const std::string& warning : warnings) say(warning);
  const DistanceScore& widest = scored.score.distances.at.back();
  if (widest.precision < 0.5) {
    say("{}: only {:.1f} % of the points lie within {} m of the mesh: another unit, frame or mesh?",
        options.target, 100.0 * widest.precision, widest.distance_m);
  }
  return scored;
}

Scored score_folder(const ScoreOptions& options, int threads) {
  const bool says_more = !options.scenario.mesh.empty() || !options.scenario.scenario.empty() ||
                         !options.floor_z_m.empty() || !options.scenario.overrides.empty() ||
                         !options.offset_m.empty();
  if (says_more) {
    throw BadInput(
        "{}: a run is scored by its own scenario.yaml: --mesh, --scenario, --floor-z, --offset-m "
        "and --set are for clouds",
        options.target);
  }
  if (options.wish.box_m && (options.update || options.wish.ceiling == CeilingFrom::search)) {
    throw BadInput("--box: scores a part, not the run; leave out --update and --ceiling");
  }
  std::optional<RunClaim> claim;  // nobody resumes it meanwhile
  if (options.update) claim.emplace(options.target);
  Scored scored = score_run(options.target, options.wish, threads);
  if (options.update) rescore_summary(options.target, scored.score);
  return scored;
}

/// Throws BadInput for what is no box, or no list of sizes that a scenario would take.
ScoreWish wish_of(const ScoreOptions& options) {
  ScoreWish wish = options.wish;
  if (!wish.sizes_m.empty()) {
    const std::string sizes = fmt::format("{}", fmt::join(wish.sizes_m, ","));
    wish.sizes_m = load_with_overrides("smoke", {{.text = fmt::format("score.sizes_m=[{}]", sizes),
                                                  .source = "--resolution " + sizes}})
                       .score.sizes_m;
  }
  if (options.box_m.empty()) return wish;
  const std::vector<double>& b = options.box_m;
  const bool is_box = b.size() == 6 && b[0] < b[3] && b[1] < b[4] && b[2] < b[5];
  if (!is_box) {
    throw BadInput("--box {}: has to be x0,y0,z0,x1,y1,z1 (m), each lower than its upper end",
                   fmt::join(b, ","));
  }
  wish.box_m = Box3(Vec3(b[0], b[1], b[2]), Vec3(b[3], b[4], b[5]));
  return wish;
}

void score(ScoreOptions options) {
  options.wish = wish_of(options);
  const int threads = thread_count(options.threads);
  const bool is_run = fs::is_directory(options.target);
  const Scored scored = is_run ? score_folder(options, threads) : score_file(options, threads);
  fmt::print("{}", options.json ? score_json(scored, is_run)
                                : score_text(scored, options.target, is_run, stdout_columns()));
}

}  // namespace

void add_score_command(CLI::App& app) {
  auto options = std::make_shared<ScoreOptions>();
  CLI::App* const command =
      app.add_subcommand("score", "measure any cloud, or a run, against the true surface");
  command
      ->add_option("CLOUD|RUN", options->target,
                   ".ply, .pcd, .las, .xyz, .pts, .txt, .asc or .csv cloud (m), or a run directory")
      ->required();
  command->add_option("--mesh", options->scenario.mesh, "mesh file that holds the true surface");
  command->add_option("--scenario", options->scenario.scenario,
                      "scenario whose structure is the true surface; built-in name or YAML file");
  command->add_option(
      "--floor-z", options->floor_z_m,
      "surface and points below this height (m) do not count (default: the scenario's, 0.3)");
  command
      ->add_option("--set", options->scenario.overrides,
                   "KEY=VALUE of the scenario file; repeatable (structure.file.scale, .unit_m, "
                   ".up_axis, .offset_m; planner.map.resolution_m for the density)")
      ->allow_extra_args(false);
  command
      ->add_option("--resolution", options->wish.sizes_m,
                   "edges of the voxels of the coverage (m), with commas (default: score.sizes_m)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--offset-m", options->offset_m,
                   "x,y,z (m), added to all points of a cloud before anything is rounded. For map "
                   "grids such as UTM, together with structure.file.offset_m of the mesh")
      ->delimiter(',')
      ->expected(3);
  command->add_option("--box", options->box_m, "x0,y0,z0,x1,y1,z1 (m): score only what lies inside")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_threads_option(*command, options->threads);
  add_quiet_option(*command, options->wish.is_quiet);
  command->add_flag("--update", options->update,
                    "put the score into the run's summary.json and coverage.csv");
  command->add_flag_callback(
      "--ceiling", [options] { options->wish.ceiling = CeilingFrom::search; },
      "of a run: find the ceiling if no earlier command did, so that the score has the effort to "
      "reach it");
  command->add_flag("--json", options->json, "print JSON instead of a table");
  command->callback([options] { score(*options); });
}

}  // namespace gnbv
