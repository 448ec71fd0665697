// Boxes that may not be flown in.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/map/ray_walk.hpp"
#include "planner/motion/free_space.hpp"
#include "planner/motion/paths.hpp"
#include "sim/core/rng.hpp"
#include "tests/planner/map/drawn_map.hpp"

namespace gnbv {
namespace {

const Box3 kRoom(Vec3(-6, -6, 0), Vec3(6, 6, 6));

/// The least distance of many points of the leg to any of the boxes.
double nearest_m(const NoFly& no_fly, const Vec3& a_m, const Vec3& b_m) {
  double nearest_m = 1e9;
  for (const Box3& box_m : no_fly.boxes_m) {
    for (int i = 0; i <= 2000; ++i) {
      const Vec3 p_m = a_m + (i / 2000.0) * (b_m - a_m);
      nearest_m = std::min(nearest_m, box_m.exteriorDistance(p_m));
    }
  }
  return nearest_m;
}

TEST(NoFly, ALegIsAllowedIfAllItsPointsKeepTheMargin) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> coordinate(-6.0, 6.0);
  const auto point = [&] {
    const double x = coordinate(generator);
    const double y = coordinate(generator);
    return Vec3(x, y, 3.0 + 0.5 * coordinate(generator));
  };
  const NoFly no_fly{{Box3(Vec3(-1, -2, 0), Vec3(1, 0, 3)), Box3(Vec3(3, 2, 2), Vec3(4, 5, 6))},
                     0.7};
  int forbidden = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 a_m = point();
    const Vec3 b_m = point();
    if (!no_fly.allows(a_m)) continue;
    const double exact_m = nearest_m(no_fly, a_m, b_m);
    if (std::abs(exact_m - no_fly.margin_m) < 0.01) continue;  // the points are 6 mm apart
    EXPECT_EQ(no_fly.allows_leg(a_m, b_m), exact_m > no_fly.margin_m)
        << a_m.transpose() << " to " << b_m.transpose();
    forbidden += no_fly.allows_leg(a_m, b_m) ? 0 : 1;
  }
  EXPECT_GT(forbidden, 50);
}

TEST(NoFly, AMarginThatWasEnteredMayBeLeftButNotCrossed) {
  const NoFly no_fly{{Box3(Vec3(-1, -1, 0), Vec3(1, 1, 3))}, 0.7};
  const Vec3 inside_margin_m(-1.5, 0, 1);
  EXPECT_FALSE(no_fly.allows(inside_margin_m));
  EXPECT_TRUE(no_fly.allows_leg(inside_margin_m, Vec3(-3, 0, 1)));
  EXPECT_FALSE(no_fly.allows_leg(inside_margin_m, Vec3(3, 0, 1)));
}

/// A wall of nobody's air across the room, but for a gap along y = 4 to 6.
const NoFly kBarrier{{Box3(Vec3(-0.5, -7, -1), Vec3(0.5, 4, 7))}, 0.5};

TEST(WayAround, LeadsByTheCornersOfTheGrownBox) {
  const Vec3 from_m(-4, 0, 2);
  const Vec3 to_m(4, 0, 2);
  const auto via_m = way_around(kBarrier, kRoom, from_m, to_m);
  ASSERT_TRUE(via_m.has_value());
  Vec3 at_m = from_m;
  for (const Vec3& next_m : *via_m) {
    EXPECT_TRUE(kRoom.contains(next_m));
    EXPECT_TRUE(kBarrier.allows(next_m));
    EXPECT_TRUE(kBarrier.allows_leg(at_m, next_m));
    at_m = next_m;
  }
  EXPECT_TRUE(kBarrier.allows_leg(at_m, to_m));
  // grown by 0.5 m: corners at |x| = 1, y = 4.5, at the floor, pulled into the room
  const double expected_m = 2.0 * std::sqrt(3.0 * 3.0 + 4.5 * 4.5 + 2.0 * 2.0) + 2.0;
  EXPECT_NEAR(path_length_m(from_m, *via_m, to_m), expected_m, 0.02);
}

