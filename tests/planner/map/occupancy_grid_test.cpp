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

OccupancyGrid small_grid() { return OccupancyGrid(OccupancyConfig{}, kBox_m); }

double entropy_nat(double p) { return -p * std::log(p) - (1.0 - p) * std::log(1.0 - p); }

TEST(OccupancyGrid, UnmeasuredSpaceIsUnknownAtLn2) {
  const OccupancyGrid grid = small_grid();
  EXPECT_EQ(grid.geometry().voxel_count(), 500U);
  for (VoxelIndex v = 0; v < 500; ++v) {
    EXPECT_EQ(grid.state(v), VoxelState::unknown);
    EXPECT_FALSE(grid.is_measured(v));
    EXPECT_EQ(grid.log_odds(v), 0.0F);
    EXPECT_EQ(grid.entropy_nat(v), static_cast<float>(std::log(2.0)));
  }
  // each voxel is rounded to 2^-32 nat, so at most half of it off
  EXPECT_NEAR(grid.total_entropy_nat(), 500.0 * std::log(2.0), 500.0 * 0x1p-33);
}

TEST(OccupancyGrid, OneMissIsFreeAndOneHitOccupied) {
  OccupancyGrid grid = small_grid();
  grid.apply({.free = {3}, .occupied = {4}});
  EXPECT_EQ(grid.state(3), VoxelState::free);
  EXPECT_EQ(grid.state(4), VoxelState::occupied);
  EXPECT_TRUE(grid.is_measured(3));
  EXPECT_TRUE(grid.is_measured(4));
  EXPECT_FALSE(grid.is_measured(5));
  EXPECT_EQ(grid.occupied_count(), 1U);
  // float32 log-odds hold p to about 1e-7
  EXPECT_NEAR(probability(grid, 3), 0.4, 1e-7);
  EXPECT_NEAR(probability(grid, 4), 0.7, 1e-7);
  EXPECT_EQ(probability(grid, 5), 0.5);
}

TEST(OccupancyGrid, BetweenTheThresholdsIsUnknownAgain) {
  OccupancyGrid grid = small_grid();
  grid.apply({.free = {}, .occupied = {7}});
  grid.apply({.free = {7}, .occupied = {}});
  grid.apply({.free = {7}, .occupied = {}});  // 0.847 - 2 * 0.405: p = 0.509
  EXPECT_EQ(grid.state(7), VoxelState::unknown);
  EXPECT_TRUE(grid.is_measured(7));
  EXPECT_EQ(grid.occupied_count(), 0U);
}

/// Log-odds of a clamping bound, as OctoMap stores it.
float bound(double p) { return static_cast<float>(std::log(p / (1.0 - p))); }

TEST(OccupancyGrid, ClampsAtBothBoundsExactlyAndComesBack) {
  OccupancyGrid grid = small_grid();
  for (int i = 0; i < 20; ++i) grid.apply({.free = {1}, .occupied = {2}});
  EXPECT_EQ(grid.log_odds(1), bound(0.1192));
  EXPECT_EQ(grid.log_odds(2), bound(0.971));
  EXPECT_EQ(grid.entropy_nat(1), 0.0F);
  EXPECT_EQ(grid.entropy_nat(2), 0.0F);
  EXPECT_NEAR(grid.total_entropy_nat(), 498.0 * std::log(2.0), 498.0 * 0x1p-33);
  grid.apply({.free = {2}, .occupied = {1}});
  EXPECT_EQ(grid.log_odds(1), bound(0.1192) + bound(0.7));
  EXPECT_EQ(grid.log_odds(2), bound(0.971) + bound(0.4));
  EXPECT_GT(grid.entropy_nat(1), 0.0F);
}

TEST(OccupancyGrid, TheSettledWordIsThatOfVoxelsAtTheLowerBoundAlone) {
  OccupancyGrid grid = small_grid();
  for (VoxelIndex v = 0; v < 20; ++v) {  // up and down, by turns of every length
    if (v % 3 == 0) grid.apply({.free = {}, .occupied = {v}});
    for (VoxelIndex miss = 0; miss < v / 2; ++miss) grid.apply({.free = {v}, .occupied = {}});
  }
  grid.apply({.free = {}, .occupied = {20}});
  for (int hit = 0; hit < 9; ++hit) grid.apply({.free = {}, .occupied = {20}});
  int settled = 0;
  for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
    const bool is_settled = grid.words()[v] == grid.settled_word();
    EXPECT_EQ(is_settled, grid.log_odds(v) == bound(OccupancyConfig{}.clamp_min)) << v;
    settled += is_settled ? 1 : 0;
  }
  EXPECT_GT(settled, 5);
  EXPECT_EQ(grid.settled_log_odds(), bound(OccupancyConfig{}.clamp_min));
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

ScanUpdate random_update(Random& random, VoxelIndex voxels) {
  ScanUpdate update;
  for (VoxelIndex v = 0; v < voxels; ++v) {
    const double kind = random.uniform(0.0, 1.0);
    if (kind < 0.3) update.free.push_back(v);
    if (kind > 0.85) update.occupied.push_back(v);
  }
  return update;
}

