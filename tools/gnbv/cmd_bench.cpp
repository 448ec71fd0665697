#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "bench/suite/standings.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "tools/figures/figure_files.hpp"
#include "tools/gnbv/commands.hpp"
#include "tools/gnbv/shared_options.hpp"
#include "tools/suite/suite_work.hpp"
#include "tools/terminal/streams.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

struct BenchSuiteOptions {
  fs::path suite;
  SuiteFlights flights;
  std::string track;
  std::string planner, name;
  std::vector<std::string> settings;
  std::vector<std::string> only;  // tasks
  bool resume = false;
  fs::path folder, out;
  EntryWords words;
  std::vector<fs::path> files;
  std::string format = "terminal";
  fs::path plot;
  std::vector<std::string> planners = {"oracle_metres", "tour", "proposed"};
};

Suite suite_of(const BenchSuiteOptions& options) {
  if (options.suite.empty()) return read_suite(std::string(builtin_suite()), "suite/v1.yaml");
  return read_suite(read_file(options.suite), options.suite.string());
}

std::vector<Submission> entries_of(const BenchSuiteOptions& options) {
  std::vector<Submission> entries;
  for (const fs::path& file : options.files) entries.push_back(read_submission(file));
  return entries;
}

void run_entry(const BenchSuiteOptions& options) {
  const EntryFolder entry{suite_of(options), options.track,
                          entry_planner(options.planner, options.settings, options.name)};
  const std::vector<SuiteTask> tasks = asked_tasks(entry.suite, options.track, options.only);
  if (!tasks.empty()) {  // what is refused, or starts the program again, does so before the claim
    const ScratchFolder scratch;
    TaskScenarios scenarios(entry.suite, scratch.path());
    cells_of_entry(entry.suite, {tasks.front()}, entry.planner, scenarios);
  }
  claim_entry_folder(options.out, entry, options.resume);
  const auto frozen = std::ranges::count_if(tasks, &SuiteTask::is_frozen);
  if (const auto loose = std::ssize(tasks) - frozen; loose > 0) {
    say("{} of {} tasks of track {} are not frozen yet: no score, and nothing to submit", loose,
        tasks.size(), options.track);
  }
  fly_entry(options.out, entry, tasks, options.flights);
  fmt::print("{}\n", options.out.string());
}

void submit_entry(const BenchSuiteOptions& options) {
  write_submission(submission_of(options.folder, options.words), options.out);
  const std::vector<Submission> entries = {read_submission(options.out)};
  const Suite suite = read_entry_folder(options.folder).suite;
  for (const TextTable& table : standings_tables(suite, entries)) {
    fmt::print("{}", formatted_text(table, "terminal", stdout_columns()));
  }
  fmt::print("{}\n", options.out.string());
}

void verify_entry(const BenchSuiteOptions& options) {
  const Submission entry = read_submission(options.files.front());
  const ScratchFolder scratch;
  const fs::path folder = options.out.empty() ? scratch.path() : options.out;
  SuiteFlights flights = options.flights;
  flights.only = options.only;
  const auto differences = verify_submission(entry, suite_of(options), folder, flights);
  const std::string file = entry.file.string();
  for (const std::string& difference : differences) {
    fmt::print("{}: {}\n", file, printable(difference));
  }
  if (!differences.empty()) {
    throw CommandFailed("{}: {} found, flown again with this program", file,
                        counted(differences.size(), "difference"));
  }
  const std::size_t all = entry.missions.size();
  const std::size_t flown = asked_tasks(suite_of(options), entry.track, options.only).size();
  fmt::print(
      "{}: {}, track {}: verified: {} flown again, every number but the planning time is "
      "as it says{}\n",
      file, printable(entry.name), entry.track, counted(flown, "mission"),
      flown == all ? "" : fmt::format("; not flown: {}", counted(all - flown, "other")));
}

void print_standings(const BenchSuiteOptions& options) {
  const std::vector<Submission> entries = entries_of(options);
  for (const Submission& entry : entries) need_flyable(entry, suite_of(options));
  bool is_first = true;
  for (const TextTable& table : standings_tables(suite_of(options), entries)) {
    fmt::print("{}{}", is_first ? "" : "\n",
               formatted_text(table, options.format, stdout_columns()));
    is_first = false;
  }
  if (options.plot.empty()) return;
  const Figure figure = standings_figure(suite_of(options), entries);
  draw_to_files({{{&figure, options.plot}}});
}

void write_page_of(const BenchSuiteOptions& options) {
  write_suite_page(suite_of(options), entries_of(options), options.out, options.flights);
  fmt::print("{}\n", (options.out / "index.html").string());
}

using Options = std::shared_ptr<BenchSuiteOptions>;

CLI::App* add_part(CLI::App& bench, const Options& o, const char* name, const char* what,
                   void (*does)(const BenchSuiteOptions&)) {
  CLI::App* const part = bench.add_subcommand(name, what);
  part->callback([o, does] { does(*o); });
  return part;
}

