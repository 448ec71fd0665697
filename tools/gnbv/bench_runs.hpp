// Cells flown and read back: what `table` and `compare` share.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/compare/comparison.hpp"
#include "bench/compare/text_table.hpp"
#include "bench/limits/ceiling.hpp"
#include "tools/sweep/sweep.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace gnbv {

/// What the command line says about many missions.
struct BenchOptions {
  std::filesystem::path out = {};  // "" is runs/bench
  int threads = 0;                 // 0 = as many as the machine has
  bool quiet = false;
  int seed_count = 1;
  int jobs = 1;
  std::string format = "terminal";
  std::optional<double> ceiling_percent = {};  // at 0.05 m, instead of what a search finds
};

/// What many missions share beside their scenario: --seeds, --jobs, --threads, --format, --out,
/// --quiet, --ceiling-at.
void add_bench_options(CLI::App& command, BenchOptions& options);

/// Where cells are kept when --out is not given: cells are named by their content, so that every
/// table and comparison finds what another one flew.
std::filesystem::path bench_folder(const BenchOptions& options);

/// `count` seeds from the first on.
std::vector<std::uint64_t> seeds_from(std::uint64_t first, int count);

struct BenchRuns {
  std::vector<ComparedRun> runs;               // of the cells that are done, in their order
  std::vector<std::filesystem::path> folders;  // of these runs
  std::vector<std::string> notes;  // cells that are missing here, and missions that ended early
  bool has_failures = false;       // cells without a result, collisions
};

/// Flies what is missing and reads all. Throws CommandFailed when it is interrupted.
BenchRuns fly_cells(const std::vector<Cell>& cells, const BenchOptions& options);

/// What is known of the cells in a folder, without flying anything.
BenchRuns read_cells(const std::vector<Cell>& cells, const std::filesystem::path& folder);

/// The ceiling of a scenario, with its structure loaded for the purpose, or the one that is given.
Ceiling ceiling_of(const Scenario& scenario, const BenchOptions& options);

/// The ceilings of every scenario and method, each as its first run resolved it. One that cannot be
/// found, its mesh being gone, is left out, and the notes say why.
Ceilings ceilings_of(const BenchRuns& runs, const BenchOptions& options,
                     std::vector<std::string>& notes);

/// What shares of the ceiling are of, when it is given.
void add_given_ceiling_note(const BenchOptions& options, std::vector<std::string>& notes);

/// Prints the tables, an empty line between them, then throws CommandFailed if something failed.
void print_bench(const std::vector<TextTable>& tables, const std::string& format,
                 bool has_failures);

}  // namespace gnbv