TEST(WayAround, IsStraightWhereNothingForbidsItAndNoneWhereAllIsForbidden) {
  EXPECT_TRUE(way_around(kBarrier, kRoom, Vec3(-4, 0, 2), Vec3(-4, 4, 2))->empty());
  EXPECT_TRUE(way_around({}, kRoom, Vec3(-4, 0, 2), Vec3(4, 0, 2))->empty());
  const NoFly closed{{Box3(Vec3(-0.5, -7, -1), Vec3(0.5, 7, 7))}, 0.5};
  EXPECT_FALSE(way_around(closed, kRoom, Vec3(-4, 0, 2), Vec3(4, 0, 2)));
  const auto nothing = [](const Vec3&, const Vec3&) { return false; };
  EXPECT_FALSE(way_around(kBarrier, kRoom, Vec3(-4, 0, 2), Vec3(-4, 4, 2), nothing));
}

const Box3 kBox(Vec3(-3, -3, 0), Vec3(3, 3, 3));
constexpr double kRadius_m = 0.7;

/// All free but some voxels that are occupied and some that are unknown.
OccupancyGrid scattered_grid(std::uint64_t seed) {
  OccupancyGrid grid(OccupancyConfig{}, kBox);
  std::vector<VoxelIndex> occupied, free;
  for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
    const double dice = uniform01({seed, Stream::bench, 0, v});
    if (dice < 0.99) (dice < 0.002 ? occupied : free).push_back(v);
  }
  hit(grid, occupied);
  clear(grid, free);
  return grid;
}

/// Makes what is occupied free, but for voxels between every `step`-th.
void clear_occupied(OccupancyGrid& grid, VoxelIndex step) {
  std::vector<VoxelIndex> cleared;
  for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); v += step) {
    if (grid.state(v) == VoxelState::occupied) cleared.push_back(v);
  }
  clear(grid, cleared);
}

TEST(OpenSpace, IsWhereASphereIsClearWithinTheNavigationBox) {
  OccupancyGrid grid = scattered_grid(1);
  const Box3 navigation_m(Vec3(-3, -3, 0.5), Vec3(3, 3, 3));
  OpenSpace space(grid.geometry(), navigation_m, {}, kRadius_m);
  for (int round = 0; round < 2; ++round) {  // the second after some of it has changed
    space.follow(grid);
    int open = 0;
    for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
      const Key key = grid.geometry().key_at(v);
      const Vec3 center_m = grid.geometry().center_m(key);
      const auto is_clear = [&](double radius_m) {
        return grid.state(v) == VoxelState::free && navigation_m.contains(center_m) &&
               is_sphere_clear(grid, center_m, radius_m);
      };
      const bool is_open = space.is_open(grid, key);
      ASSERT_LE(is_open, is_clear(kRadius_m)) << "voxel " << v;
      ASSERT_GE(is_open, is_clear(kRadius_m + 2e-6)) << "voxel " << v;
      open += is_open ? 1 : 0;
    }
    EXPECT_GT(open, 100);
    clear_occupied(grid, 3);
  }
}

TEST(OpenSpace, NothingNearANoFlyBoxIsOpen) {
  OccupancyGrid grid = scattered_grid(2);
  const NoFly no_fly{.boxes_m = {Box3(Vec3(-1, -1, 0), Vec3(0, 1, 3))}, .margin_m = kRadius_m};
  OpenSpace everywhere(grid.geometry(), kBox, {}, kRadius_m);
  OpenSpace beside(grid.geometry(), kBox, no_fly, kRadius_m);
  for (int round = 0; round < 2; ++round) {  // the second without anything occupied
    everywhere.follow(grid);
    beside.follow(grid);
    int shut = 0;
    for (VoxelIndex v = 0; v < grid.geometry().voxel_count(); ++v) {
      const Key key = grid.geometry().key_at(v);
      const bool may_fly = no_fly.allows(grid.geometry().center_m(key));
      ASSERT_EQ(beside.is_open(grid, key), may_fly && everywhere.is_open(grid, key));
      if (!may_fly && everywhere.is_open(grid, key)) ++shut;
    }
    EXPECT_GT(shut, 100);
    clear_occupied(grid, 1);
  }
}

