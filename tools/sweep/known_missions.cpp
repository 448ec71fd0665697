// Missions that a file of rows holds need not be flown again.

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include "sim/core/file.hpp"
#include "sim/core/stopwatch.hpp"
#include "tools/sweep/bench_runs.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

using Rows = std::map<std::string, MissionRow>;  // by id

/// Of each scenario and method, in the order of the cells: their ids.
using Kinds = std::map<std::pair<std::string, std::string>, std::vector<std::size_t>>;

/// Whether its shares are of the ceiling in use, as far as that is known without a search.
bool has_ceiling_in_use(const MissionRow& row, const BenchOptions& options) {
  const auto found = row.find("physical_ceiling_0.05");
  if (options.no_ceiling || !options.ceiling_percent) return options.no_ceiling || found;
  return !found && row.find("ceiling_0.05") == 0.01 * *options.ceiling_percent;
}

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
    const bool is_same = std::ranges::any_of(flown.rows, [&, kind = kind](const MissionRow& row) {
      return std::pair(row.scenario, row.method) == kind && row.result_sha256 == hash;
    });
    for (const std::size_t i : members) dropped += is_same ? 0 : known.erase(ids[i]);
  }
  if (!options.quiet) {
    say("{}: {} missions flown again as a sample; {} rows no longer hold",
        options.missions.string(), sample.size(), dropped);
  }
}

/// The rows of a file, if there is one.
std::vector<MissionRow> rows_in(const std::filesystem::path& path) {
  std::error_code none;
  return std::filesystem::exists(path, none) ? read_missions(path) : std::vector<MissionRow>();
}

/// Puts the rows into the file, in place of those of the same missions. Other commands may have
/// written to it since it was read. Without rows it only finds out whether it could.
void write_rows(const std::vector<MissionRow>& rows, const std::filesystem::path& path) {
  const std::filesystem::path lock_file = path.string() + ".lock";
  std::optional<FileLock> lock;
  while (!(lock = FileLock::take(lock_file))) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  std::vector<MissionRow> file = rows.empty() ? std::vector<MissionRow>() : rows_in(path);
  std::set<std::string> names;
  for (const MissionRow& row : rows) names.insert(row_name(row));
  std::erase_if(file, [&](const MissionRow& row) { return names.contains(row_name(row)); });
  file.insert(file.end(), rows.begin(), rows.end());
  if (!file.empty()) write_file_atomically(path, missions_csv(file));
  std::filesystem::remove(lock_file);
}

}  // namespace

BenchRuns rows_of_cells(const std::vector<Cell>& cells, const std::string& baseline,
                        const BenchOptions& options, const std::string& setting) {
  CellNamer namer("", "");  // whatever program flew it
  std::vector<std::string> ids;
  for (const Cell& cell : cells) ids.push_back(namer.id_of(cell.resolved));

  Rows known;
  if (!options.missions.empty()) write_rows({}, options.missions);
  for (const MissionRow& row : rows_in(options.missions)) {
    if (has_ceiling_in_use(row, options)) known.emplace(row.id, row);
  }
  keep_what_holds(cells, ids, options, known);

  BenchRuns all;
  std::vector<std::optional<MissionRow>> rows(cells.size());
  std::vector<std::filesystem::path> folders(cells.size());
  std::vector<Cell> to_fly;
  std::vector<std::size_t> places;  // of these among all
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (const auto row = known.find(ids[i]); row != known.end()) {
      rows[i] = row->second;
      continue;
    }
    to_fly.push_back(cells[i]);
    places.push_back(i);
  }
  // the baseline says the ceiling, whether it is flown or known
  std::set<std::string> scenes;
  for (const Cell& cell : to_fly) scenes.insert(cell.scenario);
  std::vector<Cell> of_scenes = cells;
  std::erase_if(of_scenes, [&](const Cell& cell) { return !scenes.contains(cell.scenario); });
  const auto write = [&] {
    all.rows.clear();
    all.folders.clear();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!rows[i]) continue;  // failed, as the notes say, or not flown yet
      MissionRow& row = all.rows.emplace_back(*rows[i]);
      row.id = ids[i];
      row.scenario = cells[i].scenario;
      row.method = cells[i].method;
      row.setting = setting;
      all.folders.push_back(folders[i]);
    }
    if (!options.missions.empty()) write_rows(all.rows, options.missions);
  };
  Stopwatch since_write;
  double write_s = 0.0;
  const auto take = [&](std::size_t flown, const std::filesystem::path& folder, MissionRow row) {
    row.commit = options.commit;
    rows[places[flown]] = std::move(row);
    folders[places[flown]] = folder;
    // of thousands, which another call has flown, not each is worth a file of all
    if (options.missions.empty() || since_write.elapsed_s() < 10.0 * write_s) return;
    since_write = {};
    write();
    write_s = since_write.elapsed_s();
  };
  const BenchRuns flown =
      fly_cells(to_fly, options, ceilings_of(of_scenes, baseline, options), take);
  all.notes = flown.notes;
  all.failures = flown.failures;
  write();
  add_ceiling_notes(all);
  return all;
}

}  // namespace gnbv
