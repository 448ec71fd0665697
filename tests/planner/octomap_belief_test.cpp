// Anybody's OctoMap as the map to begin with; liboctomap writes the files and says what is in them.
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/octomap.h>

#include <random>

#include "planner/core/belief.hpp"
#include "planner/planners.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

const Box3 kWorkspace_m(Vec3(-3, -2, 0), Vec3(3, 2, 2));

/// Rays from the middle of the workspace to points in and beyond it.
template <typename Tree = octomap::OcTree>
Tree scanned(double voxel_m) {
  Tree tree(voxel_m);
  std::mt19937 random(9);  // NOLINT
  std::uniform_real_distribution<float> share(-1.0F, 1.0F);
  octomap::Pointcloud cloud;
  for (int i = 0; i < 4000; ++i) {
    cloud.push_back(4.0F * share(random), 3.0F * share(random), 1.0F + 1.5F * share(random));
  }
  tree.insertPointCloud(cloud, octomap::point3d(0, 0, 1));
  tree.prune();
  return tree;
}

class OctomapBelief : public testing::Test {
 protected:
  OctomapBelief() : model_(make_model(config(), kWorkspace_m, {&camera_, 1}, {})) {}
  static PlannerConfig config() {
    PlannerConfig config;
    config.map.resolution_m = 0.2;
    return config;
  }
  /// The highest log-odds of the tree's voxels whose centres lie in the voxel; what has none there
  /// has to be as fine as ours.
  static std::optional<float> highest_in(const octomap::OcTree& tree, const Vec3& centre_m) {
    const double step_m = std::min(tree.getResolution(), 0.2);
    const int steps = static_cast<int>(std::lround(0.2 / step_m));
    std::optional<float> highest;
    for (int i = 0; i < steps * steps * steps; ++i) {
      const Vec3 at_m = centre_m + step_m * (Vec3(i % steps, i / steps % steps, i / steps / steps) -
                                             Vec3::Constant(0.5 * (steps - 1)));
      const auto* const node = tree.search(at_m.x(), at_m.y(), at_m.z());
      if (node != nullptr) highest = std::max(highest.value_or(-99.0F), node->getLogOdds());
    }
    return highest;
  }
  void expect_same(const octomap::OcTree& tree, const Belief& belief) const {
    const OccupancyGrid& grid = belief.grid;
    std::size_t known = 0;
    for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
      const Vec3 centre_m = grid.geometry().center_m(grid.geometry().key_at(v));
      std::optional<float> expected = highest_in(tree, centre_m);
      const bool is_occupied = expected && *expected >= octomap::logodds(0.6);
      if (is_occupied && centre_m.z() < model_.belief.floor_z_m) expected.reset();
      ASSERT_EQ(grid.is_measured(v), expected.has_value()) << centre_m.transpose();
      if (!expected) continue;
      ++known;
      ASSERT_EQ(grid.log_odds(v), *expected) << centre_m.transpose();
    }
    EXPECT_GT(known, 500U);
    EXPECT_GT(grid.occupied_count(), 50U);
    EXPECT_TRUE(belief.cloud.points_world_m().empty());
  }
  std::string path(const char* name) const { return (temp_.path() / name).string(); }

  TempFolder temp_;
  CameraConfig camera_;
  PlannerModel model_;
  std::vector<std::string> notes_;
};

TEST_F(OctomapBelief, HoldsWhatLiboctomapHoldsAtAnyVoxelSize) {
  for (const double voxel_m : {0.2, 0.1, 0.05, 0.4}) {
    octomap::OcTree tree = scanned(voxel_m);
    tree.write(path("a.ot"));
    notes_.clear();
    expect_same(tree, read_belief(path("a.ot"), model_, &notes_));
    EXPECT_EQ(notes_.size(), voxel_m == 0.2 ? 1U : 2U);  // below the floor, and resampled
    tree.writeBinary(path("a.bt"));
    octomap::OcTree binary(0.1);
    binary.readBinary(path("a.bt"));
    expect_same(binary, read_belief(path("a.bt"), model_));
  }
}

TEST_F(OctomapBelief, ColoursAreSteppedOver) {
  scanned<octomap::ColorOcTree>(0.2).write(path("colour.ot"));
  expect_same(scanned(0.2), read_belief(path("colour.ot"), model_));
}

TEST_F(OctomapBelief, WhatIsNoMapOfTheWorkspaceIsRefused) {
  octomap::OcTree far(0.2);
  far.updateNode(90.0, 90.0, 1.0, true);
  far.write(path("far.ot"));
  EXPECT_TRUE(test::says(test::fault_of([&] { read_belief(path("far.ot"), model_); }),
                         {"far.ot", "1 leaves", "within workspace_m"}));
  for (const char* name : {"a.ot", "a.bt"}) {
    octomap::OcTree tree = scanned(0.2);
    name[2] == 'o' ? tree.write(path(name)) : tree.writeBinary(path(name));
    const std::string whole = read_file(path(name));
    for (std::size_t size = 0; size < whole.size(); size += 1 + size / 2) {
      write_file_atomically(path(name), whole.substr(0, size));
      EXPECT_NE(test::fault_of([&] { read_belief(path(name), model_); }), "") << size;
    }
  }
}

}  // namespace
}  // namespace gnbv
