#include "planner/map/octomap_io.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <fstream>

#include "bench/reference/octomap_twin.hpp"
#include "planner/map/scan_insertion.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tests/planner/map/drawn_map.hpp"
#include "tests/planner/map/random_points.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

class OctomapFiles : public ::testing::Test {
 protected:
  OctomapFiles() : grid_(OccupancyConfig{}, Box3(Vec3(-3, -2, 0), Vec3(3, 2, 2))) {
    Random random(53);
    for (int scan = 0; scan < 12; ++scan) {
      const Vec3f origin_m = random.point_in(Box3(Vec3(-2, -1, 0.5), Vec3(2, 1, 1.5)));
      std::vector<ScanRay> rays;
      for (int i = 0; i < 500; ++i) {
        rays.push_back({random.point_in(Box3(Vec3(-3, -2, 0), Vec3(3, 2, 2))), random.chance(0.5)});
      }
      grid_.apply(FanWalker(grid_.geometry()).compute_update(origin_m, rays));
    }
  }
  TempFolder temp_;
  const std::filesystem::path& folder_ = temp_.path();
  OccupancyGrid grid_;
};

// OctoMap's own reader and ours read back what was written, in silence.
TEST_F(OctomapFiles, HoldEveryLogOddsBitForBitAndNothingElse) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  write_octomap(grid_, folder_ / "map.v1");  // a stem with a dot keeps it
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 2);
  const OctomapTwin ot = OctomapTwin::read(folder_ / "map.v1.ot");
  const OctomapTwin bt = OctomapTwin::read(folder_ / "map.v1.bt");
  EXPECT_EQ(ot.resolution_m(), 0.2);
  std::size_t measured = 0;
  for (VoxelIndex v = 0; v < grid_.geometry().voxel_count(); ++v) {
    const Key key = grid_.geometry().key_at(v);
    const std::optional<float> log_odds = ot.log_odds(key);
    const std::optional<bool> is_occupied = bt.is_occupied(key);
    ASSERT_EQ(log_odds.has_value(), grid_.is_measured(v));
    ASSERT_EQ(is_occupied.has_value(), grid_.is_measured(v));
    if (!log_odds) continue;
    ++measured;
    ASSERT_EQ(std::bit_cast<std::uint32_t>(*log_odds),
              std::bit_cast<std::uint32_t>(grid_.log_odds(v)));
    ASSERT_EQ(*is_occupied, grid_.state(v) == VoxelState::occupied);
  }
  EXPECT_EQ(ot.voxel_count(), measured);
  EXPECT_EQ(bt.voxel_count(), measured);
  const OctomapLeaves read = read_octomap(folder_ / "map.v1.ot");
  EXPECT_EQ(read.voxel_m, 0.2);
  for (const OctomapLeaf& leaf : read.leaves) {
    const int edge = leaf.edge_voxels;
    for (int i = 0; i < edge * edge * edge; ++i, --measured) {
      const Key key = {leaf.first[0] + i % edge, leaf.first[1] + i / edge % edge,
                       leaf.first[2] + i / edge / edge};
      const VoxelIndex v = grid_.geometry().index_of(key);
      ASSERT_EQ(grid_.log_odds(v), leaf.log_odds);
      EXPECT_EQ(gnbv::is_occupied(leaf, grid_.config()), grid_.state(v) == VoxelState::occupied);
    }
  }
  EXPECT_EQ(measured, 0U);
}

TEST_F(OctomapFiles, OfAMapThatNothingTouchedAreValidAndEmpty) {
  write_octomap(OccupancyGrid(OccupancyConfig{}, Box3(Vec3(0, 0, 0), Vec3(1, 1, 1))),
                folder_ / "empty");
  EXPECT_EQ(OctomapTwin::read(folder_ / "empty.ot").node_count(), 0U);
  EXPECT_EQ(OctomapTwin::read(folder_ / "empty.bt").node_count(), 0U);
  EXPECT_TRUE(read_octomap(folder_ / "empty.ot").leaves.empty());
}

TEST_F(OctomapFiles, EqualVoxelsArePrunedToOneNode) {
  OccupancyGrid block(OccupancyConfig{}, Box3(Vec3(-1, -1, 0), Vec3(7, 7, 7)));
  struct Case {
    std::int32_t side;
    std::size_t nodes;  // one leaf, that many levels below the root
  };
  for (const auto& [side, nodes] : {Case{8, 14}, Case{32, 12}}) {
    const Box3 cube_m(Vec3::Zero(), Vec3::Constant(0.2 * side));
    ScanUpdate update;
    update.free = voxels_where(block, [&](const Vec3& p_m) { return cube_m.contains(p_m); });
    std::erase_if(update.free, [&](VoxelIndex v) { return block.is_measured(v); });
    block.apply(update);
    for (const char* extension : {".ot", ".bt"}) {
      write_octomap(block, folder_ / "block");
      const OctomapTwin read = OctomapTwin::read((folder_ / "block").string() + extension);
      EXPECT_EQ(read.voxel_count(), static_cast<std::size_t>(side * side * side));
      EXPECT_EQ(read.node_count(), nodes);
    }
  }
}

std::size_t most_resident_kib() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != "VmHWM:") continue;
    std::size_t kib = 0;
    status >> kib;
    return kib;
  }
  return 0;
}

TEST_F(OctomapFiles, AreWrittenWithoutATreeOfAllVoxels) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer's own memory would be measured";
#endif
  OccupancyGrid free(OccupancyConfig{}, Box3(Vec3(0, 0, 0), Vec3(32, 32, 32)));
  free.apply({.free = voxels_where(free, everywhere), .occupied = {}});
  ASSERT_EQ(free.geometry().voxel_count(), 4'096'000U);
  const std::size_t before_kib = most_resident_kib();
  write_octomap(free, folder_ / "free");
  EXPECT_LT(most_resident_kib() - before_kib, 60'000U);  // all at once: 180,000
}

TEST_F(OctomapFiles, DamagedOnesAndMissingFoldersAreRefused) {
  write_octomap(grid_, folder_ / "map");
  const std::string whole = read_file(folder_ / "map.ot");
  for (const std::string& text :
       {std::string("some words"), whole.substr(0, whole.size() / 2), whole.substr(0, 40),
        whole + "more", std::string(whole).replace(whole.find("res ") + 4, 3, "inf"),
        // children of children of a voxel
        whole.substr(0, whole.find("data\n") + 5) + std::string(4000, '\xff')}) {
    std::ofstream(folder_ / "damaged.ot", std::ios::binary) << text;
    EXPECT_THROW(read_octomap(folder_ / "damaged.ot"), BadInput);
  }
  EXPECT_THROW(read_octomap(folder_ / "none.ot"), BadInput);
  EXPECT_TRUE(test::says(test::fault_of([&] { write_octomap(grid_, folder_ / "nowhere" / "map"); }),
                         {"nowhere"}));
}

}  // namespace
}  // namespace gnbv
