// What is final has reached the disk: nothing is renamed before it is synced, and the summary,
// which says that a run is done, comes last. By the calls that the program makes (sync_log.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "sim/core/file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> calls_of(const fs::path& log, const std::string& command) {
  const std::string before =
      "LD_PRELOAD=" + std::string(GNBV_SYNC_LOG) + " SYNC_LOG=" + log.string() + " ";
  EXPECT_EQ(gnbv(command + " 2>/dev/null", before).exit_code, 0);
  std::istringstream lines(fs::exists(log) ? read_file(log) : "");
  std::vector<std::string> calls;
  for (std::string line; std::getline(lines, line);) calls.push_back(line);
  return calls;
}

TEST(Sync, ARunIsOnTheDiskBeforeItsSummarySaysSo) {
  const TempFolder temp;
  const fs::path run = fs::canonical(temp.path()) / "run";
  const auto calls = calls_of(temp.path() / "log",
                              "run smoke --quiet --frames --candidates --set "
                              "planner.termination.max_iterations=2 --out " +
                                  run.string());
  const auto place = [&](const std::string& call) {
    return std::find(calls.rbegin(), calls.rend(), call);  // the last one
  };
  const auto summary = place("rename " + (run / "summary.json").string());
  ASSERT_NE(summary, calls.rend());
  for (const auto& entry : fs::recursive_directory_iterator(run)) {
    if (!entry.is_regular_file()) continue;
    const std::string name = entry.path().filename();
    if (name == "summary.json") continue;
    // under its own name, or as the temporary file just before it got that name
    const auto own = place("sync " + entry.path().string());
    const auto renamed = place("rename " + entry.path().string());
    const bool is_synced_later = own != calls.rend() && own > summary;
    const bool is_synced_before =
        renamed != calls.rend() && renamed > summary && (renamed + 1) != calls.rend() &&
        (renamed + 1)->find("sync ") == 0 && (renamed + 1)->find(".part") != std::string::npos;
    EXPECT_TRUE(is_synced_later || is_synced_before) << entry.path();
  }
  EXPECT_LT(place("sync " + run.string()), summary) << "the folder after the last name in it";
  const auto journal_gone = place("remove " + (run / "iterations.csv.part").string());
  ASSERT_NE(journal_gone, calls.rend());
  EXPECT_GT(journal_gone, summary) << "a kill between them would leave it beside a finished run";
}

TEST(Sync, ACellIsDoneWhenItsFolderKnowsIt) {
  const TempFolder temp;
  const fs::path folder = fs::canonical(temp.path());
  write_file_atomically(folder / "s.yaml",
                        "scenarios: smoke\nutilities: [proposed]\nseeds: 1\n"
                        "set: {planner.termination.max_iterations: 1}\n");
  const auto calls = calls_of(folder / "log", "sweep " + (folder / "s.yaml").string() +
                                                  " --quiet --out " + (folder / "out").string());
  const auto published = std::find_if(calls.begin(), calls.end(), [&](const std::string& call) {
    return call.starts_with("rename " + (folder / "out/cells").string()) &&
           fs::path(call).parent_path().filename() == "cells";
  });
  ASSERT_NE(published, calls.end());
  EXPECT_NE(std::find(published, calls.end(), "sync " + (folder / "out/cells").string()),
            calls.end());
}

}  // namespace
}  // namespace gnbv
