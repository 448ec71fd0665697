#include "tools/sweep/bench_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bench/limits/ceiling.hpp"
#include "scenarios/load.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/core/error.hpp"
#include "tools/mission/execute.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/start_pose.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/summary_json.hpp"
#include "tools/sweep/run_cells.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

std::string why_missing(const CellOutcome& outcome) {
  if (outcome.status == CellStatus::failed) return outcome.failure;
  return outcome.status == CellStatus::locked ? "being flown by another process" : "not flown";
}

/// Sentences about cells, each with the seeds that it is true of.
class CellNotes {
 public:
  void add(const Cell& cell, const std::string& sentence) {
    const std::string key = fmt::format("{}, {}: {}", cell.scenario, cell.method, sentence);
    auto at = std::ranges::find(notes_, key, [](const auto& note) { return note.first; });
    if (at == notes_.end()) at = notes_.insert(notes_.end(), {key, {}});
    at->second.push_back(cell.seed);
  }
  std::vector<std::string> lines() const {
    std::vector<std::string> all;
    for (const auto& [key, seeds] : notes_) {
      all.push_back(
          fmt::format("{} (seed{} {})", key, seeds.size() > 1 ? "s" : "", fmt::join(seeds, ", ")));
    }
    return all;
  }

 private:
  std::vector<std::pair<std::string, std::vector<std::uint64_t>>> notes_;
};

/// Whether a seed keys more than the start and the planner's own draws.
bool is_noisy(const Scenario& scenario) {
  const auto is_noisy_camera = [](const auto& camera) {
    return camera.noise.model != DepthNoise::none || camera.drop_probability > 0.0;
  };
  return scenario.vehicle.estimate.model != EstimateModel::none ||
         scenario.wind.gust_w20_m_s > 0.0 ||
         std::ranges::any_of(scenario.cameras, is_noisy_camera) ||
         std::ranges::any_of(scenario.lidars, [](const auto& l) { return l.range_sigma_m > 0.0; });
}

BenchRuns collect(const std::vector<Cell>& cells, const std::vector<CellOutcome>& outcomes) {
  BenchRuns collected;
  CellNotes notes, failures;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& cell = cells[i];
    if (outcomes[i].status != CellStatus::done) {
      failures.add(cell, "without a result: " + why_missing(outcomes[i]));
      continue;
    }
    ComparedRun run{cell.scenario, cell.method, cell.seed, read_run_figures(outcomes[i].run),
                    is_noisy(cell.resolved)};
    // missions that did not end by the planner's own rules are counted as they are, and named
    const std::string& end = run.figures.termination;
    const std::string sentence = fmt::format("ended by {}, counted as it is", end);
    if (end == "collision" || end == "off_course") failures.add(cell, sentence);
    if (end == "battery" || end == "interrupted") notes.add(cell, sentence);
    collected.runs.push_back(std::move(run));
    collected.folders.push_back(outcomes[i].run);
  }
  collected.failures = failures.lines();
  collected.notes = collected.failures;
  for (std::string& note : notes.lines()) collected.notes.push_back(std::move(note));
  return collected;
}

/// Before anything is flown: coverages of unlike voxels cannot be set beside each other.
void need_one_reference(const std::vector<Cell>& cells) {
  std::map<std::string, const Cell*> firsts;
  const auto samples = [](const Cell& cell) {
    return reference_config(cell.resolved).area_samples;
  };
  for (const Cell& cell : cells) {
    const Cell& first = *firsts.try_emplace(cell.scenario, &cell).first->second;
    if (samples(cell) == samples(first)) continue;
    throw BadInput(fmt::format(
        "{}: {} and {} count unlike voxels (score.reference, score.area_samples): their coverages "
        "cannot be compared",
        cell.scenario, first.method, cell.method));
  }
}

}  // namespace

fs::path bench_folder(const BenchOptions& options) {
  return options.out.empty() ? fs::path("runs") / "bench" : options.out;
}

