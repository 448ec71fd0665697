// Missions after each other in one process: nothing of one is left when the next begins.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <vector>

#include "tests/support/flown.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/mission/execute.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// tools/attack long-haul flies more.
int missions_to_fly() {
  const char* const asked = std::getenv("GNBV_MISSIONS");
  return asked == nullptr ? 9 : std::max(9, std::atoi(asked));
}

double resident_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kib = 0.0;
    if (word == "VmRSS:" && status >> kib) return kib / 1024.0;
  }
  return 0.0;
}

std::ptrdiff_t entries_of(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), {});
}

TEST(LongHaul, MemoryDescriptorsAndFilesStayFlat) {
  setenv("GNBV_CACHE", "", 1);
  const TempFolder temp;
  const fs::path temporary = temp.path() / "tmp";
  fs::create_directory(temporary);
  setenv("TMPDIR", temporary.c_str(), 1);
  const int missions = missions_to_fly();
  std::vector<double> memory_mb;
  std::vector<std::ptrdiff_t> descriptors;
  for (int i = 0; i < missions; ++i) {
    const fs::path run = temp.path() / "run";
    const Scenario scenario =
        smoke({fmt::format("seed={}", i + 1), "planner.termination.max_iterations=6"});
    execute_mission(scenario, {.out = run, .threads = 2, .quiet = true});
    ASSERT_TRUE(fs::exists(run / "summary.json"));
    fs::remove_all(run);
    EXPECT_EQ(entries_of(temporary), 0);
    EXPECT_EQ(entries_of(temp.path()), 1);
    memory_mb.push_back(resident_mb());
    descriptors.push_back(entries_of("/proc/self/fd"));
  }
  unsetenv("TMPDIR");
  // the first third fills pools and caches of the libraries
  const auto third = memory_mb.begin() + missions / 3;
  const double before_mb = *std::max_element(memory_mb.begin(), third);
  fmt::print("missions {}: {:.1f} MB after the first third, {:.1f} MB at the end, {} descriptors\n",
             missions, before_mb, memory_mb.back(), descriptors.back());
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they keep what was freed
  EXPECT_LT(memory_mb.back(), before_mb + 8.0);  // a mission's map and scene alone are more
#endif
  EXPECT_EQ(descriptors.back(), descriptors.front());
}

}  // namespace
}  // namespace gnbv
