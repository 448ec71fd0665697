// The commands of the program: each adds its options to the command line and runs when chosen.
#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>

#include "tools/mission/execute.hpp"

namespace gnbv {

/// What was asked for did not come about (exit code 1): a mission that ended in a collision.
class CommandFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a scenario is changed by: --mesh, --seed, --set, --bounds.
void add_structure_options(CLI::App& command, MissionOptions& options);

/// SCENARIO and those.
void add_scenario_options(CLI::App& command, MissionOptions& options);

/// --out, --threads and --quiet.
void add_work_options(CLI::App& command, MissionOptions& options);

/// All of them: what every command which flies a mission has.
void add_mission_options(CLI::App& command, MissionOptions& options);

void add_compare_command(CLI::App& app);
void add_fly_command(CLI::App& app);
void add_run_command(CLI::App& app);
void add_sweep_command(CLI::App& app);
void add_table_command(CLI::App& app);
void add_ceiling_command(CLI::App& app);
void add_export_command(CLI::App& app);
void add_plot_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_report_command(CLI::App& app);
void add_asset_command(CLI::App& app);
void add_lint_command(CLI::App& app);
void add_schema_command(CLI::App& app);
void add_score_command(CLI::App& app);
void add_check_command(CLI::App& app);
void add_surface_command(CLI::App& app);

}  // namespace gnbv
