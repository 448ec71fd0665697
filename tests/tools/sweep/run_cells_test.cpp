// A sweep's missions: each flown once, whatever happens to the processes.
#include "tools/sweep/run_cells.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

Sweep smoke_sweep(int views, std::vector<std::uint64_t> seeds) {
  const Override few{fmt::format("planner.termination.max_iterations={}", views)};
  return {.scenarios = {{.name = "smoke", .scenario = "smoke", .overrides = {few}}},
          .methods = {{.name = "proposed"}},
          .seeds = std::move(seeds)};
}

class RunCells : public testing::Test {
 protected:
  RunCellsOptions options(int jobs = 2) const {
    return {.folder = folder(), .jobs = jobs, .threads = 1, .quiet = true, .program = GNBV_PROGRAM};
  }
  fs::path folder() const { return temp_.path() / "sweep"; }

  static std::string sha(const fs::path& run) {
    return nlohmann::json::parse(read_file(run / "summary.json")).at("result_sha256");
  }

  /// A program of these lines of shell.
  fs::path script(const std::string& lines) const {
    const fs::path path = temp_.write("script", "#!/bin/sh\n" + lines + "\n");
    fs::permissions(path, fs::perms::owner_all);
    return path;
  }

  /// A program that notes its arguments and then flies, and how often it was given that word.
  fs::path noting_program() const {
    return script("echo \"$@\" >> " + (temp_.path() / "flown").string() +
                  "\nexec " GNBV_PROGRAM " \"$@\"");
  }
  std::size_t flights(const std::string& word) const {
    std::ifstream file(temp_.path() / "flown");
    std::size_t count = 0;
    for (std::string line; std::getline(file, line);) count += line.find(word) != std::string::npos;
    return count;
  }

  TempFolder temp_;
};

TEST_F(RunCells, CellsOfTheSameContentAreFlownOnce) {
  Sweep sweep = smoke_sweep(1, {1});
  sweep.methods.push_back({.name = "the same", .overrides = {{"planner.utility.name=proposed"}}});
  const std::vector<Cell> cells = cells_of(sweep);
  ASSERT_EQ(cells[0].id, cells[1].id);
  RunCellsOptions all = options();
  all.program = noting_program();
  const std::vector<CellOutcome> outcomes = run_cells(cells, all);
  EXPECT_EQ(outcomes[0].run, outcomes[1].run);
  EXPECT_EQ(outcomes[1].status, CellStatus::done);
  EXPECT_EQ(flights("scenario.yaml"), 1U);
}

TEST_F(RunCells, AKilledMissionIsRecordedWithItsSignal) {
  const std::vector<Cell> cells = cells_of(smoke_sweep(1, {1}));
  RunCellsOptions all = options();
  all.program = script("echo last words >&2\nkill -SEGV $$");
  EXPECT_EQ(run_cells(cells, all)[0].failure,
            "killed by signal 11 (Segmentation fault): last words");
}

TEST_F(RunCells, ALockedCellIsSkippedOrWaitedFor) {
  const std::vector<Cell> cells = cells_of(smoke_sweep(1, {1, 2}));
  const fs::path lock = cell_files(folder(), cells[0].id).lock;
  fs::create_directories(lock.parent_path());
  std::optional<FileLock> held = FileLock::take(lock);
  ASSERT_TRUE(held.has_value());
  RunCellsOptions all = options();
  all.wait_for_locked = false;
  std::vector<CellOutcome> outcomes = run_cells(cells, all);
  EXPECT_EQ(outcomes[0].status, CellStatus::locked);
  EXPECT_EQ(outcomes[1].status, CellStatus::done);
  EXPECT_EQ(look_up(folder(), cells[0]).status, CellStatus::locked);
  std::thread release([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    held.reset();
  });
  all.wait_for_locked = true;
  outcomes = run_cells(cells, all);
  release.join();
  EXPECT_EQ(outcomes[0].status, CellStatus::done);
}

/// A process that runs the cells and ends with the number of those that are not done.
pid_t sweep_process(const std::vector<Cell>& cells, const RunCellsOptions& options) {
  const pid_t child = fork();
  if (child != 0) return child;
  int missing = 0;
  for (const CellOutcome& outcome : run_cells(cells, options)) {
    missing += outcome.status == CellStatus::done ? 0 : 1;
  }
  _exit(missing);
}

