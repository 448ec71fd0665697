#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "scenarios/load.hpp"
#include "tools/figures/figure.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/paper/page.hpp"

namespace gnbv {

void add_schema_command(CLI::App& app) {
  auto of = std::make_shared<std::string>("scenario");
  CLI::App* const command =
      app.add_subcommand("schema", "print the JSON Schema of scenario files, for editors");
  command
      ->add_option("OF", *of,
                   "scenario; figures: what `gnbv plot --format json` writes; paper: paper.json "
                   "beside the page of `gnbv paper`")
      ->check(is_one_of({"scenario", "figures", "paper"}))
      ->capture_default_str();
  command->callback([of] {
    fmt::print("{}", *of == "figures" ? std::string(figures_schema())
                     : *of == "paper" ? paper_schema()
                                      : scenario_json_schema());
  });
}

}  // namespace gnbv
