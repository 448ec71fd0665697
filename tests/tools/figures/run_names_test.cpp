// Laws of the names of runs: one each, however the paths are written.
#include "tools/run/run_names.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnbv {
namespace {

using Names = std::vector<std::string>;

Names names_of(const std::vector<std::filesystem::path>& folders) { return run_names(folders); }

TEST(RunNames, AreThoseOfTheFoldersHoweverTheirPathsAreWritten) {
  EXPECT_EQ(names_of({"x/run", "x/other/", "x/./third/../fourth//"}),
            (Names{"run", "other", "fourth"}));
  const std::string here = std::filesystem::current_path().filename();
  EXPECT_EQ(names_of({"."}), Names{here});
}

TEST(RunNames, AreUnique) {
  EXPECT_EQ(names_of({"x/run", "y/run", "z/run/"}), (Names{"run", "run-2", "run-3"}));
  // a name that another one's number made
  Names names = names_of({"x/run", "y/run", "x/run-2"});
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
  EXPECT_TRUE(names_of({}).empty());
}

}  // namespace
}  // namespace gnbv
