// Cells flown and read back, with the ceilings of their scenarios: what `table`, `compare` and
// `paper` share.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/compare/comparison.hpp"
#include "bench/compare/mission_row.hpp"
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
  bool no_ceiling = false;
  std::filesystem::path missions = {};  // CSV of rows, read and written; "" keeps none
  std::string commit = {};              // of this program, for the rows
};

/// Where cells are kept when --out is not given: cells are named by their content, so that every
/// table and comparison finds what another one flew.
std::filesystem::path bench_folder(const BenchOptions& options);

/// `count` seeds from the first on.
std::vector<std::uint64_t> seeds_from(std::uint64_t first, int count);

/// What rows call this program, and how people call a row.
std::string program_of_rows();
std::string row_name(const MissionRow& row);

struct BenchRuns {
  std::vector<MissionRow> rows;                // of the cells that are done, in their order
  std::vector<std::filesystem::path> folders;  // of these; "" where only the row is known
  std::vector<std::string> notes;     // cells that are missing here, missions that ended early
  std::vector<std::string> failures;  // of the notes: cells without a result, collisions
};

/// The ceiling of a scenario, with its structure loaded for the purpose, or the one that is given.
Ceiling ceiling_of(const Scenario& scenario, const BenchOptions& options);

struct Ceilings {
  std::map<std::string, Ceiling> by_scenario;
  std::vector<std::string> notes;  // methods that would have another, scenarios without one
};

/// Of each scenario one ceiling, as the baseline's first cell has it (without one, that of the
/// first method by name). None with options.no_ceiling, nor where the structure cannot be read.
Ceilings ceilings_of(const std::vector<Cell>& cells, const std::string& baseline,
                     const BenchOptions& options);

/// Is given the row of a cell and its run directory, as soon as it is done.
using TakeRow = std::function<void(std::size_t cell, const std::filesystem::path& run, MissionRow)>;

/// Flies what is missing and reads all. Throws CommandFailed when it is interrupted, BadInput
/// before that for cells of a scenario whose coverages are of unlike voxels or budgets.
BenchRuns fly_cells(const std::vector<Cell>& cells, const BenchOptions& options,
                    const Ceilings& ceilings = {}, const TakeRow& take = {});

/// What is known of the cells in a folder, without flying anything. Throws BadInput as fly_cells().
BenchRuns read_cells(const std::vector<Cell>& cells, const std::filesystem::path& folder,
                     const Ceilings& ceilings = {});

/// The rows of missions that an earlier program flew, from files. Throws BadInput as
/// read_missions(), for two rows of one mission in different files, and for rows of a scenario
/// whose coverages are of unlike voxels or budgets.
BenchRuns read_rows(const std::vector<std::filesystem::path>& csvs);

/// The rows of the cells with their ceilings, from options.missions as far as it has them, else
/// flown; the file takes them as they come. Rows with another ceiling than the one in use are not
/// there: their runs are read again. Rows of another program hold as long as this one flies
/// a sample of them to the same result: of each scenario and method the first cell.
BenchRuns rows_of_cells(const std::vector<Cell>& cells, const std::string& baseline,
                        const BenchOptions& options, const std::string& setting = "");

/// Names the scenarios whose rows have not one ceiling, with who has which.
void add_ceiling_notes(BenchRuns& runs);

/// What shares of the ceiling are of, when it is given.
void add_given_ceiling_note(const BenchOptions& options, std::vector<std::string>& notes);

/// What a command makes of missions.
struct BenchTables {
  std::vector<TextTable> tables;
  std::vector<std::string> failures;
};

// ---- missions_csv.cpp: missions as rows of a CSV file: raw data that tables are printed from, and
// that says what need not be flown again

/// RFC 4180: the words of a row, then a column a figure, by name. Numbers read back exactly; "inf"
/// for what was not reached, nothing for what is not known. A mesh is named without its folders.
std::string missions_csv(std::span<const MissionRow> missions);

/// Throws BadInput naming file, line and column of what is missing or no number, and of the second
/// of two rows of one scenario, method, setting and seed.
std::vector<MissionRow> read_missions(const std::filesystem::path& csv);

}  // namespace gnbv
