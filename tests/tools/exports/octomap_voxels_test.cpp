#include "tools/exports/octomap_voxels.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/map/octomap_io.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/rng.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

/// Files of a map, every voxel of which is free, occupied or unmeasured by chance.
class OctomapVoxels : public ::testing::Test {
 protected:
  OctomapVoxels() : grid_(OccupancyConfig{}, Box3(Vec3(-3, -2, 0), Vec3(3, 2, 2))) {
    ScanUpdate update;
    for (VoxelIndex v = 0; v < grid_.geometry().voxel_count(); ++v) {
      const double u = uniform01({53, Stream::bench, 0, v});
      if (u < 0.5) update.free.push_back(v);
      if (u > 0.8) update.occupied.push_back(v);
    }
    grid_.apply(update);
  }

  TempFolder folder_;
  OccupancyGrid grid_;
};

TEST_F(OctomapVoxels, ReadBackAsTheVoxelsOfTheMap) {
  // a whole cube of occupied voxels is pruned to one node, and has to come apart again
  ScanUpdate update;
  for (VoxelIndex v = 0; v < grid_.geometry().voxel_count(); ++v) {
    const Key key = grid_.geometry().key_at(v);
    const bool is_in = std::ranges::all_of(key, [](std::int32_t k) { return k >= 0 && k < 4; });
    if (is_in) update.occupied.push_back(v);
  }
  grid_.apply(update);
  write_octomap(grid_, folder_.path() / "map");
  const MeasuredVoxels read = read_octomap(folder_.path() / "map.bt");
  EXPECT_EQ(read.voxel_m, 0.2);
  std::vector<VoxelIndex> occupied;
  for (const Vec3f& centre_m : read.occupied_world_m) {
    const Vec3 scaled = centre_m.cast<double>() / read.voxel_m - Vec3::Constant(0.5);
    EXPECT_LT((scaled - scaled.array().round().matrix()).norm(), 1e-4);
    const Key key = {static_cast<std::int32_t>(std::lround(scaled.x())),
                     static_cast<std::int32_t>(std::lround(scaled.y())),
                     static_cast<std::int32_t>(std::lround(scaled.z()))};
    occupied.push_back(grid_.geometry().index_of(key));
  }
  std::ranges::sort(occupied);
  std::vector<VoxelIndex> expected;
  for (VoxelIndex v = 0; v < grid_.geometry().voxel_count(); ++v) {
    if (grid_.state(v) == VoxelState::occupied) expected.push_back(v);
  }
  EXPECT_EQ(occupied, expected);
  std::size_t measured = 0;
  for (VoxelIndex v = 0; v < grid_.geometry().voxel_count(); ++v) {
    measured += static_cast<std::size_t>(grid_.is_measured(v));
  }
  EXPECT_EQ(read.free_voxels + expected.size(), measured);
}

TEST_F(OctomapVoxels, OfDamagedFilesAreRefused) {
  write_octomap(grid_, folder_.path() / "map");
  const std::string whole = read_file(folder_.path() / "map.bt");
  for (const std::string& text : {std::string("some words"), whole.substr(0, whole.size() / 2),
                                  whole.substr(0, 40), read_file(folder_.path() / "map.ot")}) {
    write_file_atomically(folder_.path() / "damaged.bt", text);
    EXPECT_THROW(read_octomap(folder_.path() / "damaged.bt"), BadInput);
  }
  EXPECT_THROW(read_octomap(folder_.path() / "none.bt"), BadInput);
  const std::string header = "# Octomap OcTree binary file\nid OcTree\nsize 2\nres 0.1\ndata\n";
  const auto write_tree = [&](const std::string& data) {
    write_file_atomically(folder_.path() / "made.bt", header + data);
    return folder_.path() / "made.bt";
  };
  EXPECT_THROW(read_octomap(write_tree({2, 0})), BadInput);  // an eighth of all there can be
  EXPECT_EQ(read_octomap(write_tree({1, 0})).free_voxels, std::size_t{1} << 45U);
  EXPECT_THROW(read_octomap(write_tree({5, 0})), BadInput);  // three nodes
  // eight levels down a cube of two million voxels: some bytes that would take all memory
  std::string cube = "# Octomap OcTree binary file\nid OcTree\nsize 10\nres 0.1\ndata\n";
  for (int level = 0; level < 8; ++level) cube += std::string({3, 0});
  write_file_atomically(folder_.path() / "cube.bt", cube + std::string({2, 0}));
  EXPECT_THROW(read_octomap(folder_.path() / "cube.bt"), BadInput);
}

TEST_F(OctomapVoxels, OfAMapThatNothingTouchedAreNone) {
  write_octomap(OccupancyGrid(OccupancyConfig{}, Box3(Vec3(0, 0, 0), Vec3(1, 1, 1))),
                folder_.path() / "empty");
  EXPECT_TRUE(read_octomap(folder_.path() / "empty.bt").occupied_world_m.empty());
}

}  // namespace
}  // namespace gnbv
