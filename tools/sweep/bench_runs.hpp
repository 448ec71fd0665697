// Cells flown and read back, with the ceilings of their scenarios: what `table`, `compare` and
// `paper` share.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/compare/comparison.hpp"
#include "bench/compare/text_table.hpp"
#include "bench/limits/ceiling.hpp"
#include "tools/sweep/sweep.hpp"

namespace gnbv {

/// How many missions are flown, and where.
struct BenchOptions {
  std::filesystem::path out = {};  // "" is runs/bench
  int threads = 0;                 // 0 = as many as the machine has
  bool quiet = false;
  int seed_count = 1;
  int jobs = 1;
  std::string format = "terminal";
  std::optional<double> ceiling_percent = {};  // at 0.05 m, instead of what a search finds
};

/// Where cells are kept when --out is not given: cells are named by their content, so that every
/// table and comparison finds what another one flew.
std::filesystem::path bench_folder(const BenchOptions& options);

/// `count` seeds from the first on.
std::vector<std::uint64_t> seeds_from(std::uint64_t first, int count);

struct BenchRuns {
  std::vector<ComparedRun> runs;               // of the cells that are done, in their order
  std::vector<std::filesystem::path> folders;  // of these runs
  std::vector<std::string> notes;     // cells that are missing here, missions that ended early
  std::vector<std::string> failures;  // of the notes: cells without a result, collisions
};

/// Flies what is missing and reads all. Throws CommandFailed when it is interrupted, BadInput
/// before that for cells of a scenario whose coverages are of unlike voxels.
BenchRuns fly_cells(const std::vector<Cell>& cells, const BenchOptions& options);

/// What is known of the cells in a folder, without flying anything. Throws BadInput as fly_cells().
BenchRuns read_cells(const std::vector<Cell>& cells, const std::filesystem::path& folder);

/// The ceiling of a scenario, with its structure loaded for the purpose, or the one that is given.
Ceiling ceiling_of(const Scenario& scenario, const BenchOptions& options);

/// The ceiling of every scenario, as the baseline's first run resolved it (without one, that of the
/// first method by name); the notes name the methods that would have another. One that cannot be
/// found, its mesh being gone, is left out, and the notes say why.
Ceilings ceilings_of(const BenchRuns& runs, const std::string& baseline,
                     const BenchOptions& options, std::vector<std::string>& notes);

/// What shares of the ceiling are of, when it is given.
void add_given_ceiling_note(const BenchOptions& options, std::vector<std::string>& notes);

/// What a command makes of missions.
struct BenchTables {
  std::vector<TextTable> tables;
  std::vector<std::string> failures;
};

}  // namespace gnbv
