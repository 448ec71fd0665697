// The commands of the program: each adds its options to the command line and runs when chosen.
#pragma once

#include "tools/terminal/say.hpp"  // IWYU pragma: export

namespace CLI {
class App;
}  // namespace CLI

namespace gnbv {

void add_bench_command(CLI::App& app);
void add_compare_command(CLI::App& app);
void add_fly_command(CLI::App& app);
void add_run_command(CLI::App& app);
void add_sweep_command(CLI::App& app);
void add_table_command(CLI::App& app);
void add_ceiling_command(CLI::App& app);
void add_export_command(CLI::App& app);
void add_paper_command(CLI::App& app);
void add_plot_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_report_command(CLI::App& app);
void add_asset_command(CLI::App& app);
void add_lint_command(CLI::App& app);
void add_schema_command(CLI::App& app);
void add_score_command(CLI::App& app);
void add_check_command(CLI::App& app);
void add_surface_command(CLI::App& app);
void add_cache_command(CLI::App& app);
void add_doctor_command(CLI::App& app);

}  // namespace gnbv
