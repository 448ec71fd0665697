// What a sweep says to Slurm, and hears from it.
#include "tools/sweep/slurm.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(BatchScript, ItsTasksFlyEveryCellOnceAndAreNoMoreThanAllowed) {
  TempFolder temp;
  for (const auto& [cells, allowed] :
       {std::pair<std::size_t, std::size_t>{1, 1001}, {6, 6}, {7, 6}, {12, 6}, {13, 6}, {5, 1}}) {
    const SlurmOptions options{.program = "/bin/echo",
                               .sweep_file = temp.path() / "it's.yaml",
                               .folder = temp.path(),
                               .cells = cells};
    const fs::path script = temp.write("s.sbatch", batch_script(options, allowed));
    const std::string text = read_file(script);
    const std::size_t tasks = std::stoul(text.substr(text.find("--array=0-") + 10)) + 1;
    EXPECT_LE(tasks, allowed);
    std::size_t next = 0;
    for (std::size_t task = 0; task < tasks; ++task) {
      const fs::path out = temp.path() / "out";
      const std::string run = fmt::format("SLURM_ARRAY_TASK_ID={} bash '{}' | tail -1 > '{}'", task,
                                          script.string(), out.string());
      ASSERT_EQ(std::system(run.c_str()), 0);
      const std::string echoed = read_file(out);
      const std::string range = echoed.substr(echoed.find("--index ") + 8);
      EXPECT_EQ(std::stoul(range), next) << cells << " " << allowed;
      next = std::stoul(range.substr(range.find('-') + 1)) + 1;
    }
    EXPECT_EQ(next, cells);
  }
}

TEST(BatchScript, WhatSbatchWarnsOfIsNoPartOfTheId) {
  TempFolder temp;
  const auto sbatch_that = [&](const std::string& does) {
    fs::permissions(temp.write("sbatch", "#!/bin/sh\n" + does + "\n"), fs::perms::owner_all);
  };
  const std::string path = std::getenv("PATH");
  setenv("PATH", (temp.path().string() + ":" + path).c_str(), 1);
  sbatch_that("echo careful >&2; echo 42");
  testing::internal::CaptureStderr();
  EXPECT_EQ(submit(temp.path() / "it's.sbatch"), "42");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "careful\n");
  sbatch_that("echo 'no such partition' >&2; exit 1");
  EXPECT_THAT(test::fault_of([&] { submit(temp.path() / "it's.sbatch"); }),
              HasSubstr("it's.sbatch: no such partition"));
  setenv("PATH", path.c_str(), 1);
  EXPECT_FALSE(fs::exists(temp.path() / "it's.sbatch.stderr"));
}

TEST(BatchScript, WhatTakesTwoLinesIsRefused) {
  EXPECT_THROW(batch_script({.folder = "o", .cells = 1, .arguments = "a\nb"}, 10), BadInput);
  EXPECT_THROW(batch_script({.folder = "a\nb", .cells = 1}, 10), BadInput);
}

}  // namespace
}  // namespace gnbv