int end_of(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

TEST_F(RunCells, TwoSweepsAtOnceFlyEachCellOnce) {
  const std::vector<Cell> cells = cells_of(smoke_sweep(1, {1, 2, 3, 4, 5, 6}));
  RunCellsOptions all = options(2);
  all.program = noting_program();
  const pid_t a = sweep_process(cells, all);
  const pid_t b = sweep_process(cells, all);
  EXPECT_EQ(end_of(a), 0);
  EXPECT_EQ(end_of(b), 0);
  for (const Cell& cell : cells) {
    EXPECT_EQ(flights(cell.id + ".part/scenario.yaml"), 1U);
    const CellFiles files = cell_files(folder(), cell.id);
    EXPECT_TRUE(fs::exists(files.run / "summary.json"));
    EXPECT_FALSE(fs::exists(files.part));
    EXPECT_FALSE(fs::exists(files.lock));
  }
}

class Stopped : public RunCells {
 protected:
  /// Waits until the cell's mission has flown some views.
  void await_views(const Cell& cell) const {
    const fs::path journal = cell_files(folder(), cell.id).part / "iterations.csv.part";
    for (int i = 0; i < 2000; ++i) {
      std::ifstream file(journal);
      int lines = 0;
      for (std::string line; std::getline(file, line);) lines += 1;
      if (lines > 3) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    FAIL() << "no views in " << journal;
  }

  /// What an undisturbed run of the cell comes to.
  std::string undisturbed_sha(const std::vector<Cell>& cells) const {
    RunCellsOptions all = options();
    all.folder = temp_.path() / "undisturbed";
    return sha(run_cells(cells, all)[0].run);
  }
};

TEST_F(Stopped, AKilledSweepGoesOnToTheSameResult) {
  const std::vector<Cell> cells = cells_of(smoke_sweep(30, {1}));
  RunCellsOptions all = options();
  all.program =
      script("echo $$ > " + (temp_.path() / "pid").string() + "\nexec " GNBV_PROGRAM " \"$@\"");
  const pid_t sweep = sweep_process(cells, all);
  await_views(cells[0]);
  kill(sweep, SIGKILL);
  EXPECT_EQ(end_of(sweep), -SIGKILL);
  // the mission lives on and keeps its cell
  EXPECT_EQ(look_up(folder(), cells[0]).status, CellStatus::locked);
  pid_t mission = 0;
  std::ifstream(temp_.path() / "pid") >> mission;
  ASSERT_GT(mission, 1);
  kill(mission, SIGKILL);
  const CellFiles files = cell_files(folder(), cells[0].id);
  EXPECT_TRUE(fs::exists(files.part / "iterations.csv.part"));
  EXPECT_FALSE(fs::exists(files.run));
  EXPECT_EQ(run_cells(cells, options())[0].status, CellStatus::done);
  EXPECT_EQ(sha(files.run), undisturbed_sha(cells));
}

TEST_F(Stopped, AnInterruptedSweepLeavesWhatALaterOneResumes) {
  const std::vector<Cell> cells = cells_of(smoke_sweep(30, {1, 2, 3}));
  const pid_t sweep = sweep_process(cells, options(1));
  await_views(cells[0]);
  kill(sweep, SIGTERM);
  EXPECT_EQ(end_of(sweep), 3);
  const CellFiles files = cell_files(folder(), cells[0].id);
  EXPECT_EQ(termination_of(files.part), "interrupted");
  EXPECT_FALSE(fs::exists(files.failed));
  EXPECT_EQ(look_up(folder(), cells[0]).status, CellStatus::missing);
  EXPECT_EQ(run_cells({cells.data(), 1}, options())[0].status, CellStatus::done);
  EXPECT_EQ(sha(files.run), undisturbed_sha({cells[0]}));
}

TEST_F(Stopped, TwoSignalsKillAndRecordNoFailure) {
  const std::vector<Cell> cells = cells_of(smoke_sweep(1, {1}));
  RunCellsOptions all = options();
  all.program =
      script("trap '' INT TERM\ntouch " + (temp_.path() / "up").string() + "\nwhile :; do :; done");
  const pid_t sweep = sweep_process(cells, all);
  for (int i = 0; i < 2000 && !fs::exists(temp_.path() / "up"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_TRUE(fs::exists(temp_.path() / "up")) << "no mission began";
  kill(sweep, SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(waitpid(sweep, nullptr, WNOHANG), 0) << "the first one only asks";
  kill(sweep, SIGINT);
  EXPECT_EQ(end_of(sweep), 1);
  EXPECT_EQ(look_up(folder(), cells[0]).status, CellStatus::missing);
}

TEST_F(RunCells, AMissionThatEndedWithoutItsSweepIsDoneWithoutFlyingAgain) {
  const std::vector<Cell> cells = cells_of(smoke_sweep(1, {1}));
  ASSERT_EQ(run_cells(cells, options())[0].status, CellStatus::done);
  const CellFiles files = cell_files(folder(), cells[0].id);
  fs::rename(files.run, files.part);  // as a killed sweep leaves it when its mission ended later
  RunCellsOptions all = options();
  all.program = "/bin/false";
  EXPECT_EQ(run_cells(cells, all)[0].status, CellStatus::done);
}

TEST_F(RunCells, AProgramThatIsNotThereIsBadInput) {
  RunCellsOptions all = options();
  all.program = temp_.path() / "none";
  EXPECT_THROW(run_cells(cells_of(smoke_sweep(1, {1})), all), BadInput);
}

}  // namespace
}  // namespace gnbv
