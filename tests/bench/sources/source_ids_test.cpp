// The name of what a program is made of.
#include "bench/sources/source_ids.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "sim/core/file.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// What source_id.cmake makes of two sources built in some way.
std::string id_from(const fs::path& root, const std::string& build) {
  std::ofstream(root / "list.txt") << "b.cpp\na.cpp\n";
  const std::string command = fmt::format(
      "cmake -DROOT='{0}' -DSOURCES='{0}/list.txt' -DBUILD='{1}' -DFUNCTION=f -DOUTPUT='{0}/id' -P "
      "{2}",
      root.string(), build, GNBV_SOURCE_ID_SCRIPT);
  EXPECT_EQ(std::system(command.c_str()), 0);
  return read_file(root / "id");
}

TEST(SourceId, IsThatOfNamesContentsAndBuild) {
  TempFolder temp;
  std::ofstream(temp.path() / "a.cpp") << "one";
  std::ofstream(temp.path() / "b.cpp") << "two";
  const std::string first = id_from(temp.path(), "g++ 12, flags -O3");
  EXPECT_EQ(id_from(temp.path(), "g++ 12, flags -O3"), first);
  EXPECT_NE(id_from(temp.path(), "g++ 12, flags -O2"), first);
  std::ofstream(temp.path() / "b.cpp") << "twO";
  EXPECT_NE(id_from(temp.path(), "g++ 12, flags -O3"), first);
  std::ofstream(temp.path() / "a.cpp") << "two";
  std::ofstream(temp.path() / "b.cpp") << "one";
  EXPECT_NE(id_from(temp.path(), "g++ 12, flags -O3"), first);
  for (const std::string& id : {flying_source_id(), scoring_source_id()}) EXPECT_EQ(id.size(), 64U);
  EXPECT_NE(flying_source_id(), scoring_source_id());
}

}  // namespace
}  // namespace gnbv
