// Missions that a file of rows holds need not be flown again.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "sim/core/file.hpp"
#include "tools/sweep/bench_runs.hpp"
#include "tools/sweep/missions_csv.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

using Rows = std::map<std::string, MissionRow>;  // by id

/// Of each scenario and method, in the order of the cells: their ids.
using Kinds = std::map<std::pair<std::string, std::string>, std::vector<std::size_t>>;

/// Leaves the rows of this program, and those of a kind whose first one it flies to the same
/// result.
void keep_what_holds(const std::vector<Cell>& cells, const std::vector<std::string>& ids,
                     const BenchOptions& options, Rows& known) {
  Kinds kinds;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto row = known.find(ids[i]);
    if (row == known.end() || row->second.program == program_of_rows()) continue;
    kinds[{cells[i].scenario, cells[i].method}].push_back(i);
  }
  std::vector<Cell> sample;
  for (const auto& [kind, members] : kinds) sample.push_back(cells[members.front()]);
  if (sample.empty()) return;
  const BenchRuns flown = fly_cells(sample, options);
  std::size_t dropped = 0;
  for (const auto& [kind, members] : kinds) {
    const std::string& hash = known.at(ids[members.front()]).result_sha256;
    const bool is_same = std::ranges::any_of(flown.rows, [&](const MissionRow& row) {
      return std::pair(row.scenario, row.method) == kind && row.result_sha256 == hash;
    });
    for (const std::size_t i : members) dropped += is_same ? 0 : known.erase(ids[i]);
  }
  if (!options.quiet) {
    say("{}: {} missions flown again as a sample; {} rows no longer hold",
        options.missions.string(), sample.size(), dropped);
  }
}

}  // namespace

BenchRuns rows_of_cells(const std::vector<Cell>& cells, const std::string& baseline,
                        const BenchOptions& options, const std::string& setting) {
  CellNamer namer("", "");  // whatever program flew it
  std::vector<std::string> ids;
  for (const Cell& cell : cells) ids.push_back(namer.id_of(cell.resolved));

  std::vector<MissionRow> file;
  std::error_code none;
  if (std::filesystem::exists(options.missions, none)) file = read_missions(options.missions);
  Rows known;
  for (const MissionRow& row : file) known.emplace(row.id, row);
  keep_what_holds(cells, ids, options, known);

  std::vector<Cell> to_fly;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!known.contains(ids[i])) to_fly.push_back(cells[i]);
  }
  BenchRuns flown = fly_cells(to_fly, options);
  if (!options.no_ceiling) add_ceilings(baseline, options, flown);

  BenchRuns all;
  all.notes = flown.notes;
  all.failures = flown.failures;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& cell = cells[i];
    const auto own = std::ranges::find_if(flown.rows, [&](const MissionRow& row) {
      return row.scenario == cell.scenario && row.method == cell.method && row.seed == cell.seed;
    });
    const auto row = known.find(ids[i]);
    if (own == flown.rows.end() && row == known.end()) continue;  // failed; the notes say so
    const bool is_new = own != flown.rows.end();
    all.rows.push_back(is_new ? *own : row->second);
    all.rows.back().id = ids[i];
    all.rows.back().scenario = cell.scenario;
    all.rows.back().method = cell.method;
    all.rows.back().setting = setting;
    if (is_new) all.rows.back().commit = options.commit;
    all.folders.push_back(is_new ? flown.folders[static_cast<std::size_t>(own - flown.rows.begin())]
                                 : std::filesystem::path());
  }
  if (options.missions.empty()) return all;
  std::erase_if(file, [&](const MissionRow& row) {
    return std::ranges::any_of(
        all.rows, [&](const MissionRow& now) { return row_name(now) == row_name(row); });
  });
  file.insert(file.end(), all.rows.begin(), all.rows.end());
  write_file_atomically(options.missions, missions_csv(file));
  return all;
}

}  // namespace gnbv
