#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "bench/compare/paper_figures.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/mission/execute.hpp"
#include "tools/paper/page.hpp"
#include "tools/sweep/run_cells.hpp"
#include "tools/terminal/progress.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct PaperOptions {
  fs::path out;
  BenchOptions bench;  // its --out is --cells here
  std::uint64_t first_seed = 1;
  std::vector<std::string> scenarios;
  std::vector<std::string> overrides;
};

std::vector<std::string> paper_scenarios() {
  std::vector<std::string> names;
  for (const PaperTable& table : paper_tables()) names.emplace_back(table.scenario);
  return names;
}

/// Each once, in the paper's order; all where none is asked for.
std::vector<std::string> scenarios_asked(const PaperOptions& options) {
  std::vector<std::string> names = paper_scenarios();
  if (options.scenarios.empty()) return names;
  std::erase_if(names, [&](const std::string& name) {
    return std::count(options.scenarios.begin(), options.scenarios.end(), name) == 0;
  });
  return names;
}

/// What the page depends on; neither where its missions are kept nor by how many processors.
std::string command_of(const PaperOptions& options) {
  std::string command =
      fmt::format("gnbv paper -o {} --seed {} --seeds {}", shell_word(options.out.string()),
                  options.first_seed, options.bench.seed_count);
  if (!options.scenarios.empty()) {
    command += fmt::format(" --scenarios {}", fmt::join(scenarios_asked(options), ","));
  }
  for (const std::string& set : options.overrides) command += " --set " + shell_word(set);
  return command;
}

/// The labs once more, with their images; apart from the others, since those of the same content
/// keep none.
void fly_pictured(const PaperOptions& options, PaperMaterial& material, bool& has_failures) {
  const std::vector<Cell> cells = pictured_cells(material.request);
  const RunCellsOptions run{.folder = bench_folder(options.bench) / "with-images",
                            .jobs = options.bench.jobs,
                            .threads = options.bench.threads,
                            .retry_failed = true,
                            .quiet = options.bench.quiet,
                            .run_arguments = {"--frames"}};
  const std::vector<CellOutcome> outcomes = run_cells(cells, run);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (outcomes[i].status == CellStatus::missing) {
      throw CommandFailed("interrupted; the same command goes on");
    }
    if (outcomes[i].status == CellStatus::done) {
      material.with_images.push_back(
          {cells[i].scenario, cells[i].method, cells[i].seed, read_run(outcomes[i].run)});
    } else {
      has_failures = true;
      material.notes.push_back(fmt::format("{}, {}: without images: {}", cells[i].scenario,
                                           cells[i].method, outcomes[i].failure));
    }
  }
}

PaperMaterial fly(const PaperOptions& options, bool& has_failures) {
  PaperMaterial material{
      .request = {.scenarios = scenarios_asked(options),
                  .seeds = seeds_from(options.first_seed, options.bench.seed_count),
                  .overrides = options.overrides},
      .missions = {},
      .with_images = {},
      .notes = {}};
  std::vector<Cell> cells = paper_cells(material.request);
  // those that are there come first: what is left then takes what the flown ones took
  std::stable_partition(cells.begin(), cells.end(), [&](const Cell& cell) {
    return look_up(bench_folder(options.bench), cell).status == CellStatus::done;
  });
  const BenchRuns flown = fly_cells(cells, options.bench);
  for (std::size_t i = 0; i < flown.runs.size(); ++i) {
    const ComparedRun& run = flown.runs[i];
    material.missions.push_back({run.scenario, run.method, run.seed, read_run(flown.folders[i])});
  }
  material.notes = flown.notes;
  has_failures = !flown.failures.empty();
  fly_pictured(options, material, has_failures);
  return material;
}

std::vector<DrawnFigure> draw(const PaperOptions& options, const PaperMaterial& material) {
  ProgressBar bar("figures", options.bench.quiet);
  return draw_figures(material, options.out, thread_count(options.bench.threads),
                      [&](std::size_t done, std::size_t all, const std::string& figure) {
                        bar.show(static_cast<double>(done) / static_cast<double>(all), figure);
                      });
}

void paper(const PaperOptions& options) {
  make_folder(options.out);  // one that cannot be made costs no mission
  bool has_failures = false;
  const PaperMaterial material = fly(options, has_failures);
  PaperPage page{.command = command_of(options),
                 .version = GNBV_VERSION,
                 .seeds = material.request.seeds.size(),
                 .tables = shown_tables(material),
                 .claims = check_claims(material),
                 .figures = draw(options, material),
                 .notes = material.notes};
  for (ShownTable& table : page.tables) {
    table.whole.notes.push_back(fmt::format("{}, version {}", page.command, GNBV_VERSION));
  }
  write_page(page, options.out);
  fmt::print("{}\n", (options.out / "index.html").string());
  if (has_failures) throw CommandFailed("not every mission came to its end; the page says which");
}

}  // namespace

void add_paper_command(CLI::App& app) {
  auto options = std::make_shared<PaperOptions>();
  options->bench.seed_count = 5;
  CLI::App* const command = app.add_subcommand(
      "paper", "the paper's whole evaluation flown and drawn, beside what the paper shows");
  command
      ->add_option("-o,--out", options->out,
                   "folder to write: index.html, tables/, figures/; made if need be")
      ->required();
  command->add_option("--cells", options->bench.out,
                      "folder of the missions (default: runs/bench, which `table` and `compare` "
                      "share); those it holds are not flown again");
  add_cells_options(*command, options->bench, "how many seeds a row, from --seed on");
  command->add_option("--seed", options->first_seed, "the first one; pictures show it")
      ->capture_default_str();
  command->add_option("--scenarios", options->scenarios, "some of the paper's, with commas")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(is_one_of(paper_scenarios()));
  command->add_option("--set", options->overrides, "KEY=VALUE of all scenario files; repeatable")
      ->allow_extra_args(false);
  command->callback([options] { paper(*options); });
}

}  // namespace gnbv
