#include "planner/map/occupancy_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/reference/octomap_twin.hpp"
#include "planner/map/grid_geometry.hpp"
#include "planner/planners.hpp"
#include "sim/core/error.hpp"
#include "tests/planner/map/random_points.hpp"

namespace gnbv {
namespace {

const Box3 kBox_m(Vec3(-1, -1, 0), Vec3(1, 1, 1));
constexpr VoxelIndex kVoxels = 500;

/// Log-odds of a probability, as OctoMap stores them.
float log_odds(double p) { return static_cast<float>(std::log(p / (1.0 - p))); }

ScanUpdate random_update(Random& random) {
  ScanUpdate update;
  for (VoxelIndex v = 0; v < kVoxels; ++v) {
    const double kind = random.uniform(0.0, 1.0);
    const double share_free = 0.3 + 0.6 * (v % 2);  // every other voxel becomes settled
    if (kind < share_free) update.free.push_back(v);
    if (kind > 0.85 && kind >= share_free) update.occupied.push_back(v);
  }
  return update;
}

// log-odds over many scans are OctoMap's: scan_insertion_test.cpp
TEST(OccupancyGrid, AfterAnyScansInAnyOrderOfVoxelsAVoxelIsWhatItsLogOddsSay) {
  OccupancyGrid grid(OccupancyConfig{}, kBox_m);
  OccupancyGrid backward = grid;
  const Box3 object_m(Vec3(-0.5, -1, 0.3), Vec3(1, 0.6, 2));
  OccupancyGrid bounded(OccupancyConfig{}, kBox_m, object_m);
  ASSERT_EQ(grid.geometry().voxel_count(), kVoxels);
  const float lowest = log_odds(OccupancyConfig{}.clamp_min);
  const float highest = log_odds(OccupancyConfig{}.clamp_max);
  EXPECT_EQ(grid.settled_log_odds(), lowest);
  Random random(5);
  std::array<int, 5> seen{};  // by state, and at the bounds
  std::vector<bool> is_measured(kVoxels);
  for (int scan = 0; scan <= 40; ++scan) {
    double sum_nat = 0.0, object_nat = 0.0;
    std::size_t occupied = 0;
    for (VoxelIndex v = 0; v < kVoxels; ++v) {
      const double p = probability(grid, v);
      const float odds = grid.log_odds(v);
      const bool is_clamped = odds == lowest || odds == highest;
      const VoxelState state = odds >= log_odds(0.6)   ? VoxelState::occupied
                               : odds <= log_odds(0.4) ? VoxelState::free
                                                       : VoxelState::unknown;
      const double entropy_nat =
          is_clamped ? 0.0 : -p * std::log(p) - (1.0 - p) * std::log(1.0 - p);
      ASSERT_EQ(grid.is_measured(v), is_measured[v]);
      ASSERT_TRUE(is_measured[v] || odds == 0.0F);
      ASSERT_EQ(grid.state(v), is_measured[v] ? state : VoxelState::unknown);
      ASSERT_NEAR(grid.entropy_nat(v), entropy_nat, 1e-7);  // float32
      ASSERT_EQ(grid.words()[v] == grid.settled_word(), odds == lowest) << v;
      sum_nat += entropy_nat;
      const Vec3 center_m = grid.geometry().center_m(grid.geometry().key_at(v));
      const bool is_counted = object_m.contains(center_m);
      object_nat += is_counted ? entropy_nat : 0.0;
      ASSERT_EQ(bounded.is_counted(v), is_counted);
      ASSERT_EQ(bounded.entropy_nat(v), is_counted ? grid.entropy_nat(v) : 0.0F);
      ASSERT_EQ(bounded.state(v), grid.state(v));
      ASSERT_EQ(bounded.is_measured(v), is_measured[v]);
      occupied += state == VoxelState::occupied ? 1 : 0;
      ++seen[static_cast<std::size_t>(state)];
      if (is_clamped) ++seen[odds == lowest ? 3 : 4];
    }
    // each voxel is rounded to 2^-32 nat, so at most half of it off; and float64 sums below 350
    ASSERT_NEAR(grid.total_entropy_nat(), sum_nat, kVoxels * 0x1p-33 + 1e-10);
    ASSERT_NEAR(bounded.total_entropy_nat(), object_nat, kVoxels * 0x1p-33 + 1e-10);
    ASSERT_EQ(grid.occupied_count(), occupied);
    ASSERT_EQ(bounded.occupied_count(), occupied);
    ASSERT_EQ(grid.total_entropy_nat(), backward.total_entropy_nat());
    ScanUpdate update = random_update(random);
    for (const auto& touched : {update.free, update.occupied}) {
      for (const VoxelIndex v : touched) is_measured[v] = true;
    }
    grid.apply(update);
    bounded.apply(update);
    std::ranges::reverse(update.free);
    std::ranges::reverse(update.occupied);
    backward.apply(update);
  }
  for (const int count : seen) EXPECT_GT(count, 100);
}

TEST(OccupancyGrid, NoVoxelIsSettledWhereWordsCannotTell) {
  // free at both bounds, and bounds before which entropy is 0 already
  for (const OccupancyConfig& config :
       {OccupancyConfig{.clamp_max = 0.9, .occupied_min = 0.95, .free_max = 0.91},
        OccupancyConfig{.clamp_min = 1e-12}, OccupancyConfig{.clamp_min = 0.45, .free_max = 0.4}}) {
    OccupancyGrid grid(config, kBox_m);
    for (int scan = 0; scan < 100; ++scan) grid.apply({.free = {3}, .occupied = {4}});
    EXPECT_NE(grid.words()[3], grid.settled_word());
    EXPECT_NE(grid.words()[4], grid.settled_word());
  }
}

TEST(OccupancyGrid, OutsideIsUnknown) {
  OccupancyGrid grid(OccupancyConfig{}, kBox_m);
  grid.apply({.free = {}, .occupied = {0}});
  EXPECT_EQ(grid.state_at(Vec3(-0.9, -0.9, 0.1)), VoxelState::occupied);
  EXPECT_EQ(grid.state_at(Vec3(-1.1, -0.9, 0.1)), VoxelState::unknown);
  EXPECT_EQ(grid.state_at(Vec3(-0.9, -0.9, -0.1)), VoxelState::unknown);
}

TEST(OccupancyGrid, RefusesProbabilitiesOutOfOrder) {
  for (const OccupancyConfig& config :
       {OccupancyConfig{.resolution_m = -0.2}, OccupancyConfig{.prob_hit = 0.5},
        OccupancyConfig{.prob_miss = 0.6}, OccupancyConfig{.clamp_min = 0.0},
        OccupancyConfig{.clamp_max = 1.0}, OccupancyConfig{.occupied_min = 0.3}}) {
    EXPECT_THROW(OccupancyGrid(config, kBox_m), BadInput);
  }
}

double voxels_of(const Box3& box_m, double resolution_m) {
  return static_cast<double>(GridGeometry(box_m, resolution_m).voxel_count());
}

TEST(MapBytes, HoldEveryVoxelAndAQuarterOfABillionAreWithinTheBudget) {
  const Box3 small_m(Vec3(-2.05, -2, 0), Vec3(2, 2, 2));
  const double voxels = voxels_of(small_m, 0.2);
  const double bytes = map_bytes(small_m, 0.2, 1, 2);
  EXPECT_GE(bytes, 22.0 * voxels);
  EXPECT_GE(map_bytes(small_m, 0.2, 4, 2), bytes + 6.0 * voxels);
  EXPECT_EQ(map_bytes(small_m, 0.2, 1, 5), bytes + 3.0 * voxels);
  PlannerConfig config;
  EXPECT_EQ(planning_bytes(config, small_m, 1, 2), bytes);
  config.utility.name = "tour";  // which keeps space of its own
  EXPECT_GT(planning_bytes(config, small_m, 1, 2), bytes + 5.0 * voxels);
  const Box3 fine_m(Vec3(-20, -20, 0), Vec3(20, 20, 20));
  const Box3 wide_m(Vec3(-100, -100, 0), Vec3(100, 100, 50));
  for (const auto& [box_m, resolution_m] : {std::pair{fine_m, 0.05}, std::pair{wide_m, 0.2}}) {
    EXPECT_GE(voxels_of(box_m, resolution_m), 250e6);
    EXPECT_LT(map_bytes(box_m, resolution_m, 2, 2), kMapBudget_bytes);
    EXPECT_GT(map_bytes(box_m, resolution_m, 4, 2), kMapBudget_bytes);
  }
}

}  // namespace
}  // namespace gnbv
