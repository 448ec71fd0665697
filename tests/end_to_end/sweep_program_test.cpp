// `gnbv sweep` as its users meet it: exit codes, messages, and what it leaves behind.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sim/core/file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class SweepProgram : public testing::Test {
 protected:
  SweepProgram() {
    write("s.yaml",
          "scenarios: smoke\nutilities: [proposed, bircher]\nseeds: 2\n"
          "set: {planner.termination.max_iterations: 1}\n");
  }

  /// `gnbv sweep ARGUMENTS`, in which @ is the test's folder.
  Outcome sweep(std::string arguments) const {
    for (std::size_t at = arguments.find('@'); at != std::string::npos; at = arguments.find('@')) {
      arguments.replace(at, 1, temp_.path().string());
    }
    return gnbv("sweep " + arguments, "cd " + temp_.path().string() + " && ");
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(temp_.path() / name) << text;
  }
  std::string read(const std::string& name) const { return read_file(temp_.path() / name); }

  TempFolder temp_;
};

TEST_F(SweepProgram, FliesWhatIsMissingAndTabulatesAll) {
  const Outcome one = sweep("s.yaml --out o --index 1 --threads 1 2>/dev/null");
  ASSERT_EQ(one.exit_code, 0) << one.output;
  EXPECT_THAT(one.output, HasSubstr("smoke proposed seed 2: done: o/cells/"));

  const json before = json::parse(sweep("s.yaml --out o --status --json").output);
  ASSERT_EQ(before.size(), 4U);
  for (const json& cell : before) {
    EXPECT_EQ(cell.at("status"), cell.at("index") == 1 ? "done" : "missing");
  }
  const auto written = fs::last_write_time(temp_.path() / before[1].at("run").get<std::string>());

  const Outcome all = sweep("s.yaml --out o --jobs 2 --threads 1 2>/dev/null");
  ASSERT_EQ(all.exit_code, 0) << all.output;
  EXPECT_THAT(all.output, HasSubstr("results.csv"));
  EXPECT_EQ(fs::last_write_time(temp_.path() / before[1].at("run").get<std::string>()), written);

  // the table's rows are the cells in order, with the figures of their summaries
  std::istringstream csv(read("o/results.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_THAT(line, HasSubstr("index,id,scenario,method,seed,status,termination"));
  const json manifest = json::parse(read("o/sweep.json"));
  EXPECT_EQ(manifest.at("text"), read("s.yaml"));
  for (const json& cell : manifest.at("cells")) {
    std::getline(csv, line);
    const std::string id = cell.at("id");
    const json summary = json::parse(read("o/cells/" + id + "/summary.json"));
    EXPECT_THAT(line, HasSubstr(id + ",smoke," + cell.at("method").get<std::string>()));
    EXPECT_THAT(line, HasSubstr(summary.at("result_sha256").get<std::string>()));
    EXPECT_THAT(line, HasSubstr("," + summary.at("coverage").at("final").at("0.05").dump() + ","));
    EXPECT_EQ(summary.at("seed"), cell.at("seed"));
    EXPECT_EQ(summary.at("utility"), cell.at("method"));
  }
}

TEST_F(SweepProgram, WhateverItsRowsAreCalledItIsComparedAndDrawn) {
  write("named.yaml",
        "scenarios: {name: a/b, scenario: smoke}\nutilities: [proposed, bircher]\nseeds: 2\n"
        "set: {planner.termination.max_iterations: 1}\n");
  ASSERT_EQ(sweep("named.yaml --out o --jobs 2 --threads 1 2>/dev/null").exit_code, 0);
  const std::string folder = temp_.path().string();
  const Outcome compared =
      gnbv("compare --no-ceiling --from " + folder + "/o --plots " + folder + "/p");
  EXPECT_EQ(compared.exit_code, 0) << compared.output;
  EXPECT_THAT(compared.output, HasSubstr("a/b"));
  EXPECT_TRUE(fs::exists(temp_.path() / "p")) << compared.output;
}

TEST_F(SweepProgram, ExitsWith1WhenACellFailedAndSaysWhich) {
  write(
      "f.yaml",
      "scenarios:\n  - smoke\n  - {name: inside, scenario: smoke, set: {planner.validity.z_min_m: "
      "0, start: {position_m: [0, 0, 0.5], jitter_m: [0, 0, 0]}}}\n"
      "set: {planner.termination.max_iterations: 1}\n");
  const Outcome failed = sweep("f.yaml --out o --quiet --threads 1");
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_THAT(failed.output, HasSubstr("inside default seed 1: exit code 2: gnbv: start.position"));
  EXPECT_THAT(failed.output, HasSubstr("1 cells failed; --retry-failed"));
  EXPECT_THAT(read("o/results.csv"), HasSubstr(",inside,default,1,failed,,"));
  EXPECT_EQ(sweep("f.yaml --out o --index 1").exit_code, 1);
  EXPECT_EQ(sweep("f.yaml --out o --index 0").exit_code, 0);
}

TEST_F(SweepProgram, ListsWithoutAFolder) {
  const Outcome list = sweep("s.yaml --list --json");
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_EQ(json::parse(list.output).at(3).at("method"), "bircher");
  EXPECT_FALSE(fs::exists(temp_.path() / "o"));
}

TEST_F(SweepProgram, AnIndexMeansTheCellOfTheManifest) {
  ASSERT_EQ(sweep("s.yaml --out o --slurm-dry-run").exit_code, 0);
  write("s.yaml", read("s.yaml") + "grid: {planner.cloud.leaf_m: [0.05, 0.06]}\n");
  const Outcome other = sweep("s.yaml --out o --index 2");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.output, HasSubstr("s.yaml: cell 2 is not the one of o/sweep.json"));
  EXPECT_FALSE(fs::exists(temp_.path() / "o" / "cells"));
}

TEST_F(SweepProgram, AFolderBelongsToOneSweepFileUntilAnotherReplacesIt) {
  ASSERT_EQ(sweep("s.yaml --out o --slurm-dry-run").exit_code, 0);
  write("t.yaml", "scenarios: smoke\nset: {planner.termination.max_iterations: 1}\n");
  for (const std::string how : {"", " --status", " --slurm-dry-run"}) {
    const Outcome other = sweep("t.yaml --out o --quiet" + how);
    EXPECT_EQ(other.exit_code, 2) << how;
    EXPECT_THAT(other.output,
                HasSubstr("o/sweep.json: is of " + temp_.path().string() + "/s.yaml"));
    EXPECT_THAT(other.output, HasSubstr("not of " + temp_.path().string() + "/t.yaml; --replace"));
  }
  EXPECT_EQ(json::parse(read("o/sweep.json")).at("cells").size(), 4U);
  EXPECT_EQ(sweep("t.yaml --out o --quiet --threads 1 --replace").exit_code, 0);
  EXPECT_EQ(json::parse(read("o/sweep.json")).at("cells").size(), 1U);
  EXPECT_EQ(sweep("./t.yaml --out o --status").exit_code, 0);
}

TEST_F(SweepProgram, TheBatchScriptFliesEachCellInOneTask) {
  const Outcome dry = sweep(
      "s.yaml --out 'o p' --slurm-dry-run --threads 3 --slurm-limit 2 --slurm-args "
      "'--time=01:00:00 --partition=cpu'");
  ASSERT_EQ(dry.exit_code, 0) << dry.output;
  const std::string script = read("o p/sweep.sbatch");
  for (const std::string line :
       {"#SBATCH --array=0-3%2\n", "#SBATCH --cpus-per-task=3\n", "#SBATCH --requeue\n",
        "#SBATCH --time=01:00:00 --partition=cpu\n"}) {
    EXPECT_THAT(script, HasSubstr(line));
  }
  // the script itself, as Slurm would run its third task
  const std::string run = "cd / && SLURM_ARRAY_TASK_ID=2 bash '" + temp_.path().string() +
                          "/o p/sweep.sbatch' >/dev/null 2>&1";
  ASSERT_EQ(std::system(run.c_str()), 0);
  const json cells = json::parse(sweep("s.yaml --out 'o p' --status --json").output);
  for (const json& cell : cells) {
    EXPECT_EQ(cell.at("status"), cell.at("index") == 2 ? "done" : "missing");
  }
}

struct Refusal {
  const char* name;
  std::string arguments;
  std::string words;

  friend void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.name; }
};