/// A line through open voxels keeps the radius but for what lies between a voxel and its centre.
TEST(OpenSpace, AnOpenLineKeepsTheRadiusWithinHalfAVoxel) {
  const OccupancyGrid grid = scattered_grid(3);
  OpenSpace space(grid.geometry(), kBox, {}, kRadius_m);
  space.follow(grid);
  const double slack_m = 0.5 * std::sqrt(3.0) * grid.geometry().resolution_m();
  int open = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const auto at = [&](std::uint64_t k) { return uniform01({4, Stream::bench, i, k}); };
    const Vec3 a(6 * at(0) - 3, 6 * at(1) - 3, 3 * at(2));
    const Vec3 b(6 * at(3) - 3, 6 * at(4) - 3, 3 * at(5));
    if (!space.is_open(grid, grid.geometry().key_of(a)) || !space.is_line_open(grid, a, b))
      continue;
    ++open;
    EXPECT_TRUE(is_path_clear(grid, a, b, kRadius_m - slack_m));
    EXPECT_TRUE(is_line_free(grid, a, b));
  }
  EXPECT_GT(open, 20);
}

/// What it keeps of the grid that it followed says the same as the rule, which it goes by once the
/// grid has changed.
TEST(OpenSpace, AnswersAlikeAsLongAsTheGridStaysAndAfterwards) {
  const OccupancyGrid grid = scattered_grid(5);
  OccupancyGrid later = grid;
  later.apply({});
  OpenSpace space(grid.geometry(), kBox, {}, kRadius_m);
  const OccupancyGrid unseen(OccupancyConfig{}, kBox);
  EXPECT_FALSE(space.is_open(unseen, {0, 0, 1})) << "of a grid that it never followed";
  space.follow(grid);
  int open = 0, shut = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const auto at = [&](std::uint64_t k) { return uniform01({6, Stream::bench, i, k}); };
    const Vec3 a(6 * at(0) - 3, 6 * at(1) - 3, 3 * at(2));
    const Vec3 b = a + Vec3(at(3) - 0.5, at(4) - 0.5, at(5) - 0.5);
    const bool is_open = space.is_line_open(grid, a, b);
    ASSERT_EQ(is_open, space.is_line_open(later, a, b)) << a.transpose() << " " << b.transpose();
    ++(is_open ? open : shut);
  }
  EXPECT_GT(open, 1000);
  EXPECT_GT(shut, 1000);
}

/// Its ends are float32, as OctoMap's: where a line runs along the edges of voxels, their last bits
/// decide which voxels it visits. g++ 12 forgot that rounding (decision 127).
TEST(OpenSpace, AsksOfALineTheVoxelsThatItsFloat32EndsLeadThrough) {
  constexpr double kOfOneVoxel_m = 0.05;
  const OccupancyGrid unknown(OccupancyConfig{}, kBox);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const auto pick = [&](std::uint64_t k, int n) {
      return std::floor(n * uniform01({7, Stream::bench, i, k}));
    };
    const Vec3 a(0.2 * pick(0, 20) - 1.9, 0.2 * pick(1, 20) - 1.9, 0.2 * pick(2, 5) + 1.1);
    Vec3 way(2 * pick(3, 2) - 1, 2 * pick(4, 2) - 1, 2 * pick(5, 2) - 1);
    way[static_cast<int>(pick(6, 3))] = 0.0;
    const std::vector<Vec3f> ends = {a.cast<float>(), (a + way).cast<float>()};
    std::vector<VoxelIndex> voxels = {voxel_at(unknown, a + way)};
    walk_ray(unknown.geometry(), ends[0], ends[1], [&](const Key& key) {
      voxels.push_back(unknown.geometry().index_of(key));
      return true;
    });
    OccupancyGrid grid = unknown;
    clear(grid, voxels);
    OpenSpace space(grid.geometry(), kBox, {}, kOfOneVoxel_m);
    space.follow(grid);
    EXPECT_TRUE(space.is_line_open(grid, a, a + way)) << a.transpose() << " + " << way.transpose();
  }
}

}  // namespace
}  // namespace gnbv
