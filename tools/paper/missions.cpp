#include "tools/paper/missions.hpp"

#include <algorithm>

#include "bench/compare/paper_figures.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

Sweep sweep_of(const PaperTable& table, const PaperRequest& request) {
  Sweep sweep;
  const std::string name(table.scenario);
  sweep.scenarios = {
      {.name = name, .scenario = name, .overrides = overrides_of(request.overrides)}};
  for (const PaperRow& row : table.rows) {
    const std::string utility(row.utility);
    sweep.methods.push_back({utility, {{"planner.utility.name=" + utility}}});
  }
  sweep.seeds = request.seeds;
  return sweep;
}

}  // namespace

std::vector<Cell> paper_cells(const PaperRequest& request) {
  std::vector<Cell> cells;
  for (const std::string& scenario : request.scenarios) {
    const PaperTable* const table = find_paper_table(scenario);
    GNBV_CHECK(table != nullptr, "no table of {}", scenario);
    for (Cell& cell : cells_of(sweep_of(*table, request))) cells.push_back(std::move(cell));
  }
  const auto place = [&](const Cell& cell) {
    return std::find(request.seeds.begin(), request.seeds.end(), cell.seed);
  };
  std::stable_sort(cells.begin(), cells.end(),
                   [&](const Cell& a, const Cell& b) { return place(a) < place(b); });
  return cells;
}

std::vector<Cell> pictured_cells(const PaperRequest& request) {
  std::vector<Cell> cells = paper_cells(request);
  std::erase_if(cells, [&](const Cell& cell) {
    return !cell.scenario.starts_with("lab_") || cell.seed != request.seeds.front();
  });
  return cells;
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