TEST(OccupancyGrid, TotalEntropyEqualsTheFullSumAfterAnyUpdates) {
  OccupancyGrid grid = small_grid();
  Random random(5);
  for (int scan = 0; scan < 200; ++scan) grid.apply(random_update(random, 500));
  double sum_nat = 0.0;
  std::size_t occupied = 0;
  for (VoxelIndex v = 0; v < 500; ++v) {
    const bool is_clamped = grid.log_odds(v) == bound(0.1192) || grid.log_odds(v) == bound(0.971);
    if (!is_clamped) sum_nat += entropy_nat(probability(grid, v));
    occupied += static_cast<std::size_t>(grid.state(v) == VoxelState::occupied);
  }
  // the increments are exact integers: only the rounding of each voxel to 2^-32 nat is left, and
  // float64 rounding of a sum below 350
  EXPECT_NEAR(grid.total_entropy_nat(), sum_nat, 500.0 * 0x1p-33 + 1e-10);
  EXPECT_EQ(grid.occupied_count(), occupied);
}

TEST(OccupancyGrid, TotalEntropyDoesNotDependOnTheOrderOfVoxels) {
  OccupancyGrid forward = small_grid();
  OccupancyGrid backward = small_grid();
  Random random(6);
  for (int scan = 0; scan < 50; ++scan) {
    ScanUpdate update = random_update(random, 500);
    forward.apply(update);
    std::reverse(update.free.begin(), update.free.end());
    std::reverse(update.occupied.begin(), update.occupied.end());
    backward.apply(update);
  }
  EXPECT_EQ(forward.total_entropy_nat(), backward.total_entropy_nat());
}

TEST(OccupancyGrid, OutsideIsUnknown) {
  OccupancyGrid grid = small_grid();
  grid.apply({.free = {}, .occupied = {0}});
  EXPECT_EQ(grid.state_at(Vec3(-0.9, -0.9, 0.1)), VoxelState::occupied);
  EXPECT_EQ(grid.state_at(Vec3(-1.1, -0.9, 0.1)), VoxelState::unknown);
  EXPECT_EQ(grid.state_at(Vec3(-0.9, -0.9, -0.1)), VoxelState::unknown);
}

TEST(OccupancyGrid, RefusesProbabilitiesOutOfOrder) {
  for (const auto& spoil :
       std::vector<void (*)(OccupancyConfig&)>{[](OccupancyConfig& c) { c.prob_hit = 0.5; },
                                               [](OccupancyConfig& c) { c.prob_miss = 0.6; },
                                               [](OccupancyConfig& c) { c.clamp_min = 0.0; },
                                               [](OccupancyConfig& c) { c.clamp_max = 1.0; },
                                               [](OccupancyConfig& c) { c.occupied_min = 0.3; },
                                               [](OccupancyConfig& c) { c.resolution_m = -0.2; }}) {
    OccupancyConfig config;
    spoil(config);
    EXPECT_THROW(OccupancyGrid(config, kBox_m), BadInput);
  }
}

const Box3 kSmallBox_m(Vec3(-2.05, -2, 0), Vec3(2, 2, 2));

double voxels_of(const Box3& box_m, double resolution_m) {
  return static_cast<double>(GridGeometry(box_m, resolution_m).voxel_count());
}

TEST(MapBytes, AreNoLessThanWhatEveryVoxelHolds) {
  const double voxels = voxels_of(kSmallBox_m, 0.2);
  const double bytes = map_bytes(kSmallBox_m, 0.2, 1, 2);
  EXPECT_GE(bytes, 22.0 * voxels);
  EXPECT_GE(map_bytes(kSmallBox_m, 0.2, 4, 2), bytes + 6.0 * voxels);
  EXPECT_EQ(map_bytes(kSmallBox_m, 0.2, 1, 5), bytes + 3.0 * voxels);
}

TEST(MapBytes, OfAQuarterOfABillionVoxelsAreWithinTheBudget) {
  const Box3 fine_m(Vec3(-20, -20, 0), Vec3(20, 20, 20));
  const Box3 wide_m(Vec3(-100, -100, 0), Vec3(100, 100, 50));
  EXPECT_EQ(voxels_of(fine_m, 0.05), 256e6);
  EXPECT_EQ(voxels_of(wide_m, 0.2), 250e6);
  for (const auto& [box_m, resolution_m] : {std::pair{fine_m, 0.05}, std::pair{wide_m, 0.2}}) {
    EXPECT_LT(map_bytes(box_m, resolution_m, 2, 2), kMapBudget_bytes);
    EXPECT_GT(map_bytes(box_m, resolution_m, 4, 2), kMapBudget_bytes);
  }
}

TEST(PlanningBytes, HoldWhatATourKeepsOfEveryVoxelAndCell) {
  PlannerConfig config;
  const double map = map_bytes(kSmallBox_m, config.map.resolution_m, 2, 2);
  EXPECT_EQ(planning_bytes(config, kSmallBox_m, 2, 2), map);
  config.utility.name = "tour";
  const double open_space = 5.0 * voxels_of(kSmallBox_m, config.map.resolution_m);
  EXPECT_GT(planning_bytes(config, kSmallBox_m, 2, 2), map + open_space);
}

}  // namespace
}  // namespace gnbv
