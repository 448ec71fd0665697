#include "tools/sweep/run_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <deque>
#include <map>
#include <memory>
#include <thread>

#include "scenarios/load.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/mission/execute.hpp"
#include "tools/run/file_names.hpp"
#include "tools/terminal/interrupt.hpp"
#include "tools/terminal/progress.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr auto kPoll = std::chrono::milliseconds(10);
constexpr auto kLockedPoll = std::chrono::milliseconds(500);

/// Locks aside.
CellOutcome on_disk(const CellFiles& files) {
  std::error_code ignored;
  if (fs::exists(files.run, ignored)) return {CellStatus::done, files.run, ""};
  const std::optional<std::string> failure = failure_of(files.failed);
  return failure ? CellOutcome{CellStatus::failed, {}, *failure} : CellOutcome{};
}

// not its path: a program that is built anew meanwhile does not mix versions in a sweep
constexpr std::string_view kThisProgram = "/proc/self/exe";

/// Runs the distinct cells among those given, a few at a time.
class Pool {
 public:
  Pool(std::span<const Cell> cells, const RunCellsOptions& options)
      : cells_(cells),
        options_(options),
        program_(options.program.empty() ? fs::path(kThisProgram) : options.program),
        threads_(options.threads > 0 ? options.threads : shared_threads(options.jobs)),
        outcomes_(cells.size()),
        progress_("missions", options.quiet) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      std::vector<std::size_t>& same = of_id_[cells[i].id];
      if (same.empty()) waiting_.push_back(i);
      same.push_back(i);
    }
  }

  std::vector<CellOutcome> run() {
    const InterruptGuard interrupt(2);
    try {
      while (!is_over()) {
        pass_on_interrupts();
        start_waiting();
        reap();
        show_progress();
        if (!is_over()) std::this_thread::sleep_for(kPoll);
      }
    } catch (...) {  // a full disk
      end_missions();
      throw;
    }
    return std::move(outcomes_);
  }

 private:
  struct Running {
    std::size_t index = 0;
    CellFiles files;
    FileLock lock;
    std::vector<std::string> command;
    std::uintmax_t log_begin = 0;  // what is before it, another run printed
    std::unique_ptr<ChildProcess> child = nullptr;
  };

  static int shared_threads(int jobs) { return std::max(1, thread_count(0) / std::max(1, jobs)); }

  std::string name_of_program() const {
    return program_ == kThisProgram ? fs::read_symlink(program_).string() : program_.string();
  }

  bool is_over() const {
    return running_.empty() &&
           (InterruptGuard::requested() || (waiting_.empty() && locked_.empty()));
  }

  /// The first Ctrl-C asks the missions to end after the view at hand, the second one kills them.
  void pass_on_interrupts() {
    for (; passed_on_ < InterruptGuard::requests(); ++passed_on_) {
      for (const Running& one : running_) one.child->send(passed_on_ == 0 ? SIGINT : SIGKILL);
    }
  }

  /// Each may end its view; nobody is left behind.
  void end_missions() {
    for (const Running& one : running_) one.child->send(SIGINT);
    const Clock::time_point patience = Clock::now() + std::chrono::seconds(10);
    for (const Running& one : running_) {
      using std::chrono::milliseconds;
      const auto left = std::chrono::duration_cast<milliseconds>(patience - Clock::now());
      if (!one.child->ended_within(left)) one.child->send(SIGKILL);
    }
  }

  void start_waiting() {
    if (waiting_.empty() && Clock::now() > look_at_locked_) waiting_.swap(locked_);
    while (!waiting_.empty() && !InterruptGuard::requested() &&
           running_.size() < static_cast<std::size_t>(options_.jobs)) {
      const std::size_t index = waiting_.front();
      waiting_.pop_front();
      begin(index);
    }
  }

  void begin(std::size_t index) {
    const CellFiles files = cell_files(options_.folder, cells_[index].id);
    CellOutcome known = on_disk(files);
    if (is_settled(known)) return settle(index, known);
    std::optional<FileLock> lock = FileLock::take(files.lock);
    if (!lock) {
      if (!options_.wait_for_locked) return settle(index, {CellStatus::locked, {}, ""});
      locked_.push_back(index);
      look_at_locked_ = Clock::now() + kLockedPoll;
      return;
    }
    // whoever had the lock until now may have finished the cell
    known = on_disk(files);
    if (is_settled(known)) {
      if (known.status == CellStatus::done) fs::remove(files.lock);
      return settle(index, known);
    }
    if (fs::remove(files.failed)) fs::remove_all(files.part);
    const auto termination = termination_of(files.part);
    if (is_result(termination)) return settle(index, publish(files));
    start(index, files, std::move(*lock));
  }

  static bool is_result(const std::optional<std::string>& termination) {
    return termination && *termination != "interrupted" && *termination != "utility_failed";
  }

  /// Nothing is left to do for the cell.
  bool is_settled(const CellOutcome& outcome) const {
    return outcome.status == CellStatus::done ||
           (outcome.status == CellStatus::failed && !options_.retry_failed);
  }

  void start(std::size_t index, const CellFiles& files, FileLock lock) {
    fs::create_directories(files.part);
    fs::remove(files.part / kSummaryFile);  // of an interruption: the next one is of this run
    // the same cell may have been begun where its mesh had another path
    write_file_atomically(files.part / kScenarioFile, to_yaml(cells_[index].resolved));
    std::error_code no_log;
    const std::uintmax_t size = fs::file_size(files.log, no_log);
    Running one = {.index = index,
                   .files = files,
                   .lock = std::move(lock),
                   .command = {name_of_program(), "run", (files.part / kScenarioFile).string(),
                               "--out", files.part.string(), "--resume", "--quiet", "--threads",
                               fmt::format("{}", threads_)},
                   .log_begin = no_log ? 0 : size};
    one.command.insert(one.command.end(), options_.run_arguments.begin(),
                       options_.run_arguments.end());
    // the first Ctrl-C is passed on to it, as SIGINT; killed, we leave it to fly on
    one.child = std::make_unique<ChildProcess>(one.command,
                                               ChildOptions{.out = ChildStream::log,
                                                            .err = ChildStream::log,
                                                            .log = files.log,
                                                            .program = program_,
                                                            .dies_with_us = false,
                                                            .is_apart = true,
                                                            .kept_open = one.lock.descriptor()});
    if (one.child->start_error() != 0) {
      throw BadInput("{}, its output in {}: {}", one.command[0], files.log.string(),
                     one.child->end().text());
    }
    running_.push_back(std::move(one));
  }

  void reap() {
    for (std::size_t i = 0; i < running_.size();) {
      const std::optional<ChildEnd> end = running_[i].child->ended();
      if (!end) {
        ++i;
        continue;
      }
      Running one = std::move(running_[i]);
      running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
      flown_ += 1;
      settle(one.index, outcome_of(one, *end));
    }
  }

  CellOutcome outcome_of(const Running& one, const ChildEnd& end) {
    const auto termination = termination_of(one.files.part);
    if (is_result(termination)) return publish(one.files);
    if (termination == "utility_failed") {
      return failed(one, end);
    }
    if (termination || InterruptGuard::requested()) return {};  // a later call resumes it
    if (end.signal == SIGKILL) {
      // a scheduler that kills the job kills this process, too, and the cell has not failed
      std::this_thread::sleep_for(std::chrono::seconds(1));
      if (InterruptGuard::requested()) return {};
    }
    return failed(one, end);
  }

  CellOutcome failed(const Running& one, const ChildEnd& end) const {
    const Cell& cell = cells_[one.index];
    return {
        CellStatus::failed, {}, record_failure(cell, one.files, end, one.command, one.log_begin)};
  }

  static CellOutcome publish(const CellFiles& files) {
    std::error_code error;
    fs::rename(files.part, files.run, error);
    if (error && !fs::exists(files.run)) {
      throw BadInput("{}: cannot be renamed to {}: {}", files.part.string(), files.run.string(),
                     error.message());
    }
    // where locks do not reach (two machines, NFS without locks) another may have been first
    if (error) fs::remove_all(files.part);
    sync_to_disk(files.run.parent_path());
    // the cell is done: whoever still gets the lock sees that, so the file has served its purpose
    fs::remove(files.lock);
    return {CellStatus::done, files.run, ""};
  }

  void settle(std::size_t index, const CellOutcome& outcome) {
    if (outcome.status == CellStatus::missing) return;
    settled_ += 1;
    failed_ += outcome.status == CellStatus::failed ? 1 : 0;
    for (const std::size_t same : of_id_.at(cells_[index].id)) {
      outcomes_[same] = outcome;
      if (outcome.status == CellStatus::done && options_.on_done) options_.on_done(same, outcome);
    }
  }

  /// Cells that others flew are there at once: the pace is that of the ones flown here.
  void show_progress() {
    const std::size_t all = of_id_.size();
    const double spent_s = std::chrono::duration<double>(Clock::now() - begin_).count();
    const std::size_t left = all - settled_;
    progress_.show(
        static_cast<double>(settled_) / static_cast<double>(all),
        fmt::format("{}/{}, {} failed", settled_, all, failed_),
        seconds_left(spent_s, static_cast<double>(flown_) / static_cast<double>(flown_ + left)));
  }

  std::span<const Cell> cells_;
  const RunCellsOptions& options_;
  const fs::path program_;
  const int threads_;
  std::map<std::string, std::vector<std::size_t>> of_id_;  // which share an outcome
  std::vector<CellOutcome> outcomes_;
  std::deque<std::size_t> waiting_;
  std::deque<std::size_t> locked_;  // by other processes
  Clock::time_point look_at_locked_ = Clock::now();
  std::vector<Running> running_;
  int passed_on_ = 0;
  std::size_t settled_ = 0;
  std::size_t flown_ = 0;  // of those, by this call
  std::size_t failed_ = 0;
  const Clock::time_point begin_ = Clock::now();
  ProgressBar progress_;
};

}  // namespace

CellOutcome look_up(const fs::path& folder, const Cell& cell) {
  const CellFiles files = cell_files(folder, cell.id);
  const CellOutcome known = on_disk(files);
  if (known.status == CellStatus::done || !is_locked(files.lock)) return known;
  return {CellStatus::locked, {}, ""};
}

std::vector<CellOutcome> run_cells(std::span<const Cell> cells, const RunCellsOptions& options) {
  GNBV_CHECK(options.jobs > 0, "{} jobs", options.jobs);
  make_folder(options.folder / kCellsFolder);
  try {
    return Pool(cells, options).run();
  } catch (const fs::filesystem_error& failed) {
    refuse_to_write(failed.path1(), failed.code().value());
  }
}

}  // namespace gnbv
