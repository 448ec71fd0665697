#include "tools/gnbv/shared_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "bench/compare/text_table.hpp"
#include "scenarios/validation_error.hpp"
#include "sim/core/text.hpp"
#include "tools/terminal/say.hpp"
#include "tools/terminal/streams.hpp"

namespace gnbv {
namespace {

CLI::Validator number_check(const std::string& must_be, bool (*is_good)(double)) {
  return {[=](std::string& text) {
            double value = 0.0;
            const bool is_number = CLI::detail::lexical_cast(text, value);
            return is_number && is_good(value) ? "" : fmt::format("'{}' must be {}", text, must_be);
          },
          must_be};
}

/// CLI11 takes 010 for 8, and what is below 0 or above 2^64 - 1 for other numbers.
bool is_decimal(std::string_view text) {
  return number_in<std::uint64_t>(text) && (text[0] != '0' || text.size() == 1);
}

/// Of all commands and their parts.
std::vector<CLI::Option*> options_of_all(CLI::App& app) {
  const auto any = [](const auto*) { return true; };
  std::vector<CLI::Option*> options;
  for (CLI::App* const command : app.get_subcommands(any)) {
    for (const auto& more : {command->get_options(any), options_of_all(*command)}) {
      options.insert(options.end(), more.begin(), more.end());
    }
  }
  return options;
}

}  // namespace

void add_bounds_option(CLI::App& command, ScenarioOptions& options) {
  command
      .add_option_function<std::string>(
          "--bounds",
          [&options](const std::string& bounds) { options.bounds_auto = bounds == "auto"; },
          "auto: lay workspace and start around the structure, wherever it is; scenario: as the "
          "scenario says")
      ->check(is_one_of({"auto", "scenario"}));
}

void add_structure_options(CLI::App& command, ScenarioOptions& options) {
  command.add_option("--mesh", options.mesh, "a mesh file instead of the scenario's structure");
  command.add_option("--seed", options.seed,
                     "moves the start pose; all random numbers come from it");
  command.add_option("--set", options.overrides, "KEY=VALUE of the scenario file; repeatable")
      ->allow_extra_args(false);
  add_bounds_option(command, options);
}

void add_scenario_options(CLI::App& command, ScenarioOptions& options) {
  command.add_option("SCENARIO", options.scenario, "built-in name or YAML file")->required();
  add_structure_options(command, options);
}

void add_preset_option(CLI::App& command, ScenarioOptions& options) {
  command.add_option(
      "--preset", options.preset,
      "paper; the authors' code: released (2017), authors_2018; or takeoff: no profile");
}

CLI::Option* add_list(CLI::App& command, const char* name, std::vector<std::string>& values,
                      const std::string& meaning) {
  return command.add_option(name, values, meaning)->delimiter(',')->allow_extra_args(false);
}

CLI::Option* add_utilities_option(CLI::App& command, std::vector<std::string>& utilities,
                                  const std::string& what) {
  return add_list(command, "--utilities", utilities,
                  what +
                      ": utilities by name, utilities and planners of yours as "
                      "[NAME=]FILE.py[:FUNCTION], with commas");
}

void add_threads_option(CLI::App& command, int& threads, const std::string& what) {
  command.add_option("--threads", threads, fmt::format("0 = all; {} not depend on it", what))
      ->check(CLI::Range(0, 1024));
}

void add_quiet_option(CLI::App& command, bool& quiet, const std::string& what) {
  command.add_flag("--quiet", quiet, "no " + what);
}

void add_cells_options(CLI::App& command, BenchOptions& options, const std::string& seeds) {
  add_threads_option(command, options.threads);
  add_quiet_option(command, options.quiet);
  command.add_option("--seeds", options.seed_count, seeds)
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command.add_option("--jobs", options.jobs, "missions at a time, each in a process of its own")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

void add_bench_options(CLI::App& command, BenchOptions& options) {
  command.add_option(
      "--out", options.out,
      "folder of the missions (default: runs/bench); those it holds are not flown again");
  add_cells_options(command, options, "how many seeds, from --seed on");
  command
      .add_option("--ceiling-at", options.ceiling_percent,
                  "percent of coverage at 0.05 m of which shares are taken, instead of the ceiling "
                  "that a search finds: for example what an oracle reached")
      ->check(CLI::Range(1.0, 100.0));
  CLI::Option* const missions =
      command.add_option("--missions", options.missions,
                         "CSV with one row for each mission. Missions that it holds are not flown "
                         "again; the others are added");
  command
      .add_option("--commit", options.commit,
                  "commit of this program, written into the rows of --missions")
      ->needs(missions);
  command.add_option("--format", options.format, "form of the table on stdout")
      ->check(is_one_of({kTableFormats.begin(), kTableFormats.end()}))
      ->capture_default_str();
}

void print_bench(const BenchTables& bench, const std::string& format) {
  for (const TextTable& table : bench.tables) {
    fmt::print("{}{}", &table == &bench.tables.front() ? "" : "\n",
               formatted_text(table, format, stdout_columns()));
  }
  if (bench.failures.empty()) return;
  throw CommandFailed("not every mission came to its end:\n{}", fmt::join(bench.failures, "\n"));
}

void refuse_odd_numbers(CLI::App& app) {
  const CLI::Validator is_finite =
      number_check("a finite number", [](double x) { return std::isfinite(x); }).description("");
  const CLI::Validator is_whole(
      [](std::string& text) {
        return is_decimal(text)
                   ? ""
                   : fmt::format("'{}' must be a whole number in decimal digits, below 2^64", text);
      },
      "");
  for (CLI::Option* const option : options_of_all(app)) {
    const std::string type = option->get_type_name();
    if (type.starts_with("FLOAT")) option->check(is_finite);
    if (type.starts_with("INT") || type.starts_with("UINT")) option->check(is_whole);
  }
}

void refuse_empty_values(CLI::App& app) {
  const CLI::Validator is_something(
      [](std::string& text) { return std::string(text.empty() ? "is empty" : ""); }, "");
  for (CLI::Option* const option : options_of_all(app)) {
    const bool takes_a_value = option->get_items_expected_max() > 0;
    const std::string name = option->get_name();
    const bool may_be_empty = name == "--title" || name == "--slurm-args";
    if (takes_a_value && !may_be_empty) option->check(is_something);
  }
}

CLI::Validator is_one_of(std::vector<std::string> names) {
  const std::string description = fmt::format("{{{}}}", fmt::join(names, ","));
  return {[names = std::move(names)](std::string& text) -> std::string {
            if (std::find(names.begin(), names.end(), text) != names.end()) return "";
            const std::vector<std::string_view> known(names.begin(), names.end());
            return fmt::format("'{}' is no known name ({}allowed: {})", text,
                               did_you_mean(text, known), join(known));
          },
          description};
}

CLI::Validator is_positive() {
  return number_check("a number above 0", [](double x) { return std::isfinite(x) && x > 0.0; });
}
CLI::Validator is_elevation_deg() {
  return number_check("from -89 to 90", [](double x) { return x >= -89.0 && x <= 90.0; });
}

}  // namespace gnbv
