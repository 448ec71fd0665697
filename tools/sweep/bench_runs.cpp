#include "tools/sweep/bench_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "bench/compare/paper_figures.hpp"
#include "bench/limits/ceiling.hpp"
#include "scenarios/load.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/core/error.hpp"
#include "tools/mission/execute.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/start_pose.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/run_inputs.hpp"
#include "tools/run/summary_json.hpp"
#include "tools/sweep/missions_csv.hpp"
#include "tools/sweep/run_cells.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

std::string why_missing(const CellOutcome& outcome) {
  if (outcome.status == CellStatus::failed) return outcome.failure;
  return outcome.status == CellStatus::locked ? "being flown by another process" : "not flown";
}

/// Sentences about missions, each with the seeds that it is true of.
class RowNotes {
 public:
  void add(const MissionRow& row, const std::string& sentence) {
    const std::string key = fmt::format("{}, {}: {}", row.scenario, row.method, sentence);
    auto at = std::ranges::find(notes_, key, [](const auto& note) { return note.first; });
    if (at == notes_.end()) at = notes_.insert(notes_.end(), {key, {}});
    at->second.push_back(row.seed);
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
bool seeds_key_noise(const Scenario& scenario) {
  const auto is_noisy_camera = [](const auto& camera) {
    return camera.noise.model != DepthNoise::none || camera.drop_probability > 0.0;
  };
  return scenario.vehicle.estimate.model != EstimateModel::none ||
         scenario.wind.gust_w20_m_s > 0.0 ||
         std::ranges::any_of(scenario.cameras, is_noisy_camera) ||
         std::ranges::any_of(scenario.lidars, [](const auto& l) { return l.range_sigma_m > 0.0; });
}

/// Missions that did not end by the planner's own rules are counted as they are, and named.
void add_endings(BenchRuns& runs) {
  RowNotes notes, failures;
  for (const MissionRow& row : runs.rows) {
    const std::string& end = row.termination;
    const std::string sentence = fmt::format("ended by {}, counted as it is", end);
    if (end == "collision" || end == "off_course") failures.add(row, sentence);
    if (end == "battery" || end == "interrupted") notes.add(row, sentence);
  }
  for (const std::string& line : failures.lines()) {
    runs.failures.push_back(line);
    runs.notes.push_back(line);
  }
  for (std::string& line : notes.lines()) runs.notes.push_back(std::move(line));
}

BenchRuns collect(const std::vector<Cell>& cells, const std::vector<CellOutcome>& outcomes) {
  BenchRuns collected;
  RowNotes missing;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& cell = cells[i];
    MissionRow row{.scenario = cell.scenario, .method = cell.method, .seed = cell.seed};
    if (outcomes[i].status != CellStatus::done) {
      missing.add(row, "without a result: " + why_missing(outcomes[i]));
      continue;
    }
    const fs::path& folder = outcomes[i].run;
    row = mission_row(read_run_figures(folder));
    row.scenario = cell.scenario;
    row.method = cell.method;
    for (const RunInput& input : read_inputs(folder)) {
      if (input.key == "structure") row.structure_sha256 = input.sha256;
    }
    row.program = program_of_rows();
    const Scenario flown = load_flown_scenario((folder / kScenarioFile).string());
    row.figures["seeds_key_noise"] = seeds_key_noise(flown) ? 1.0 : 0.0;
    const PaperTable* const paper = find_paper_table(flown.name);
    const bool is_papers = paper != nullptr && is_papers_structure(*paper, row.structure);
    row.figures["papers_structure"] = is_papers ? 1.0 : 0.0;
    row.figures["papers_setting"] = has_papers_setting(flown) ? 1.0 : 0.0;
    collected.rows.push_back(std::move(row));
    collected.folders.push_back(folder);
  }
  collected.failures = missing.lines();
  collected.notes = collected.failures;
  add_endings(collected);
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
    throw BadInput(
        fmt::format("{}: {} and {} count different voxels (score.reference, score.area_samples): "
                    "their coverages cannot be compared",
                    cell.scenario, first.method, cell.method));
  }
}

}  // namespace

std::string program_of_rows() { return flying_source_id().substr(0, 16); }

std::string row_name(const MissionRow& row) {
  const std::string comma = row.setting.empty() ? "" : ", ";
  return fmt::format("{}, {}{}{}, seed {}", row.scenario, row.method, comma, row.setting, row.seed);
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

BenchRuns read_rows(const std::vector<fs::path>& csvs) {
  BenchRuns runs;
  for (const fs::path& csv : csvs) {
    std::ranges::move(read_missions(csv), std::back_inserter(runs.rows));
  }
  std::set<std::pair<std::string, std::string>> seen;
  for (const MissionRow& row : runs.rows) {
    const std::string name = row_name(row);
    if (!seen.emplace(row.structure, name).second) throw BadInput("two rows of " + name);
  }
  runs.folders.resize(runs.rows.size());
  add_endings(runs);
  return runs;
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

void add_ceilings(const std::string& baseline, const BenchOptions& options, BenchRuns& runs) {
  // by scenario and method, the first run
  std::map<std::string, std::map<std::string, std::size_t>> firsts;
  for (std::size_t i = 0; i < runs.rows.size(); ++i) {
    if (runs.folders[i].empty()) continue;
    firsts[runs.rows[i].scenario].try_emplace(runs.rows[i].method, i);
  }
  std::map<std::string, Ceiling> by_scenario, by_content;
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
      by_scenario.emplace(scenario, by_content.at(content));
      std::vector<std::string> others;
      for (const auto& [method, run] : methods) {
        if (to_yaml(what_a_ceiling_depends_on(flown_by(run))) != content) others.push_back(method);
      }
      if (others.empty() || options.ceiling_percent) continue;
      runs.notes.push_back(
          fmt::format("{}: one ceiling for all, that of {}; {} would have another, because "
                      "cameras, leaf or room differ",
                      scenario, yardstick, fmt::join(others, ", ")));
    } catch (const BadInput& error) {
      runs.notes.push_back(fmt::format("{}: no share of ceiling: {}", scenario, error.what()));
    }
  }
  for (std::size_t i = 0; i < runs.rows.size(); ++i) {
    const auto ceiling = by_scenario.find(runs.rows[i].scenario);
    if (runs.folders[i].empty() || ceiling == by_scenario.end()) continue;
    add_ceiling(read_run_figures(runs.folders[i]), ceiling->second, runs.rows[i]);
  }
}

void add_given_ceiling_note(const BenchOptions& options, std::vector<std::string>& notes) {
  if (!options.ceiling_percent) return;
  notes.push_back(fmt::format("ceiling: {:.4g} % at 0.05 m, as given by --ceiling-at",
                              *options.ceiling_percent));
}

}  // namespace gnbv
