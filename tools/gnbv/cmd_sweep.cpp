#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <memory>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/sweep/manifest.hpp"
#include "tools/sweep/slurm.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct SweepOptions {
  fs::path file;
  RunCellsOptions run;
  std::string index;
  bool list = false;
  bool status = false;
  bool replace = false;
  bool json = false;
  bool slurm = false;
  bool slurm_dry_run = false;
  SlurmOptions array;
};

std::string name_of(const Cell& cell) {
  return fmt::format("{} {} seed {}", cell.scenario, cell.method, cell.seed);
}

void list(const std::vector<Cell>& cells, bool json) {
  if (json) return fmt::print("{}", cells_json(cells, {}));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    fmt::print("{:6}  {}  {}\n", i, cells[i].id, name_of(cells[i]));
  }
}

/// "K" or "K-L"; throws BadInput for anything else, and for cells that the sweep does not have.
std::pair<std::size_t, std::size_t> parse_index(const std::string& text, std::size_t cells) {
  std::size_t first = 0;
  const char* const end = text.data() + text.size();
  auto read = std::from_chars(text.data(), end, first);
  std::size_t last = first;
  if (read.ec == std::errc{} && read.ptr != end && *read.ptr == '-') {
    read = std::from_chars(read.ptr + 1, end, last);
  }
  if (read.ec != std::errc{} || read.ptr != end || last < first) {
    throw BadInput("--index {}: has to read K or K-L", text);
  }
  if (last >= cells) throw BadInput("--index {}: the sweep has the cells 0 to {}", text, cells - 1);
  return {first, last};
}

std::size_t count_of(const std::vector<CellOutcome>& outcomes, CellStatus status) {
  return static_cast<std::size_t>(std::ranges::count(outcomes, status, &CellOutcome::status));
}

/// A row for each scenario and method, in the order of the sweep, and one for all.
void print_table(const std::vector<Cell>& cells, const std::vector<CellOutcome>& outcomes) {
  using Counts = std::array<int, kCellStatusNames.size()>;
  std::vector<std::pair<std::string, Counts>> rows;
  Counts all{};
  std::size_t width = 5;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string name = cells[i].scenario + "  " + cells[i].method;
    if (rows.empty() || rows.back().first != name) rows.push_back({name, {}});
    const auto status = static_cast<std::size_t>(outcomes[i].status);
    ++rows.back().second.at(status);
    ++all.at(status);
    width = std::max(width, name.size());
  }
  rows.push_back({"all", all});
  fmt::print("{:<{}}  {:>6} {:>6} {:>7} {:>7}\n", "", width, "done", "failed", "running",
             "missing");
  for (const auto& [name, count] : rows) {
    fmt::print("{:<{}}  {:>6} {:>6} {:>7} {:>7}\n", name, width, count[0], count[1], count[2],
               count[3]);
  }
  constexpr std::size_t kNamed = 20;
  std::size_t named = 0;
  for (std::size_t i = 0; i < cells.size() && named < kNamed; ++i) {
    if (outcomes[i].status != CellStatus::failed) continue;
    fmt::print("failed: {} {} {}: {}\n", i, cells[i].id, name_of(cells[i]), outcomes[i].failure);
    ++named;
  }
  const std::size_t more = count_of(outcomes, CellStatus::failed) - named;
  if (more > 0) fmt::print("failed: and {} more, cells/*.failed.json\n", more);
}

void report(const SweepOptions& options, const std::vector<Cell>& cells,
            const std::vector<CellOutcome>& outcomes) {
  const fs::path results = options.run.folder / "results.csv";
  std::string written = results.string() + "\n";
  try {
    write_file_atomically(results, results_csv(cells, outcomes));
  } catch (const BadInput& cannot) {  // one may look at a folder of others
    if (!options.status) throw;
    say(cannot.what());
    written.clear();
  }
  if (options.json) return fmt::print("{}", cells_json(cells, outcomes));
  print_table(cells, outcomes);
  fmt::print("{}", written);
}

void show_status(const SweepOptions& options, const std::vector<Cell>& cells) {
  if (!fs::is_directory(options.run.folder)) {
    throw BadInput("{}: no such folder: nothing was flown there", options.run.folder.string());
  }
  std::vector<CellOutcome> outcomes;
  for (const Cell& cell : cells) outcomes.push_back(look_up(options.run.folder, cell));
  report(options, cells, outcomes);
}

void fail_if_any_failed(const std::vector<CellOutcome>& outcomes) {
  const std::size_t failed = count_of(outcomes, CellStatus::failed);
  const std::size_t missing = count_of(outcomes, CellStatus::missing);
  if (missing > 0) {
    throw CommandFailed("interrupted: {} cells are missing; the same command goes on", missing);
  }
  if (failed > 0) {
    const auto first = std::ranges::find(outcomes, CellStatus::failed, &CellOutcome::status);
    throw CommandFailed("{} cells failed; --retry-failed runs them again; the first: {}", failed,
                        first->failure);
  }
}

