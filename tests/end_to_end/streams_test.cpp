// A mission flies to its end whoever listens, and what cannot be kept is said.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "sim/core/file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

const std::string kMission = "run smoke --set planner.termination.max_iterations=2 --out ";

TEST(Streams, NoMessageEndsAMission) {
  TempFolder temp;
  int n = 0;
  for (const std::string stderr_to : {"2>/dev/full", "2>&-", "2>&- <&-"}) {
    const fs::path run = temp.path() / std::to_string(n++);
    EXPECT_EQ(gnbv(kMission + run.string() + " >/dev/null " + stderr_to).exit_code, 0) << stderr_to;
    EXPECT_TRUE(fs::exists(run / "summary.json")) << stderr_to;
  }
  const fs::path run = temp.path() / "pipe";
  shell("{ " + std::string(GNBV_PROGRAM) + " " + kMission + run.string() +
        " 2>&1 >/dev/null; echo $? >" + (temp.path() / "code").string() + "; } | true");
  EXPECT_EQ(read_file(temp.path() / "code"), "0\n");
}

TEST(Streams, NoFileGetsTheNumberOfAClosedOne) {
  TempFolder temp;
  const fs::path run = temp.path() / "run";
  EXPECT_EQ(gnbv(kMission + run.string() + " <&- >/dev/null 2>&-").exit_code, 0);
  for (const auto& entry : fs::directory_iterator(run)) {
    EXPECT_EQ(read_file(entry.path()).find("smoke proposed"), std::string::npos) << entry.path();
  }
}

TEST(Streams, WhatStdoutLosesIsExitCode1AndItsCauseIsNamed) {
  for (const std::string words : {"schema", "--version", "--help", "asset --list"}) {
    const Outcome full = gnbv(words + " 2>&1 >/dev/full");
    EXPECT_EQ(full.exit_code, 1) << words;
    EXPECT_EQ(full.output, "gnbv: stdout: cannot write: No space left on device\n") << words;
    EXPECT_EQ(gnbv(words + " 2>&1 >&-").exit_code, 1) << words;
  }
}

TEST(Streams, AFileThatDoesNotFitIsExitCode1) {
  TempFolder temp;
  const Outcome full =
      gnbv(kMission + (temp.path() / "run").string() + " --quiet", "ulimit -f 16 && ");
  EXPECT_EQ(full.exit_code, 1) << full.output;
  EXPECT_TRUE(has(full, "cannot write: File too large")) << full.output;
  EXPECT_FALSE(fs::exists(temp.path() / "run/summary.json"));
}

TEST(Streams, ControlBytesOfAFileAreShownNotObeyed) {
  TempFolder temp;
  write_file_atomically(temp.path() / "a.yaml", "\"pl\\e[31maner\": 3\n");
  const Outcome refused = gnbv("run " + (temp.path() / "a.yaml").string());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.output.find('\x1b'), std::string::npos) << refused.output;
}

TEST(Environment, AnUnknownInstructionSetIsRefused) {
  const Outcome refused = gnbv("schema", "GNBV_SIMD=foo ");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(has(refused, "GNBV_SIMD=foo")) << refused.output;
  EXPECT_EQ(gnbv("schema >/dev/null", "GNBV_SIMD=avx2 ").exit_code, 0);
}

TEST(Environment, TooLittleMemoryIsSaidInTheseWords) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers reserve terabytes";
#endif
  TempFolder temp;
  const std::string run = (temp.path() / "run").string();
  ASSERT_EQ(gnbv(kMission + run + " --quiet").exit_code, 0);
  const std::string pictures = (temp.path() / "pictures").string();
  int refused = 0;
  // from what the program needs to begin with, to where each command has just enough
  for (const int kib : {200'000, 300'000, 450'000, 600'000, 750'000, 900'000}) {
    const std::string limit = "ulimit -v " + std::to_string(kib) + " && ";
    for (const std::string& words :
         {"render " + run + " --what path -o " + pictures,
          kMission + (temp.path() / std::to_string(kib)).string() + " --quiet"}) {
      const Outcome outcome = gnbv(words, limit);
      if (outcome.exit_code == 0) continue;
      ++refused;
      EXPECT_EQ(outcome.exit_code, 1) << kib << " kB: " << words;
      EXPECT_TRUE(has(outcome, "gnbv: out of memory\n")) << kib << " kB: " << outcome.output;
    }
  }
  EXPECT_GE(refused, 2);  // the least is too little for each
}

TEST(Environment, WithoutThreadsTheSystemIsBlamed) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root, to be a user who has no process yet";
  TempFolder temp;
  fs::permissions(temp.path(), fs::perms::all);
  const fs::path run = temp.path() / "run";
  ASSERT_EQ(gnbv(kMission + run.string() + " --quiet").exit_code, 0);
  // whoever has this number runs nothing else here; one process is one thread
  const std::string other = "timeout 60 setpriv --reuid=64999 --clear-groups ";
  if (gnbv("--version", other).exit_code != 0) GTEST_SKIP() << "another user cannot run gnbv here";
  const std::string alone = other + "prlimit --nproc=1 ";
  for (const std::string& words :
       {"render " + run.string() + " --what path -o " + (temp.path() / "p.png").string(),
        kMission + (temp.path() / "alone").string() + " --threads 2"}) {
    const Outcome refused = gnbv(words, alone);
    EXPECT_EQ(refused.exit_code, 1) << words << ": " << refused.output;
    EXPECT_TRUE(has(refused, "Resource temporarily unavailable")) << words << refused.output;
  }
}

TEST(Signals, AnIgnoredHangUpStaysIgnoredAndATermEndsInOrder) {
  TempFolder temp;
  const std::string run = "run smoke --quiet --set planner.termination.max_iterations=60 --out ";
  // when the journal has begun
  const auto send = [&](const fs::path& folder, const std::string& signal) {
    return " >/dev/null & p=$!; n=0; while [ ! -s " + (folder / "iterations.csv.part").string() +
           " ] && [ $n -lt 1000 ]; do sleep 0.01; n=$((n+1)); done; kill -" + signal +
           " $p; wait $p";
  };
  const fs::path ignored = temp.path() / "ignored";
  EXPECT_EQ(
      gnbv(run + ignored.string() + " 2>&1" + send(ignored, "HUP"), "trap '' HUP; ").exit_code, 0);
  const fs::path ended = temp.path() / "ended";
  EXPECT_EQ(gnbv(run + ended.string() + " 2>&1" + send(ended, "HUP")).exit_code, 1);
  EXPECT_NE(read_file(ended / "summary.json").find("\"interrupted\""), std::string::npos);
}

}  // namespace
}  // namespace gnbv
