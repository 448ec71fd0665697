// Views that users give: what is read, what is refused, and that nothing is lost on the way to the
// scenario and back.
#include "tools/run/user_views.hpp"

#include <gtest/gtest.h>

#include "scenarios/load.hpp"
#include "sim/core/file.hpp"
#include "sim/core/rng.hpp"
#include "tests/support/fault.hpp"
#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

std::vector<ViewPose> views_in(const std::string& text) {
  TempFolder temp;
  write_file_atomically(temp.path() / "views", text);
  return read_user_views(temp.path() / "views");
}

/// What is said about the text, from the file's name on.
std::string complaint_about(const std::string& text) {
  const std::string what = test::fault_of([&] { views_in(text); });
  return what.substr(what.rfind("/views") + 1);
}

ViewPose drawn_view(std::uint64_t i) {
  const auto draw = [&](std::uint64_t axis) { return uniform01({5, Stream::bench, i, axis}); };
  return {Vec3(20.0 * draw(0) - 10.0, 1e-7 * draw(1), 8.0 * draw(2)),
          deg_to_rad(360.0 * draw(3) - 180.0), deg_to_rad(180.0 * draw(4) - 90.0)};
}

TEST(GivenViews, AQuaternionTurnsAsMuchAsItsYaw) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    ViewPose view = drawn_view(i);
    const Eigen::Quaterniond q(Eigen::AngleAxisd(view.yaw_rad, Vec3::UnitZ()));
    const Vec3& p = view.p_world_m;
    const std::vector<ViewPose> tum =
        views_in(fmt::format("# time x y z qx qy qz qw\n{} {} {}  {} {} {} {} {}\r\n", 0.1, p.x(),
                             p.y(), p.z(), q.x(), q.y(), q.z(), q.w()));
    ASSERT_EQ(tum.size(), 1U);
    EXPECT_EQ(tum[0].p_world_m, p);
    EXPECT_NEAR(wrap_angle_rad(tum[0].yaw_rad - view.yaw_rad), 0.0, 1e-12);
    const std::vector<ViewPose> csv =
        views_in(fmt::format("qw,x,y,z,qx,qy,qz\n\n{},{},{},{},{},{},{}\n", q.w(), p.x(), p.y(),
                             p.z(), q.x(), q.y(), q.z()));
    ASSERT_EQ(csv.size(), 1U);
    EXPECT_TRUE(is_same_view(csv[0], tum[0]));
  }
}

TEST(GivenViews, OnlyTheHeadingOfATiltedBodyIsFlown) {
  const Eigen::Quaterniond q =
      Eigen::AngleAxisd(0.7, Vec3::UnitZ()) * Eigen::AngleAxisd(deg_to_rad(20.0), Vec3::UnitY());
  const auto views =
      views_in(fmt::format("0 1 2 3 {} {} {} {}", q.x(), q.y(), q.z(), q.w()));  // no last newline
  EXPECT_NEAR(views.at(0).yaw_rad, 0.7, 1e-9);
}

TEST(GivenViews, EveryViewComesBackBitForBit) {
  std::vector<ViewPose> views;
  for (std::uint64_t i = 0; i < 200; ++i) views.push_back(drawn_view(i));
  std::vector<UserView> given;
  for (const ViewPose& view : views) given.push_back({view});
  given[1].rejected = Rejection::collision;
  given[2].iteration = 7;
  const std::string csv = user_views_csv(given);
  EXPECT_NE(csv.find(",refused,collision,\n"), std::string::npos);
  EXPECT_NE(csv.find(",flown,,7\n"), std::string::npos);
  const Scenario scenario = load_scenario("smoke", {views_override(views)});
  TempFolder temp;
  write_file_atomically(temp.path() / "s.yaml", to_yaml(scenario));
  const Scenario again = load_scenario((temp.path() / "s.yaml").string(), {});
  for (const auto& read :
       {views_in(csv), scenario.planner.routes.views, again.planner.routes.views}) {
    ASSERT_EQ(read.size(), views.size());
    for (std::size_t i = 0; i < views.size(); ++i)
      EXPECT_TRUE(is_same_view(read[i], views[i])) << i;
  }
}

TEST(GivenViews, RefusedWithFileLineAndValue) {
  const std::string header = "x,y,z,yaw_deg\n";
  EXPECT_EQ(complaint_about(""), "views: holds no view");
  EXPECT_EQ(complaint_about(header), "views: holds no view");
  EXPECT_EQ(complaint_about(header + "1,2,3,4\n1,2,3,north\n"),
            "views:3: yaw_deg `north` is not a number");
  EXPECT_EQ(complaint_about(header + "1,2,nan,4\n"), "views:2: z `nan` is not a number");
  EXPECT_EQ(complaint_about(header + "1,2,3,361\n"),
            "views:2: yaw_deg `361` is out of range (allowed: from -360 to 360)");
  EXPECT_EQ(complaint_about(header + "1,2e6,3,0\n"),
            "views:2: y `2e6` is out of range (allowed: from -1000000 to 1000000)");
  EXPECT_EQ(complaint_about(header + "1,2,3\n"),
            "views:2: `1,2,3` has 3 values, not 4: x,y,z,yaw_deg");
  EXPECT_EQ(complaint_about(header + "1,2,3,\n"), "views:2: yaw_deg `` is not a number");
  EXPECT_EQ(complaint_about("1 2 3 4\n"),
            "views:1: `1 2 3 4` has 4 values, not 8: t x y z qx qy qz qw");
  EXPECT_EQ(complaint_about("0 1 2 3 0 0 0 2\n"), "views:1: qx qy qz qw are no unit quaternion");
  for (const auto& [wrong, why] : std::vector<std::pair<std::string, std::string>>{
           {"x,y,z,yaw\n", "column `yaw` is not known"},
           {"x,y,z,x,yaw_deg\n", "column `x` stands twice"},
           {"x,y,yaw_deg\n", "has no column `z`"},
           {"x,y,z\n", "says nowhere where a view looks"},
           {"x,y,z,qx,qy\n", "has only a part of qx,qy,qz,qw"},
           {"x,y,z,yaw_deg,qw\n", "has yaw_deg and a quaternion"},
           {"1,2,3,4\n", "column `1` is not known"}}) {
    EXPECT_TRUE(complaint_about(wrong).starts_with("views:1: " + why)) << complaint_about(wrong);
  }
}

/// The classic slip: the pose of a camera, whose z axis looks forward.
TEST(GivenViews, AnOpticalFrameIsRefused) {
  const std::string what = complaint_about("0 1 2 3 -0.5 0.5 -0.5 0.5\n");
  EXPECT_TRUE(what.starts_with("views:1: qx qy qz qw tilt the body by 90 degrees")) << what;
}

}  // namespace
}  // namespace gnbv
