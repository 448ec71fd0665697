// Where the profile is flown.
#include "planner/profiling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace gnbv {
namespace {

const Box3 kBox(Vec3(-20, -20, 0.7), Vec3(20, 20, 20));

double length_m(const std::vector<ProfileLeg>& legs) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < legs.size(); ++i) {
    sum_m += (legs[i].goal.p_world_m - legs[i - 1].goal.p_world_m).norm();
  }
  return sum_m;
}

TEST(BoundingBoxProfile, DescendsAtEightStationsFromTheNearestFacingTheCentre) {
  // released_code.md: 8 x 19.3 + 7 x sqrt(20^2 + 19.3^2) = 349 m without the approach
  EXPECT_NEAR(length_m(bounding_box_profile(kBox, {Vec3(0, -20, 5), 0})),
              8 * 19.3 + 7 * std::hypot(20.0, 19.3), 1e-9);
  for (const Vec3& start : {Vec3(0, -20, 5), Vec3(19, 18, 3), Vec3(-20, 3, 1)}) {
    const auto legs = bounding_box_profile(kBox, {start, 0});
    ASSERT_EQ(legs.size(), 16U);
    std::set<std::tuple<double, double>> stations;
    double nearest_m = 1e9;
    for (std::size_t i = 0; i < legs.size(); ++i) {
      const Vec3& p_m = legs[i].goal.p_world_m;
      stations.insert({p_m.x(), p_m.y()});
      nearest_m = std::min(nearest_m, (p_m - start).head<2>().norm());
      EXPECT_EQ(legs[i].is_scan, i % 2 == 1);
      EXPECT_EQ(p_m.z(), i % 2 == 1 ? 0.7 : 20.0);
      const Vec3 forward = T_world_body(legs[i].goal).linear().col(0);
      const Vec3 to_center = (kBox.center() - p_m).cwiseProduct(Vec3(1, 1, 0));
      EXPECT_NEAR(forward.dot(to_center.normalized()), 1.0, 1e-12);
    }
    EXPECT_EQ(stations.size(), 8U);
    EXPECT_EQ((legs[0].goal.p_world_m - start).head<2>().norm(), nearest_m);
  }
}

std::vector<ProfileLeg> fly(const ProfilingConfig& config, const ViewPose& start,
                            double surface_top_m) {
  ProfileRoute route(config, kBox, start);
  std::vector<ProfileLeg> legs;
  bool saw_surface = false;
  while (const auto leg = route.next(saw_surface)) {
    legs.push_back(*leg);
    saw_surface = leg->goal.p_world_m.z() <= surface_top_m;
    if (legs.size() > 1000) break;
  }
  EXPECT_EQ(route.share_done(), 1.0);
  return legs;
}

ProfilingConfig by(ProfilingMethod method) {
  ProfilingConfig config;
  config.method = method;
  return config;
}

TEST(ProfileRoute, HandsOutTheBoundingBoxWhateverItSeesAndNothingWithoutAMethod) {
  const ViewPose start{Vec3(0, -20, 5), 0};
  const auto expected = bounding_box_profile(kBox, start);
  const auto legs = fly({}, start, 3.0);
  ASSERT_EQ(legs.size(), expected.size());
  for (std::size_t i = 0; i < legs.size(); ++i) {
    EXPECT_EQ(legs[i].goal.p_world_m, expected[i].goal.p_world_m);
    EXPECT_EQ(legs[i].is_scan, expected[i].is_scan);
  }
  EXPECT_TRUE(fly(by(ProfilingMethod::none), start, 3.0).empty());
}

