#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "bench/compare/paper_figures.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/mission/execute.hpp"
#include "tools/paper/page.hpp"
#include "tools/terminal/progress.hpp"
#include "tools/terminal/say.hpp"

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

void paper(const PaperOptions& options) {
  need_page_python();
  make_folder(options.out);  // one that cannot be made costs no mission
  const PaperMaterial material =
      fly_paper({.scenarios = scenarios_asked(options),
                 .seeds = seeds_from(options.first_seed, options.bench.seed_count),
                 .overrides = options.overrides},
                options.bench);
  ProgressBar bar("figures", options.bench.quiet);
  write_page(material, command_of(options), options.out, thread_count(options.bench.threads),
             [&](double share, const std::string& figure) { bar.show(share, figure); });
  fmt::print("{}\n", (options.out / "index.html").string());
  if (material.has_failures) {
    throw CommandFailed("not every mission came to its end; the page says which");
  }
}

}  // namespace

void add_paper_command(CLI::App& app) {
  auto options = std::make_shared<PaperOptions>();
  options->bench.seed_count = 5;
  CLI::App* const command = app.add_subcommand(
      "paper", "the paper's whole evaluation flown and drawn, beside what the paper shows");
  command
      ->add_option("-o,--out", options->out,
                   "folder to write: index.html, paper.json, tables/, figures/; made if need be")
      ->required();
  command->add_option("--cells", options->bench.out,
                      "folder of the missions (default: runs/bench, which `table` and `compare` "
                      "share); those it holds are not flown again");
  add_cells_options(*command, options->bench, "how many seeds for each row, from --seed on");
  command->add_option("--seed", options->first_seed, "the first seed; pictures show its missions")
      ->capture_default_str();
  add_list(*command, "--scenarios", options->scenarios,
           "some of the paper's scenarios, with commas (default: all)")
      ->check(is_one_of(paper_scenarios()));
  command->add_option("--set", options->overrides, "KEY=VALUE of all scenario files; repeatable")
      ->allow_extra_args(false);
  command->callback([options] { paper(*options); });
}

}  // namespace gnbv
