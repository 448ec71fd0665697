#include "tools/sweep/bench_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <tuple>
#include <utility>

#include "bench/compare/paper_figures.hpp"
#include "scenarios/load.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/core/error.hpp"
#include "tools/mission/execute.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/start_pose.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/run_inputs.hpp"
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

/// Of a cell that is done, with the ceiling of its scenario, where there is one.
MissionRow row_of(const Cell& cell, const fs::path& folder, const Ceilings& ceilings) {
  const RunFigures figures = read_run_figures(folder);
  MissionRow row = mission_row(figures);
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
  const auto ceiling = ceilings.by_scenario.find(cell.scenario);
  if (ceiling != ceilings.by_scenario.end()) add_ceiling(figures, ceiling->second, row);
  return row;
}

/// `rows`: of the cells that are done.
BenchRuns collect(const std::vector<Cell>& cells, const std::vector<CellOutcome>& outcomes,
                  std::vector<MissionRow> rows, const Ceilings& ceilings) {
  BenchRuns collected;
  RowNotes missing;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (outcomes[i].status == CellStatus::done) {
      collected.rows.push_back(std::move(rows[i]));
      collected.folders.push_back(outcomes[i].run);
      continue;
    }
    missing.add({.scenario = cells[i].scenario, .method = cells[i].method, .seed = cells[i].seed},
                "without a result: " + why_missing(outcomes[i]));
  }
  collected.failures = missing.lines();
  collected.notes = collected.failures;
  add_endings(collected);
  collected.notes.insert(collected.notes.end(), ceilings.notes.begin(), ceilings.notes.end());
  return collected;
}

constexpr const char* kOtherVoxels =
    "count different voxels (score.reference, score.area_samples, score.region_m, "
    "planner.floor_z_m)";
constexpr const char* kOtherBudgets =
    "have different budgets (score.budget_views, score.budget_m, score.budget_s)";

[[noreturn]] void refuse(const std::string& scenario, const std::string& one,
                         const std::string& other, const char* what) {
  throw BadInput("{}: {} and {} {}: they cannot be compared", scenario, one, other, what);
}

/// Before anything is flown: what is measured by unlike voxels or budgets cannot be set beside each
/// other.
void need_one_measure(const std::vector<Cell>& cells) {
  std::map<std::string, const Cell*> firsts;
  const auto counted = [](const Cell& cell) {
    const ReferenceConfig config = reference_config(cell.resolved);
    const Box3& region = config.region_m;
    return std::tuple(config.area_samples, config.floor_z_m, region.min(), region.max());
  };
  const auto budgets = [](const Cell& cell) {
    const ScoreConfig& score = cell.resolved.score;
    return std::tuple(score.budget_views, score.budget_m, score.budget_s);
  };
  for (const Cell& cell : cells) {
    const Cell& first = *firsts.try_emplace(cell.scenario, &cell).first->second;
    if (counted(cell) != counted(first)) {
      refuse(cell.scenario, first.method, cell.method, kOtherVoxels);
    }
    if (budgets(cell) != budgets(first)) {
      refuse(cell.scenario, first.method, cell.method, kOtherBudgets);
    }
  }
}

