#include <fmt/format.h>

#include <memory>

#include "bench/paper_table.hpp"
#include "sim/core/error.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/execute.hpp"
#include "tools/gnbv/figures.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct TableOptions : MissionOptions {
  bool markdown = false;
};

void table(const TableOptions& options) {
  if (options.resume && options.out.empty()) {
    throw BadInput("--resume: needs --out, the folder of the table to continue");
  }
  const PaperTable* const paper = find_paper_table(resolve_scenario(options).name);
  if (paper == nullptr) {
    std::string known;
    for (const PaperTable& t : paper_tables()) known += fmt::format(" {}", t.scenario);
    throw BadInput(fmt::format("{}: the paper has no table for this scenario; it has:{}",
                               options.scenario, known));
  }
  const Scenario first = resolve_scenario(options);
  const fs::path parent = options.out.empty()
                              ? free_folder(fmt::format("table-{}-seed{}", first.name, first.seed))
                              : options.out;
  std::vector<RunFigures> missions;
  std::vector<fs::path> folders;
  bool collided = false;
  for (const PaperRow& row : paper->rows) {
    MissionOptions one = options;
    // last, so that it is the row's whatever the user set
    one.overrides.push_back(fmt::format("planner.utility.name={}", row.utility));
    one.out = parent / std::string(row.utility);
    const Scenario scenario = resolve_scenario(one);
    const ExecutedMission mission = execute_mission(scenario, one);
    missions.push_back(figures_of(scenario, mission));
    folders.push_back(mission.folder);
    collided = collided || mission.result.termination == Termination::collision;
    // Ctrl-C ends the mission at hand; the table of the others would be misread as complete
    if (mission.result.termination == Termination::interrupted) {
      throw CommandFailed(fmt::format(
          "interrupted; the same command with --resume --out {} goes on", parent.string()));
    }
  }
  const TextTable text = comparison_table(*paper, missions, {});
  fmt::print("{}\n", options.markdown ? markdown_text(text) : terminal_text(text));
  for (const fs::path& folder : folders) fmt::print("{}\n", folder.string());
  if (collided) throw CommandFailed("a vehicle hit something; its run directory shows where");
}

}  // namespace

void add_table_command(CLI::App& app) {
  auto options = std::make_shared<TableOptions>();
  CLI::App* const command =
      app.add_subcommand("table", "fly every row of the paper's table and print both");
  add_mission_options(*command, *options);
  command->add_flag("--resume", options->resume, "continue the interrupted table in --out");
  command->add_flag("--markdown", options->markdown, "print the table as Markdown");
  command->callback([options] { table(*options); });
}

}  // namespace gnbv
