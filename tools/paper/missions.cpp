#include "tools/paper/missions.hpp"

#include <algorithm>
#include <iterator>

#include "bench/compare/paper_figures.hpp"
#include "tools/sweep/run_cells.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
std::vector<Cell> paper_cells(const PaperRequest& request) {
  std::vector<Cell> cells;
  for (const std::uint64_t seed : request.seeds) {
    for (const std::string& scenario : request.scenarios) {
      Sweep sweep;
      sweep.scenarios = {
          {.name = scenario, .scenario = scenario, .overrides = overrides_of(request.overrides)}};
      for (const PaperRow& row : find_paper_table(scenario)->rows) {
        const std::string utility(row.utility);
        sweep.methods.push_back({utility, {{"planner.utility.name=" + utility}}});
      }
      sweep.seeds = {seed};
      std::ranges::move(cells_of(sweep), std::back_inserter(cells));
    }
  }
  return cells;
}

PaperMaterial fly_paper(const PaperRequest& request, const BenchOptions& options) {
  PaperMaterial material{.request = request};
  const auto read = [&](const BenchRuns& flown, const std::string& how, auto& missions) {
    for (std::size_t i = 0; i < flown.rows.size(); ++i) {
      const MissionRow& row = flown.rows[i];
      missions.push_back({row.scenario, row.method, row.seed, read_run(flown.folders[i])});
    }
    for (const std::string& note : flown.notes) material.notes.push_back(how + note);
    material.has_failures = material.has_failures || !flown.failures.empty();
  };
  std::vector<Cell> cells = paper_cells(request);
  // those that are there come first: what is left then takes what the flown ones took
  std::stable_partition(cells.begin(), cells.end(), [&](const Cell& cell) {
    return look_up(bench_folder(options), cell).status == CellStatus::done;
  });
  read(fly_cells(cells, options), "", material.missions);

  // apart from the others, since those of the same content keep no images
  const RunCellsOptions with_images{.folder = bench_folder(options) / "with-images",
                                    .jobs = options.jobs,
                                    .threads = options.threads,
                                    .retry_failed = true,
                                    .quiet = options.quiet,
                                    .run_arguments = {"--frames"}};
  std::erase_if(cells, [&](const Cell& cell) {
    return !cell.scenario.starts_with("lab_") || cell.seed != request.seeds.front();
  });
  for (const CellOutcome& outcome : run_cells(cells, with_images)) {
    if (outcome.status != CellStatus::missing) continue;
    throw CommandFailed("interrupted; the same command goes on");
  }
  read(read_cells(cells, with_images.folder), "with images: ", material.with_images);
  return material;
}

std::vector<const PaperMission*> missions_of(const PaperMaterial& material,
                                             std::string_view scenario, std::string_view utility) {
  std::vector<const PaperMission*> found;
  for (const PaperMission& mission : material.missions) {
    if (mission.scenario == scenario && mission.utility == utility) found.push_back(&mission);
  }
  std::sort(found.begin(), found.end(),
            [](const auto* a, const auto* b) { return a->seed < b->seed; });
  return found;
}

}  // namespace gnbv