/// The same of rows, as far as they know it.
void need_one_measure(const std::vector<MissionRow>& rows) {
  constexpr std::array kMeasures = {
      std::pair("area_samples", kOtherVoxels), std::pair("budget_views", kOtherBudgets),
      std::pair("budget_metres", kOtherBudgets), std::pair("budget_seconds", kOtherBudgets)};
  for (const auto& [figure, what] : kMeasures) {
    std::map<std::pair<std::string, std::string>, const MissionRow*> firsts;
    for (const MissionRow& row : rows) {
      if (!row.find(figure)) continue;
      const std::pair scene(row.scenario, row.structure_id());
      const MissionRow& first = *firsts.try_emplace(scene, &row).first->second;
      if (row.find(figure) != first.find(figure)) {
        refuse(row.scenario, row_name(first), row_name(row), what);
      }
    }
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

BenchRuns fly_cells(const std::vector<Cell>& cells, const BenchOptions& options,
                    const Ceilings& ceilings, const TakeRow& take) {
  need_one_measure(cells);
  std::vector<MissionRow> rows(cells.size());
  const auto on_done = [&](std::size_t i, const CellOutcome& outcome) {
    rows[i] = row_of(cells[i], outcome.run, ceilings);
    if (take) take(i, outcome.run, rows[i]);
  };
  const RunCellsOptions run{.folder = bench_folder(options),
                            .jobs = options.jobs,
                            .threads = options.threads,
                            .retry_failed = true,  // a failure of an earlier call is no result
                            .quiet = options.quiet,
                            .on_done = on_done};
  const std::vector<CellOutcome> outcomes = run_cells(cells, run);
  // a table of some of the missions would be misread as complete
  if (std::ranges::count(outcomes, CellStatus::missing, &CellOutcome::status) > 0) {
    throw CommandFailed("interrupted; the same command goes on");
  }
  return collect(cells, outcomes, std::move(rows), ceilings);
}

BenchRuns read_cells(const std::vector<Cell>& cells, const fs::path& folder,
                     const Ceilings& ceilings) {
  need_one_measure(cells);
  std::vector<CellOutcome> outcomes;
  std::vector<MissionRow> rows(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    outcomes.push_back(look_up(folder, cells[i]));
    if (outcomes[i].status != CellStatus::done) continue;
    rows[i] = row_of(cells[i], outcomes[i].run, ceilings);
  }
  return collect(cells, outcomes, std::move(rows), ceilings);
}

BenchRuns read_rows(const std::vector<fs::path>& csvs) {
  BenchRuns runs;
  for (const fs::path& csv : csvs) {
    std::ranges::move(read_missions(csv), std::back_inserter(runs.rows));
  }
  std::set<std::pair<std::string, std::string>> seen;
  for (const MissionRow& row : runs.rows) {
    const std::string name = row_name(row);
    if (!seen.emplace(row.structure_id(), name).second) throw BadInput("two rows of " + name);
  }
  need_one_measure(runs.rows);
  runs.folders.resize(runs.rows.size());
  add_endings(runs);
  add_ceiling_notes(runs);
  return runs;
}

void add_ceiling_notes(BenchRuns& runs) {
  std::map<std::pair<std::string, std::string>,
           std::map<std::optional<double>, std::set<std::string>>>
      methods;  // by scenario with structure, and ceiling
  for (const MissionRow& row : runs.rows) {
    methods[{row.scenario, row.structure_id()}][row.find("ceiling_0.05")].insert(row.method);
  }
  for (const auto& [scene, by_ceiling] : methods) {
    if (by_ceiling.size() < 2) continue;
    std::vector<std::string> words;
    for (const auto& [ceiling, names] : by_ceiling) {
      const std::string percent = ceiling ? fmt::format("{:.4g} %", 100.0 * *ceiling) : "none";
      words.push_back(fmt::format("{} ({})", percent, fmt::join(names, ", ")));
    }
    runs.notes.push_back(fmt::format(
        "{}: not one ceiling: {}; shares of it and efforts to reach them are not comparable",
        scene.first, fmt::join(words, ", ")));
  }
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

Ceilings ceilings_of(const std::vector<Cell>& cells, const std::string& baseline,
                     const BenchOptions& options) {
  Ceilings found;
  if (options.no_ceiling) return found;
  std::map<std::string, std::map<std::string, const Cell*>> firsts;  // by scenario and method
  for (const Cell& cell : cells) firsts[cell.scenario].try_emplace(cell.method, &cell);
  std::map<std::string, Ceiling> by_content;
  for (const auto& [scenario, methods] : firsts) {
    try {
      const auto own = methods.find(baseline);
      const auto& [yardstick, first] = own == methods.end() ? *methods.begin() : *own;
      const std::string content = to_yaml(what_a_ceiling_depends_on(first->resolved));
      if (!by_content.contains(content)) {
        by_content.emplace(content, ceiling_of(first->resolved, options));
      }
      found.by_scenario.emplace(scenario, by_content.at(content));
      std::vector<std::string> others;
      for (const auto& [method, cell] : methods) {
        if (to_yaml(what_a_ceiling_depends_on(cell->resolved)) != content) others.push_back(method);
      }
      if (others.empty() || options.ceiling_percent) continue;
      found.notes.push_back(
          fmt::format("{}: one ceiling for all, that of {}; {} would have another, because "
                      "cameras, leaf or room differ",
                      scenario, yardstick, fmt::join(others, ", ")));
    } catch (const BadInput& error) {
      found.notes.push_back(fmt::format("{}: no share of ceiling: {}", scenario, error.what()));
    }
  }
  return found;
}

void add_given_ceiling_note(const BenchOptions& options, std::vector<std::string>& notes) {
  if (!options.ceiling_percent) return;
  notes.push_back(fmt::format("ceiling: {:.4g} % at 0.05 m, as given by --ceiling-at",
                              *options.ceiling_percent));
}

}  // namespace gnbv
