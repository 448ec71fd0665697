// Boxes that may not be flown in.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/motion/paths.hpp"

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

}  // namespace
}  // namespace gnbv
