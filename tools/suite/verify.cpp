#include <fmt/format.h>

#include <algorithm>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/mission/resolve.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/suite/suite_work.hpp"
#include "tools/terminal/say.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// The planner of a submission; of somebody else's the views that it gave in the task. Nothing of
/// it is code, and no file but those of the suite is read.
EntryPlanner planner_of(const Submission& submission, const fs::path& records) {
  EntryPlanner planner{.name = submission.name};
  if (submission.kind == EntryKind::views) {
    planner.asks = {{fmt::format("planner.utility.name={}", kRouteName)}};
    const std::string file = (records / kGivenFile).string();
    const bool has_views = std::ranges::count(read_file(file), '\n') > 1;
    if (has_views) planner.asks.push_back(views_of_file(file));
  }
  for (const std::string& setting : submission.settings) {
    planner.settings.push_back({setting, "settings: " + setting});
  }
  return planner;
}

/// The mission of a task as it is flown again; its records lie beside it. Of a planner of the
/// program's nothing of the record is taken up: it has to come to the same views by itself.
Cell prepare(const Submission& submission, const Suite& suite, const SuiteTask& task,
             const fs::path& folder, TaskScenarios& scenarios) {
  const fs::path records = folder / "records" / task.structure;
  make_folder(records);
  for (const char* const file : {kRecordFile, kGivenFile, kPathFile, kCurveFile}) {
    const auto found = submission.records.find(member_name(task.structure, file));
    if (found != submission.records.end()) write_file_atomically(records / file, found->second);
  }
  planning_s(records);  // throws
  return cells_of_entry(suite, {task}, planner_of(submission, records), scenarios).front();
}

/// Names what of the figures is another.
struct FlownAgain {
  std::string of;
  std::vector<std::string>& differences;

  template <typename Value>
  void operator()(const char* what, const Value& now, const Value& said) const {
    if (now == said) return;
    differences.push_back(fmt::format("{}: {} is {} when flown again, the file says {}", of, what,
                                      text(now), text(said)));
  }
  static std::string text(const auto& value) { return fmt::format("{}", value); }
  static std::string text(const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : "not reached";
  }
};

void compare_figures(const TaskFigures& now, const TaskFigures& said, const FlownAgain& compare) {
  compare("termination", now.termination, said.termination);
  compare("views", now.views, said.views);
  compare("spent", now.spent, said.spent);
  compare("integral", now.integral, said.integral);
  compare("share", now.share, said.share);
  compare("coverage", now.coverage, said.coverage);
  compare("to_90", now.to_90, said.to_90);
  compare("to_95", now.to_95, said.to_95);
  compare("result_sha256", now.result_sha256, said.result_sha256);
}

/// Views and files as they were and as they are.
void compare_records(const fs::path& run, const Submission& submission, const std::string& task,
                     const FlownAgain& compare, const fs::path& records) {
  const auto now = read_view_records(run / kIterationsFile);
  const auto said = read_view_records(records / kRecordFile);
  if (now.size() != said.size()) compare("views on record", now.size(), said.size());
  for (std::size_t i = 0; i < std::min(now.size(), said.size()); ++i) {
    if (const auto difference = first_difference(now[i], said[i])) {
      compare(fmt::format("view {}: {}", i, difference->column).c_str(), difference->now,
              difference->recorded);
      break;
    }
  }
  for (const auto& [file, text] : mission_records(run, submission.kind)) {
    if (file == kRecordFile || text == submission.records.at(member_name(task, file))) continue;
    compare.differences.push_back(
        fmt::format("{}: {} is another when flown again", compare.of, file));
  }
}

/// Whoever gave no view in a task gives none again, on an empty standard input.
std::vector<CellOutcome> fly(const std::vector<Cell>& cells, const fs::path& folder,
                             const SuiteFlights& flights) {
  RunCellsOptions options{
      .folder = folder, .jobs = flights.jobs, .threads = flights.threads, .quiet = flights.quiet};
  std::vector<Cell> without;
  std::ranges::copy_if(cells, std::back_inserter(without), [](const Cell& cell) {
    const PlannerConfig& planner = cell.resolved.planner;
    return planner.utility.name == kRouteName && planner.routes.views.empty();
  });
  options.run_arguments = {"--views", "-"};
  if (!without.empty()) run_cells(without, options);
  options.run_arguments.clear();
  return run_cells(cells, options);  // of which those are flown
}

std::vector<std::string> verify(const Submission& submission, const Suite& suite,
                                const fs::path& folder, const SuiteFlights& flights,
                                std::vector<fs::path>* runs) {
  need_of_suite(submission, suite);
  const SuiteTrack& track = suite.track(submission.track);
  const std::vector<SuiteTask> tasks = asked_tasks(suite, track.name, flights.only);
  if (fs::exists(folder / kCellsFolder)) {  // they would count as flown
    throw BadInput("{}: holds missions already: choose another -o", folder.string());
  }
  TaskScenarios scenarios(suite, folder / "meshes");
  std::vector<Cell> cells;
  for (const SuiteTask& task : tasks) {
    if (!task.is_frozen()) throw BadInput("{}, {}: not frozen yet", task.track, task.structure);
    cells.push_back(prepare(submission, suite, task, folder, scenarios));
  }
  const std::vector<CellOutcome> outcomes = fly(cells, folder, flights);
  std::vector<std::string> differences;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const std::string& task = tasks[i].structure;
    const SubmittedMission& said = *std::ranges::find(
        submission.missions, task, [](const auto& mission) { return mission.figures.task; });
    const FlownAgain compare{task, differences};
    if (outcomes[i].status == CellStatus::missing) throw CommandFailed("interrupted");
    if (outcomes[i].status != CellStatus::done) {  // a full disk, say: no word on the submission
      throw CommandFailed("{}: {}: could not be flown: {}", submission.file.string(), task,
                          outcomes[i].failure);
    }
    const fs::path& run = outcomes[i].run;
    if (runs != nullptr) runs->push_back(run);
    SubmittedMission now = mission_of_run(run, tasks[i], track, submission.kind);
    now.figures.plan_s = planning_s(folder / "records" / task);  // as stated
    compare("plan_s", now.figures.plan_s, said.figures.plan_s);
    compare_figures(now.figures, said.figures, compare);
    compare("trajectory_sha256", now.trajectory_sha256, said.trajectory_sha256);
    compare_records(run, submission, task, compare, folder / "records" / task);
  }
  return differences;
}

/// BadInput names the file of what lies in others meanwhile.
auto naming_file(const Submission& submission, const auto& does) {
  try {
    return does();
  } catch (const BadInput& error) {
    const std::string file = submission.file.string(), what = error.what();
    throw BadInput(what.starts_with(file) ? what : fmt::format("{}: {}", file, what));
  }
}

}  // namespace

void need_flyable(const Submission& submission, const Suite& suite) {
  naming_file(submission, [&] {
    need_of_suite(submission, suite);
    const ScratchFolder scratch;
    TaskScenarios scenarios(suite, scratch.path());
    const SuiteTask first = suite.tasks_of(submission.track).front();
    prepare(submission, suite, first, scratch.path(), scenarios);
  });
}

std::vector<std::string> verify_submission(const Submission& submission, const Suite& suite,
                                           const fs::path& folder, const SuiteFlights& flights,
                                           std::vector<fs::path>* runs) {
  return naming_file(submission, [&] { return verify(submission, suite, folder, flights, runs); });
}

}  // namespace gnbv