void add_suite_option(CLI::App& part, const Options& o) {
  part.add_option("--suite", o->suite, "another suite's YAML (default: version 1, built in)");
}

void add_flight_options(CLI::App& part, const Options& o) {
  part.add_option("--jobs", o->flights.jobs, "missions at a time, each in a process of its own")
      ->check(CLI::Range(1, 1024));
  add_threads_option(part, o->flights.threads);
  add_quiet_option(part, o->flights.quiet);
}

void add_files(CLI::App& part, const Options& o, const char* what) {
  part.add_option("FILE", o->files, what)->required();
}

void add_run_part(CLI::App& bench, const Options& o) {
  CLI::App& run = *add_part(bench, o, "run", "fly a planner's missions of a track", run_entry);
  run.add_option("--track", o->track, "small, exact, real or takeoff")->required();
  run.add_option("--planner", o->planner,
                 "a planner of gnbv by name, FILE.py:FUNCTION, or a command that speaks the view "
                 "exchange (docs/guides/own-views.md)")
      ->required();
  run.add_option("--set", o->settings, "KEY=VALUE of how views are chosen; repeatable")
      ->allow_extra_args(false);
  run.add_option("--name", o->name, "in the standings, instead of the planner's own");
  run.add_option("--task", o->only, "this structure alone; repeatable")->allow_extra_args(false);
  run.add_option("-o,--out", o->out,
                 "folder of the entry; several processes, on several machines, may share it")
      ->required();
  run.add_flag("--resume", o->resume, "go on with the entry in the folder");
  add_suite_option(run, o);
  add_flight_options(run, o);
}

void add_submission_parts(CLI::App& bench, const Options& o) {
  CLI::App& submit =
      *add_part(bench, o, "submit", "one file of an entry whose missions are flown", submit_entry);
  submit.add_option("DIR", o->folder, "folder of `gnbv bench run`")->required();
  submit.add_option("-o,--out", o->out, "zip to write")->required();
  submit.add_option("--description", o->words.description, "a sentence on the planner");
  submit.add_option("--licence", o->words.licence, "of the entry");
  CLI::App& verify = *add_part(bench, o, "verify",
                               "fly a submission again and recompute its numbers", verify_entry);
  add_files(verify, o, "zip of `gnbv bench submit`");
  verify.get_option("FILE")->expected(1);
  verify.add_option("-o,--out", o->out, "folder to keep the missions in (default: none)");
  verify.add_option("--task", o->only, "this structure alone; repeatable")->allow_extra_args(false);
  add_suite_option(verify, o);
  add_flight_options(verify, o);
}

void add_standings_parts(CLI::App& bench, const Options& o) {
  CLI::App& table = *add_part(bench, o, "table", "the standings", print_standings);
  add_files(table, o, "zips of `gnbv bench submit`");
  table.add_option("--format", o->format, "form of the table on stdout")
      ->check(is_one_of({kTableFormats.begin(), kTableFormats.end()}))
      ->capture_default_str();
  table.add_option("--plot", o->plot, "also draw them: a file .svg, .png or .pdf")
      ->check(CLI::Validator(
          [](const std::string& file) -> std::string {
            const std::string kind = fs::path(file).extension().string();
            if (kind == ".svg" || kind == ".png" || kind == ".pdf") return "";
            return fmt::format("'{}' must end in .svg, .png or .pdf", file);
          },
          ""));
  add_suite_option(table, o);
  CLI::App& page =
      *add_part(bench, o, "page", "a static site of the standings; every mission is flown again",
                write_page_of);
  add_files(page, o, "zips of `gnbv bench submit`");
  page.add_option("-o,--out", o->out, "folder of the site")->required();
  add_suite_option(page, o);
  add_flight_options(page, o);
}

void add_freeze_part(CLI::App& bench, const Options& o) {
  CLI::App& freeze = *add_part(
      bench, o, "freeze", "find what tasks of a suite lack, and write it into its file",
      [](const BenchSuiteOptions& options) {
        freeze_track(options.suite, options.track, options.planners, options.out, options.flights);
        fmt::print("{}\n", options.suite.string());
      });
  freeze.add_option("SUITE", o->suite, "YAML; what is frozen in it stays")->required();
  freeze.add_option("--track", o->track, "whose tasks")->required();
  add_list(freeze, "--planners", o->planners, "of whom the best counts, with commas")
      ->capture_default_str();
  freeze.add_option("-o,--out", o->out, "folder of the missions; the same one goes on with them")
      ->required();
  add_flight_options(freeze, o);
}

}  // namespace

void add_bench_command(CLI::App& app) {
  const auto options = std::make_shared<BenchSuiteOptions>();
  CLI::App& bench = *app.add_subcommand(
      "bench",
      "the suite: fixed tasks for planners, and submissions that anybody can verify (how fast the "
      "program itself is: tools/bench)");
  bench.require_subcommand(1);
  add_run_part(bench, options);
  add_submission_parts(bench, options);
  add_standings_parts(bench, options);
  add_freeze_part(bench, options);
}

}  // namespace gnbv
