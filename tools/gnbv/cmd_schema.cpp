#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "scenarios/load.hpp"
#include "tools/gnbv/commands.hpp"

namespace gnbv {

void add_schema_command(CLI::App& app) {
  app.add_subcommand("schema", "print the JSON Schema of scenario files, for editors")
      ->callback([] { fmt::print("{}", scenario_json_schema()); });
}

}  // namespace gnbv