class RefusedSweep : public SweepProgram, public testing::WithParamInterface<Refusal> {};

TEST_P(RefusedSweep, ExitsWith2NamesTheFaultAndLeavesNothing) {
  write("key.yaml", "scenarios: smoke\nset:\n  planner.utilty.name: isler\nseeds: 0\n");
  write("empty.yaml", "");
  write("none.yaml", "scenarios: []\n");
  const Outcome outcome = sweep(GetParam().arguments);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr(GetParam().words));
  EXPECT_FALSE(fs::exists(temp_.path() / "o"));
}

INSTANTIATE_TEST_SUITE_P(
    Sweep, RefusedSweep,
    testing::Values(
        Refusal{"NoFile", "absent.yaml --out o", "absent.yaml"},
        Refusal{"EmptyFile", "empty.yaml --out o", "empty.yaml:1: is empty"},
        Refusal{"NoScenarios", "none.yaml --out o", "none.yaml:1: scenarios: value '[]'"},
        Refusal{"MisspeltKey", "key.yaml --out o",
                "key.yaml:3: planner.utilty: is no known key (did you mean 'planner.utility'?)\n"
                "key.yaml:4: seeds: value '0': is out of range (allowed: from 1 to 1000000)"},
        Refusal{"NoFolder", "s.yaml", "--out"},
        Refusal{"StatusOfNothing", "s.yaml --out o --status", "o: no such folder"},
        Refusal{"IndexOutside", "s.yaml --out o --index 4", "the cells 0 to 3"},
        Refusal{"IndexOfNothing", "s.yaml --out o --index two", "K or K-L"},
        Refusal{"IndexBackwards", "s.yaml --out o --index 2-1", "K or K-L"},
        Refusal{"TwoActions", "s.yaml --out o --index 1 --list", "--list"},
        Refusal{"StatusAndSlurm", "s.yaml --out o --status --slurm", "--status"},
        Refusal{"StatusAndRetry", "s.yaml --out o --status --retry-failed", "--retry-failed"},
        Refusal{"SlurmAndJobs", "s.yaml --out o --slurm-dry-run --jobs 2", "--jobs"},
        Refusal{"LimitWithoutSlurm", "s.yaml --out o --slurm-limit 2", "--slurm-limit"},
        Refusal{"UnwritableFolder", "s.yaml --out s.yaml/o", "s.yaml/o"},
        Refusal{"NoJobs", "s.yaml --out o --jobs 0", "--jobs"}),
    [](const auto& refused) { return std::string(refused.param.name); });

}  // namespace
}  // namespace gnbv