/// Some cells for a scheduler's task, which resolves no others: their place is checked against the
/// manifest, since a file that was changed since would mean other cells.
void run_indexed(const SweepOptions& options, const Sweep& sweep) {
  const auto [first, last] = parse_index(options.index, cell_count(sweep));
  const std::vector<Cell> cells = cells_of(sweep, first, last);
  auto manifest = read_manifest(options.run.folder);
  if (!manifest) {
    write_manifest(options.run.folder, options.file, cells_of(sweep));
    manifest = read_manifest(options.run.folder);
  }
  for (std::size_t i = first; i <= last; ++i) {
    if (i < manifest->cells.size() && manifest->cells[i].id == cells[i - first].id) continue;
    throw BadInput(
        "{}: cell {} is not the one of {}: the sweep, a file it names or the program has changed "
        "since; `gnbv sweep` without --index takes the new one",
        options.file.string(), i, (options.run.folder / "sweep.json").string());
  }
  RunCellsOptions run = options.run;
  run.wait_for_locked = false;
  run.quiet = run.quiet || cells.size() == 1;
  const std::vector<CellOutcome> outcomes = run_cells(cells, run);
  if (options.json) fmt::print("{}", cells_json(cells, outcomes));
  for (std::size_t i = 0; i < cells.size() && !options.json; ++i) {
    const CellOutcome& one = outcomes[i];
    const std::string what = one.status == CellStatus::done     ? one.run.string()
                             : one.status == CellStatus::failed ? one.failure
                             : one.status == CellStatus::locked
                                 ? "skipped: another process flies it"
                                 : "interrupted";
    fmt::print("{} {} {}: {}: {}\n", first + i, cells[i].id, name_of(cells[i]),
               kCellStatusNames.at(static_cast<std::size_t>(one.status)), what);
  }
  fail_if_any_failed(outcomes);
}

void submit_array(const SweepOptions& options, std::size_t cells) {
  const fs::path script = options.run.folder / "sweep.sbatch";
  SlurmOptions array = options.array;
  array.program = fs::read_symlink("/proc/self/exe");
  array.sweep_file = options.file;
  array.folder = options.run.folder;
  array.cells = cells;
  array.threads = std::max(1, options.run.threads);
  array.retry_failed = options.run.retry_failed;
  write_file_atomically(script, batch_script(array, max_array_size().value_or(kMaxArraySize)));
  fmt::print("{}\n", options.slurm_dry_run ? script.string() : submit(script));
}

void sweep(const SweepOptions& options) {
  if (options.run.folder.empty() && !options.list) {
    throw BadInput("--out: missing: the folder of the sweep");
  }
  if (!(options.slurm || options.slurm_dry_run) &&
      (options.array.limit > 0 || !options.array.arguments.empty())) {
    throw BadInput("--slurm-limit, --slurm-args: need --slurm or --slurm-dry-run");
  }
  const Sweep grid = read_sweep(options.file);
  if (!options.index.empty()) return run_indexed(options, grid);
  const std::vector<Cell> cells = cells_of(grid);
  if (options.list) return list(cells, options.json);
  if (!options.replace) require_folder_of(options.run.folder, options.file);
  if (options.status) return show_status(options, cells);
  write_manifest(options.run.folder, options.file, cells);
  if (options.slurm || options.slurm_dry_run) return submit_array(options, cells.size());
  const std::vector<CellOutcome> outcomes = run_cells(cells, options.run);
  report(options, cells, outcomes);
  fail_if_any_failed(outcomes);
}

}  // namespace

void add_sweep_command(CLI::App& app) {
  auto o = std::make_shared<SweepOptions>();
  CLI::App* const command =
      app.add_subcommand("sweep", "fly a grid of missions; what is done is not flown again");
  command
      ->add_option("FILE", o->file,
                   "YAML: scenarios, utilities, grid, seeds (docs/guides/sweeps.md)")
      ->required();
  command->add_option("--out", o->run.folder,
                      "folder of the sweep; with the same folder the sweep goes on");
  CLI::Option* const jobs =
      command->add_option("--jobs", o->run.jobs, "missions at a time, each a process")
          ->check(CLI::Range(1, 1024));
  command
      ->add_option("--threads", o->run.threads,
                   "threads of each mission; 0 = those of the machine, shared out")
      ->check(CLI::Range(0, 1024));
  CLI::Option* const index = command->add_option(
      "--index", o->index, "fly only cell K, or K-L, of --list; for schedulers");
  using Options = std::vector<CLI::Option*>;
  const auto add_flag = [&](const char* name, bool& flag, const char* meaning,
                            const Options& excluded) {
    CLI::Option* const option = command->add_flag(name, flag, meaning);
    for (CLI::Option* const other : excluded) option->excludes(other);
    return option;
  };
  CLI::Option* const list =
      add_flag("--list", o->list, "print the cells and fly nothing", {index, jobs});
  CLI::Option* const status = add_flag(
      "--status", o->status, "print what is done and failed; fly nothing", {index, list, jobs});
  add_flag("--retry-failed", o->run.retry_failed, "fly failed cells again, from the start",
           {list, status});
  add_flag("--replace", o->replace, "use OUT although another sweep file made it; its cells stay",
           {index, list, status});
  add_quiet_option(*command, o->run.quiet);
  command->add_flag("--json", o->json, "print the cells as JSON instead of a table");
  CLI::Option* const slurm =
      add_flag("--slurm", o->slurm, "write OUT/sweep.sbatch, submit it, print the job id",
               {index, list, status, jobs});
  add_flag("--slurm-dry-run", o->slurm_dry_run, "write OUT/sweep.sbatch and print its path",
           {index, list, status, jobs, slurm});
  command->add_option("--slurm-limit", o->array.limit, "array tasks at a time; 0 = no limit")
      ->check(CLI::Range(0, 1'000'000));
  command->add_option("--slurm-args", o->array.arguments,
                      "further options of sbatch, such as \"--time=02:00:00 --partition=cpu\"");
  command->callback([o] { sweep(*o); });
}

}  // namespace gnbv