std::vector<std::uint64_t> seeds_from(std::uint64_t first, int count) {
  std::vector<std::uint64_t> seeds;
  for (int i = 0; i < count; ++i) seeds.push_back(first + static_cast<std::uint64_t>(i));
  return seeds;
}

BenchRuns fly_cells(const std::vector<Cell>& cells, const BenchOptions& options) {
  need_one_reference(cells);
  const RunCellsOptions run{.folder = bench_folder(options),
                            .jobs = options.jobs,
                            .threads = options.threads,
                            .retry_failed = true,  // a failure of an earlier call is no result
                            .quiet = options.quiet};
  const std::vector<CellOutcome> outcomes = run_cells(cells, run);
  // a table of some of the missions would be misread as complete
  if (std::ranges::count(outcomes, CellStatus::missing, &CellOutcome::status) > 0) {
    throw CommandFailed("interrupted; the same command goes on");
  }
  return collect(cells, outcomes);
}

BenchRuns read_cells(const std::vector<Cell>& cells, const fs::path& folder) {
  need_one_reference(cells);
  std::vector<CellOutcome> outcomes;
  for (const Cell& cell : cells) outcomes.push_back(look_up(folder, cell));
  return collect(cells, outcomes);
}

Ceiling ceiling_of(const Scenario& scenario, const BenchOptions& options) {
  if (options.ceiling_percent) {
    Ceiling given;
    given.leaf_counted[0] = 0.01 * *options.ceiling_percent;
    given.is_given = true;
    return given;
  }
  if (!options.quiet) say("ceiling of {}", scenario.name);
  std::vector<std::string> warnings;  // the missions' logs hold them
  const World world = load_world(scenario, warnings);
  const RayScene scene(world);
  return find_ceiling(scenario, world, scene, start_pose(scenario, scene),
                      thread_count(options.threads));
}

Ceilings ceilings_of(const BenchRuns& runs, const std::string& baseline,
                     const BenchOptions& options, std::vector<std::string>& notes) {
  // by scenario and method, the first run
  std::map<std::string, std::map<std::string, std::size_t>> firsts;
  for (std::size_t i = 0; i < runs.runs.size(); ++i) {
    firsts[runs.runs[i].scenario].try_emplace(runs.runs[i].method, i);
  }
  Ceilings ceilings;
  std::map<std::string, Ceiling> by_content;
  for (const auto& [scenario, methods] : firsts) {
    try {
      const auto flown_by = [&](std::size_t run) {
        return load_scenario((runs.folders[run] / kScenarioFile).string(), {});
      };
      const auto own = methods.find(baseline);
      const auto& [yardstick, first] = own == methods.end() ? *methods.begin() : *own;
      const std::string content = to_yaml(what_a_ceiling_depends_on(flown_by(first)));
      if (!by_content.contains(content)) {
        by_content.emplace(content, ceiling_of(flown_by(first), options));
      }
      ceilings.emplace(scenario, by_content.at(content));
      std::vector<std::string> others;
      for (const auto& [method, run] : methods) {
        if (to_yaml(what_a_ceiling_depends_on(flown_by(run))) != content) others.push_back(method);
      }
      if (others.empty() || options.ceiling_percent) continue;
      notes.push_back(
          fmt::format("{}: one ceiling for all, that of {}: by their cameras, leaf or room {} "
                      "would have another",
                      scenario, yardstick, fmt::join(others, ", ")));
    } catch (const BadInput& error) {
      notes.push_back(fmt::format("{}: no share of ceiling: {}", scenario, error.what()));
    }
  }
  return ceilings;
}

void add_given_ceiling_note(const BenchOptions& options, std::vector<std::string>& notes) {
  if (!options.ceiling_percent) return;
  notes.push_back(fmt::format("ceiling: {:.4g} % at 0.05 m, as given by --ceiling-at",
                              *options.ceiling_percent));
}

}  // namespace gnbv
