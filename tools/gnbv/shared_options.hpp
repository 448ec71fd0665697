// Options that several commands have, each added only where it is read.
#pragma once

#include <string>
#include <vector>

#include "tools/mission/resolve.hpp"
#include "tools/sweep/bench_runs.hpp"

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace gnbv {

/// --bounds.
void add_bounds_option(CLI::App& command, ScenarioOptions& options);

/// What a scenario is changed by: --mesh, --seed, --set, --bounds.
void add_structure_options(CLI::App& command, ScenarioOptions& options);

/// SCENARIO and those.
void add_scenario_options(CLI::App& command, ScenarioOptions& options);

/// --preset of the planner.
void add_preset_option(CLI::App& command, ScenarioOptions& options);

/// Words with commas between them; repeatable.
CLI::Option* add_list(CLI::App& command, const char* name, std::vector<std::string>& values,
                      const std::string& meaning);

/// --utilities: `what` they are.
CLI::Option* add_utilities_option(CLI::App& command, std::vector<std::string>& utilities,
                                  const std::string& what);

/// --threads. `what` does not depend on it.
void add_threads_option(CLI::App& command, int& threads,
                        const std::string& what = "the result does");

/// --quiet: without `what`.
void add_quiet_option(CLI::App& command, bool& quiet,
                      const std::string& what = "progress on stderr");

/// Where many missions are flown: --jobs, --threads, --quiet, and `seeds` as --seeds.
void add_cells_options(CLI::App& command, BenchOptions& options, const std::string& seeds);

/// What tables of many missions share: those, --out, --ceiling-at and --format.
void add_bench_options(CLI::App& command, BenchOptions& options);

/// Prints the tables, an empty line between them, then throws CommandFailed if something failed.
void print_bench(const BenchTables& bench, const std::string& format);

/// No number on the command line of any command may be NaN or infinite, which pass CLI11's ranges;
/// no whole one in octal or hexadecimal digits, or too large. To be called when all commands have
/// their options.
void refuse_odd_numbers(CLI::App& app);

/// No option and no argument of a command may be "", as a shell's variable that is not set gives:
/// it would mean that it was not given. But for titles and further options of sbatch.
void refuse_empty_values(CLI::App& app);

/// One of a closed list of names; a slip of one of them is told so.
CLI::Validator is_one_of(std::vector<std::string> names);

// Checks of numbers; those of CLI11 print 300 digits.
CLI::Validator is_positive();
CLI::Validator is_elevation_deg();

}  // namespace gnbv
