#include <CLI/CLI.hpp>
#include <memory>

#include "sim/core/error.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/sweep/table_missions.hpp"

namespace gnbv {

void add_table_command(CLI::App& app) {
  struct TableOptions {
    TableRequest request;
    BenchOptions bench;
  };
  auto options = std::make_shared<TableOptions>();
  CLI::App* const command = app.add_subcommand(
      "table", "fly every row of the paper's table, the tour and the oracles, and print all");
  TableRequest& request = options->request;
  add_scenario_options(*command, request.scenario);
  add_preset_option(*command, request.scenario);
  add_bench_options(*command, options->bench);
  add_utilities_option(*command, request.utilities, "rows beside the paper's");
  command->add_flag("--no-oracle", request.no_oracle,
                    "leave out the oracles, the planners that know the mesh");
  CLI::Option* const from = command->add_option(
      "--from", request.from, "files of rows (--missions): print what they hold, fly nothing");
  command->get_option("SCENARIO")->required(false)->excludes(from);
  for (const char* name : {"--mesh", "--seed", "--set", "--bounds", "--preset", "--seeds", "--jobs",
                           "--out", "--utilities", "--no-oracle", "--missions", "--ceiling-at"}) {
    command->get_option(name)->excludes(from);
  }
  command->callback([options] {
    if (options->request.scenario.scenario.empty() && options->request.from.empty()) {
      throw BadInput("table: needs a SCENARIO, or --from");
    }
    print_bench(table_of_missions(options->request, options->bench), options->bench.format);
  });
}

}  // namespace gnbv
