// The commands of the program: each adds its options to the command line and runs when chosen.
#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>

#include "tools/gnbv/execute.hpp"

namespace gnbv {

/// What was asked for did not come about (exit code 1): a mission that ended in a collision.
class CommandFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The options that say which scenario is meant: SCENARIO, --mesh, --seed, --set.
void add_scenario_options(CLI::App& command, MissionOptions& options);

/// Those, and the others that every command which flies missions has.
void add_mission_options(CLI::App& command, MissionOptions& options);

void add_fly_command(CLI::App& app);
void add_run_command(CLI::App& app);
void add_sweep_command(CLI::App& app);
void add_table_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_asset_command(CLI::App& app);
void add_lint_command(CLI::App& app);

}  // namespace gnbv