TEST(CircularProfile, ClimbsAtFiveStationsOfTheCircleWhileSurfaceIsSeen) {
  // 0.7 m and steps of 1 m: 7.7 m still sees a surface of 8 m, 8.7 m does not; and up to the box
  for (const auto& [surface_m, expected_top_m] : {std::pair(8.0, 8.7), std::pair(100.0, 20.0)}) {
    std::set<long> bearings_deg;
    double top_m = 0.0;
    Vec3 at_m(0, -20, 0.7);
    for (const ProfileLeg& leg : fly(by(ProfilingMethod::circular), {at_m, 0}, surface_m)) {
      const Vec3& p = leg.goal.p_world_m;
      EXPECT_NEAR(p.head<2>().norm(), 20.0, 1e-9);  // the inscribed circle of the box
      // the chord of 18 degrees stays within 1.3 % of the radius
      EXPECT_GE((0.5 * (at_m + p)).head<2>().norm(), 20.0 * 0.987);
      const Vec3 forward = T_world_body(leg.goal).linear().col(0);
      EXPECT_NEAR(forward.head<2>().dot(-p.head<2>()) / 20.0, 1.0, 1e-12);
      EXPECT_GE(p.z(), 0.7);
      top_m = std::max(top_m, p.z());
      if (leg.is_scan) bearings_deg.insert(std::lround(rad_to_deg(std::atan2(p.y(), p.x()))));
      at_m = p;
    }
    EXPECT_EQ(bearings_deg, (std::set<long>{-90, -18, 54, 126, -162}));
    EXPECT_NEAR(top_m, expected_top_m, expected_top_m == 20.0 ? 1.0 : 1e-9);
    EXPECT_LE(top_m, 20.0);
  }
}

// Over the middle of the south face, beside the middle of the east face up to half the height, and
// all of the corner in the north-west.
const NoFly kNoFly{
    {Box3(Vec3(-4, -22, 16), Vec3(4, -17, 25)), Box3(Vec3(17, -3, 0), Vec3(19, 3, 9)),
     Box3(Vec3(-30, 18, -5), Vec3(-18, 30, 40))},
    1.5};

TEST(ProfileWithNoFly, KeepsEveryLegOutOfTheBoxes) {
  for (const ProfilingMethod method : {ProfilingMethod::bounding_box, ProfilingMethod::circular}) {
    ProfilingConfig config;
    config.method = method;
    const ViewPose start{Vec3(-10, -20, 5), 0};
    ProfileRoute route(config, kBox, start, kNoFly);
    Vec3 at_m = start.p_world_m;
    int scans = 0;
    while (const auto leg = route.next(true)) {
      EXPECT_TRUE(kBox.contains(leg->goal.p_world_m));
      for (const Box3& box_m : kNoFly.boxes_m) {
        for (int i = 0; i <= 500; ++i) {
          const Vec3 p_m = at_m + 0.002 * i * (leg->goal.p_world_m - at_m);
          ASSERT_GT(box_m.exteriorDistance(p_m), kNoFly.margin_m - 1e-3) << p_m.transpose();
        }
      }
      scans += leg->is_scan ? 1 : 0;
      at_m = leg->goal.p_world_m;
      ASSERT_LT(scans, 1000);
    }
    EXPECT_GE(scans, 7);
    EXPECT_EQ(route.share_done(), 1.0);
  }
}

TEST(ProfileWithNoFly, ADescentKeepsTheLongestPieceThatIsLeft) {
  const auto legs = bounding_box_profile(kBox, {Vec3(-10, -20, 5), 0}, kNoFly);
  const auto heights = [&](double x_m, double y_m) {
    std::vector<double> z_m;
    for (const ProfileLeg& leg : legs) {
      const Vec3& p = leg.goal.p_world_m;
      if (p.x() == x_m && p.y() == y_m) z_m.push_back(p.z());
    }
    return z_m;
  };
  ASSERT_EQ(heights(0, -20).size(), 2U);  // under the first box: its floor less the margin
  EXPECT_NEAR(heights(0, -20)[0], 16.0 - 1.5, 2e-3);
  EXPECT_EQ(heights(0, -20)[1], 0.7);
  ASSERT_EQ(heights(20, 0).size(), 2U);  // a metre beside the second: over it
  EXPECT_EQ(heights(20, 0)[0], 20.0);
  EXPECT_NEAR(heights(20, 0)[1], 9.0 + std::sqrt(1.5 * 1.5 - 1.0), 2e-3);
  EXPECT_TRUE(heights(-20, 20).empty());
  EXPECT_EQ(heights(-20, -20), (std::vector<double>{20.0, 0.7}));
}

}  // namespace
}  // namespace gnbv
