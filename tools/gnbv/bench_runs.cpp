#include "tools/gnbv/bench_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "sensors/ray_scene.hpp"
#include "sim/core/error.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/run_figures_file.hpp"
#include "tools/mission/start_pose.hpp"
#include "tools/sweep/run_cells.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// Missions that did not end by the planner's own rules are counted as they are, and named.
bool ended_early(const std::string& termination) {
  return termination == "collision" || termination == "battery" || termination == "interrupted";
}

BenchRuns collect(const std::vector<Cell>& cells, const std::vector<CellOutcome>& outcomes) {
  BenchRuns collected;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& cell = cells[i];
    const std::string who =
        fmt::format("{}, {}, seed {}", cell.scenario, cell.method, cell.seed);
    if (outcomes[i].status != CellStatus::done) {
      const std::string why = outcomes[i].status == CellStatus::failed ? outcomes[i].failure
                              : outcomes[i].status == CellStatus::locked
                                  ? "being flown by another process"
                                  : "not flown";
      collected.notes.push_back(fmt::format("{}: without a result: {}", who, why));
      collected.has_failures = true;
      continue;
    }
    ComparedRun run{cell.scenario, cell.method, cell.seed, read_run_figures(outcomes[i].run)};
    if (ended_early(run.figures.termination)) {
      collected.notes.push_back(fmt::format("{}: ended by {} after {} views; counted as it is", who,
                                            run.figures.termination, run.figures.iterations));
    }
    collected.has_failures = collected.has_failures || run.figures.termination == "collision";
    collected.runs.push_back(std::move(run));
  }
  return collected;
}

}  // namespace

void add_bench_options(CLI::App& command, BenchOptions& options) {
  command.add_option("--seeds", options.seed_count, "how many seeds, from --seed on")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command.add_option("--jobs", options.jobs, "missions at a time, each in a process of its own")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command.add_option("--format", options.format, "form of the table on stdout")
      ->check(CLI::IsMember(std::vector<std::string>(kTableFormats.begin(), kTableFormats.end())))
      ->capture_default_str();
}

fs::path bench_folder(const BenchOptions& options) {
  return options.out.empty() ? fs::path("runs") / "bench" : options.out;
}

std::vector<std::uint64_t> seeds_from(std::uint64_t first, int count) {
  std::vector<std::uint64_t> seeds;
  for (int i = 0; i < count; ++i) seeds.push_back(first + static_cast<std::uint64_t>(i));
  return seeds;
}

BenchRuns fly_cells(const std::vector<Cell>& cells, const BenchOptions& options) {
  const RunCellsOptions run{.folder = bench_folder(options),
                            .jobs = options.jobs,
                            .threads = options.threads,
                            .quiet = options.quiet};
  const std::vector<CellOutcome> outcomes = run_cells(cells, run);
  const bool is_whole = std::none_of(outcomes.begin(), outcomes.end(), [](const CellOutcome& o) {
    return o.status == CellStatus::missing;
  });
  // a table of some of the missions would be misread as complete
  if (!is_whole) throw CommandFailed("interrupted; the same command goes on");
  return collect(cells, outcomes);
}

BenchRuns read_cells(const std::vector<Cell>& cells, const fs::path& folder) {
  std::vector<CellOutcome> outcomes;
  for (const Cell& cell : cells) outcomes.push_back(look_up(folder, cell));
  return collect(cells, outcomes);
}

Ceiling ceiling_of(const Scenario& scenario, int threads) {
  std::vector<std::string> warnings;  // the missions' logs hold them
  const World world = load_world(scenario, warnings);
  const RayScene scene(world);
  const unsigned all = std::max(1U, std::thread::hardware_concurrency());
  return find_ceiling(scenario, world, scene, start_pose(scenario, scene),
                      threads > 0 ? threads : static_cast<int>(all));
}

void print_bench(const TextTable& table, const std::string& format, bool has_failures) {
  fmt::print("{}", formatted_text(table, format));
  if (has_failures) throw CommandFailed("not every mission came to its end; the notes say which");
}

}  // namespace gnbv
