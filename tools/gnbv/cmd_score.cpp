#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/text.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/mission/execute.hpp"
#include "tools/mission/rescore.hpp"
#include "tools/run/cloud_file.hpp"
#include "tools/run/run_claim.hpp"
#include "tools/run/summary_json.hpp"
#include "tools/run/words.hpp"
#include "tools/terminal/say.hpp"
#include "tools/terminal/width.hpp"

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
  std::vector<double> box_m;  // x0, y0, z0, x1, y1, z1
  bool json = false;
};

template <typename Value>
std::string percent_row(const std::string& name, std::size_t columns, const Value& value_at) {
  std::string row = fmt::format("{:<26}", name);
  for (std::size_t i = 0; i < columns; ++i) row += fmt::format("{:>9.1f}%", 100.0 * value_at(i));
  return row + "\n";
}

std::string heading(const std::string& name, std::span<const double> columns_m) {
  std::string row = fmt::format("{:<26}", name);
  for (const double column_m : columns_m) row += fmt::format("{:>8} m", size_name(column_m));
  return row + "\n" + std::string(26 + 10 * columns_m.size(), '-') + "\n";
}

/// Of one of the sizes that were asked for.
double share_at(const MissionScore& score, double size_m, const std::array<double, 3>& papers,
                double SizedCoverage::*share) {
  if (const auto size = papers_size(size_m)) return papers[*size];
  const auto at = std::find_if(score.more.begin(), score.more.end(),
                               [&](const SizedCoverage& c) { return c.size_m == size_m; });
  GNBV_CHECK(at != score.more.end(), "no score at {} m", size_m);
  return (*at).*share;
}

std::string terminal_text(const Scored& scored, const std::string& name, bool is_run) {
  const MissionScore& score = scored.score;
  std::string text = fmt::format("{}: {} points against {}, its surface above z = {} m\n", name,
                                 grouped(scored.points), scored.structure, scored.floor_z_m);
  if (scored.points_below_floor > 0) {
    text += fmt::format("{} below z = {} m left out\n", counted(scored.points_below_floor, "point"),
                        scored.floor_z_m);
  }
  text += "\n";
  text += heading("Coverage, voxels of", scored.sizes_m);
  const auto coverage_row = [&](const std::string& row, const std::array<double, 3>& shares,
                                double SizedCoverage::*share) {
    text += percent_row(row, scored.sizes_m.size(), [&](std::size_t i) {
      return share_at(score, scored.sizes_m[i], shares, share);
    });
  };
  coverage_row("seen from outside", score.final, &SizedCoverage::final);
  coverage_row("all surface, also inner", score.final_raw, &SizedCoverage::final_raw);
  if (is_run) coverage_row("profile, from outside", score.profile, &SizedCoverage::profile);
  text += "a voxel counts with such surface of a tenth of its face\n";
  text += "\n" + heading("Within", kScoreDistances_m);
  const auto& at = score.distances.at;
  text += percent_row("precision", at.size(), [&](std::size_t i) { return at[i].precision; });
  text +=
      percent_row("recall, from outside", at.size(), [&](std::size_t i) { return at[i].recall; });
  text += percent_row("F", at.size(), [&](std::size_t i) { return at[i].f; });
  text += fmt::format(
      "\nChamfer distance {:.4f} m: accuracy {:.4f} m, completeness {:.4f} m; beyond {} m counts "
      "as that\n",
      score.distances.chamfer_m, score.distances.accuracy_m, score.distances.completeness_m,
      kFarthest_m);
  text += fmt::format(
      "Points in a voxel of {} m that holds any: {:.1f}, variation {:.2f}; the tables' "
      "Points/voxel is the paper's: points over the map's occupied voxels\n",
      score.density.voxel_m, score.density.mean_points, score.density.variation);
  return folded_text(text, stdout_columns());
}

std::string json_text(const Scored& scored, bool is_run) {
  nlohmann::ordered_json json = {{"schema", "gnbv-score-1"},
                                 {"structure", scored.structure},
                                 {"points", scored.points},
                                 {"points_below_floor", scored.points_below_floor},
                                 {"floor_z_m", scored.floor_z_m}};
  json.update(nlohmann::ordered_json::parse(score_json(scored.score, is_run)));
  json["wall_s"] = {{"reference", scored.reference_s}, {"score", scored.score_s}};
  return json.dump(2) + "\n";
}

