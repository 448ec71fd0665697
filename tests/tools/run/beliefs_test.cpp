// Laws of beliefs.jsonl: runs are what was listed, what was written is what is read, and a damaged
// file is refused by file and line.
#include <gtest/gtest.h>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/run/beliefs_jsonl.hpp"
#include "tools/run/file_names.hpp"

namespace gnbv {
namespace {

bool operator==(const BelievedVoxels& a, const BelievedVoxels& b) {
  return a.unknown == b.unknown && a.predicted == b.predicted && a.frontier == b.frontier &&
         a.looked_at == b.looked_at;
}

TEST(VoxelRuns, AreTheVoxelsThatWereListed) {
  const std::vector<VoxelIndex> voxels = {0, 1, 2, 7, 9, 10};
  const VoxelRuns runs = runs_of(voxels);
  EXPECT_EQ(runs, (VoxelRuns{{0, 3}, {7, 1}, {9, 2}}));
  EXPECT_EQ(voxel_count(runs), voxels.size());
  EXPECT_TRUE(runs_of(std::span<const VoxelIndex>()).empty());
}

class Beliefs : public testing::Test {
 protected:
  TempFolder temp_;
  const BelievedVoxels first_{.unknown = {{0, 5}, {7, 1}}, .predicted = {{4, 1}}};
  const BelievedVoxels last_{.unknown = {{3, 97}}, .frontier = {{1, 9}}, .looked_at = {{2, 2}}};

  void write_all() {
    BeliefsFile file(temp_.path(), 1);
    file.write(1, first_);
    file.write(3, last_);
    file.finish();
  }
  std::string complaint_about(const std::string& text) {
    write_file_atomically(temp_.path() / kBeliefsFile, text);
    try {
      read_beliefs(temp_.path(), 4, 100);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(Beliefs, AreReadAsTheyWereWritten) {
  EXPECT_TRUE(read_beliefs(temp_.path(), 4, 100).empty());  // kept none
  write_all();
  const std::vector<BelievedVoxels> read = read_beliefs(temp_.path(), 4, 100);
  ASSERT_EQ(read.size(), 4U);
  EXPECT_TRUE(read[1] == first_);
  EXPECT_TRUE(read[2] == BelievedVoxels{});
  EXPECT_TRUE(read[3] == last_);
  EXPECT_EQ(read_beliefs(temp_.path(), 2, 100).size(), 2U);  // of a run that was cut there
}

TEST_F(Beliefs, OfAnInterruptedRunGoOnWhereTheyEnd) {
  {
    BeliefsFile file(temp_.path(), 1);
    file.write(1, first_);
    file.write(2, last_);
    file.write(3, last_);
  }
  const auto part = part_of(temp_.path() / kBeliefsFile);
  write_file_atomically(part, read_file(part) + "{\"iterat");  // died while it wrote
  BeliefsFile file(temp_.path(), 2);
  file.write(3, last_);
  file.finish();
  const std::vector<BelievedVoxels> read = read_beliefs(temp_.path(), 4, 100);
  EXPECT_TRUE(read.at(1) == first_);
  EXPECT_TRUE(read.at(2) == BelievedVoxels{});
  EXPECT_TRUE(read.at(3) == last_);
  TempFolder older;  // an older program's run has no such file
  EXPECT_NO_THROW(BeliefsFile(older.path(), 5));
}

TEST_F(Beliefs, ThatAreDamagedAreNamedWithTheLine) {
  const std::string good = "{\"iteration\":1,\"unknown\":[0,5]}\n";
  EXPECT_EQ(complaint_about(good), "");
  for (const char* bad :
       {"{\"iteration\":2,\"unknown\":[0,101]}", "{\"iteration\":2,\"unknown\":[0,1,2]}",
        "{\"iteration\":2,\"unknown\":[3,0]}", "{\"iteration\":2,\"unknown\":[0,1,0,1]}",
        "{\"iteration\":2,\"unknown\":[-1,1]}", "{\"iteration\":2,\"unknown\":[0.5,1]}",
        "{\"iteration\":2,\"unknown\":{}}", "{\"iteration\":-1}", "{\"iteration\":2,",
        "{\"iteration\":2,\"frontier\":[99,18446744073709551615]}", "[]"}) {
    const std::string said = complaint_about(good + bad + "\n");
    EXPECT_NE(said.find("beliefs.jsonl:2: "), std::string::npos) << bad << ": " << said;
    EXPECT_NE(said.find("--candidates"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace gnbv
