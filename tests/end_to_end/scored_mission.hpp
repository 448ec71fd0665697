// One finished smoke mission for all tests of scores and gates.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/core/file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv::test {

/// The tests copy it; the cache of all of them is beside it.
class Score : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ =
        std::filesystem::temp_directory_path() / ("gnbv_score_test_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    setenv("GNBV_CACHE", (folder_ / "cache").c_str(), 1);
    flown_ = gnbv("run smoke --quiet --out " + (folder_ / "run").string());
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder_); }
  void SetUp() override { ASSERT_EQ(flown_.exit_code, 0) << flown_.output; }

  static std::filesystem::path original() { return folder_ / "run"; }
  std::filesystem::path copy() const {
    std::filesystem::copy(original(), temp_.path() / "run",
                          std::filesystem::copy_options::recursive);
    return temp_.path() / "run";
  }
  static nlohmann::ordered_json summary_of(const std::filesystem::path& run) {
    return nlohmann::ordered_json::parse(read_file(run / "summary.json"));
  }

  static inline std::filesystem::path folder_;
  static inline Outcome flown_;
  TempFolder temp_;
};

}  // namespace gnbv::test