/// What a cloud is compared with is not written in it.
Scored score_file(ScoreOptions options, int threads) {
  if (!std::filesystem::exists(options.target)) {
    throw BadInput(fmt::format("{}: no such run directory or cloud", options.target));
  }
  if (options.update) {
    throw BadInput(fmt::format("--update: {} is no run directory", options.target));
  }
  if (options.wish.ceiling == CeilingFrom::search) {
    throw BadInput(fmt::format("--ceiling: {} is no run directory", options.target));
  }
  if (options.scenario.mesh.empty() && options.scenario.scenario.empty()) {
    throw BadInput("score: needs --mesh FILE or --scenario NAME, whose surface is the true one");
  }
  if (options.scenario.scenario.empty()) options.scenario.scenario = "aircraft";
  if (!options.floor_z_m.empty()) {
    options.scenario.overrides.push_back("planner.floor_z_m=" + options.floor_z_m);
  }
  const Scored scored = score_any_cloud(options.target, read_cloud(options.target),
                                        resolve_scenario(options.scenario), options.wish, threads);
  const DistanceScore& widest = scored.score.distances.at.back();
  if (widest.precision < 0.5) {
    say("{}: only {:.1f} % of the points lie within {} m of the mesh: another unit, "
        "frame or mesh?",
        options.target, 100.0 * widest.precision, widest.distance_m);
  }
  return scored;
}

Scored score_folder(const ScoreOptions& options, int threads) {
  const bool says_more = !options.scenario.mesh.empty() || !options.scenario.scenario.empty() ||
                         !options.floor_z_m.empty() || !options.scenario.overrides.empty();
  if (says_more) {
    throw BadInput(
        fmt::format("{}: a run is scored by its own scenario.yaml: --mesh, --scenario, "
                    "--floor-z and --set are for clouds",
                    options.target));
  }
  if (options.wish.box_m && (options.update || options.wish.ceiling == CeilingFrom::search)) {
    throw BadInput("--box: the score of a part is not the run's: without --update and --ceiling");
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
    throw BadInput(
        fmt::format("--box {}: has to be x0,y0,z0,x1,y1,z1 (m), each lower than its upper end",
                    fmt::join(b, ",")));
  }
  wish.box_m = Box3(Vec3(b[0], b[1], b[2]), Vec3(b[3], b[4], b[5]));
  return wish;
}

void score(ScoreOptions options) {
  options.wish = wish_of(options);
  const int threads = thread_count(options.threads);
  const bool is_run = fs::is_directory(options.target);
  const Scored scored = is_run ? score_folder(options, threads) : score_file(options, threads);
  fmt::print("{}", options.json ? json_text(scored, is_run)
                                : terminal_text(scored, options.target, is_run));
}

}  // namespace

void add_score_command(CLI::App& app) {
  auto options = std::make_shared<ScoreOptions>();
  CLI::App* const command =
      app.add_subcommand("score", "measure any cloud, or a run, against the true surface");
  command->add_option("CLOUD|RUN", options->target, ".ply or .xyz cloud (m), or a run directory")
      ->required();
  command->add_option("--mesh", options->scenario.mesh, "mesh file that holds the true surface");
  command->add_option("--scenario", options->scenario.scenario,
                      "its structure instead; built-in name or YAML file");
  command->add_option("--floor-z", options->floor_z_m,
                      "surface below this height (m) is not asked for, and points there are left "
                      "out (default: the scenario's, 0.3)");
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
  command->add_option("--box", options->box_m, "x0,y0,z0,x1,y1,z1 (m): score only what lies inside")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_threads_option(*command, options->threads);
  command->add_flag("--update", options->update,
                    "put the score into the run's summary.json and coverage.csv");
  command->add_flag_callback(
      "--ceiling", [options] { options->wish.ceiling = CeilingFrom::search; },
      "of a run: find the ceiling, where no earlier command did, for the effort to reach it");
  command->add_flag("--json", options->json, "print JSON instead of a table");
  command->callback([options] { score(*options); });
}

}  // namespace gnbv
