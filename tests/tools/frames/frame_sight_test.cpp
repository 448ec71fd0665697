// Laws of what a frame shows: a point is seen where it projects, unless the depth image says that
// something else is there, and a cloud has the colours of the frames that brought it.
#include "tools/frames/frame_sight.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <mutex>

#include "tests/support/temp_folder.hpp"

namespace gnbv {
namespace {

constexpr int kWidth_px = 64;
constexpr int kHeight_px = 48;

/// Cameras of 64 x 48 px and 32 px of focal length that look along +x.
class FrameSightTest : public ::testing::Test {
 protected:
  FrameSightTest() {
    frames_.cameras = {{.name = "c",
                        .width_px = kWidth_px,
                        .height_px = kHeight_px,
                        .fx_px = 32.0,
                        .fy_px = 32.0,
                        .cx_px = 32.0,
                        .cy_px = 24.0}};
  }

  /// A frame of one colour, with depths of its left and its right half.
  void add(int iteration, const Vec3& p_world_m, const Rgb8& rgb, int left_mm, int right_mm) {
    Image colour{kWidth_px, kHeight_px, {}};
    GreyImage16 depth{kWidth_px, kHeight_px, {}};
    for (int i = 0; i < kWidth_px * kHeight_px; ++i) {
      colour.rgb.insert(colour.rgb.end(), rgb.begin(), rgb.end());
      const bool is_left = i % kWidth_px < kWidth_px / 2;
      depth.values.push_back(static_cast<std::uint16_t>(is_left ? left_mm : right_mm));
    }
    const std::size_t number = frames_.frames.size();
    RecordedFrame frame{.iteration = iteration,
                        .colour = temp_.path() / fmt::format("{}.rgb.png", number),
                        .depth = temp_.path() / fmt::format("{}.depth.png", number)};
    frame.T_world_camera.translate(p_world_m);
    frame.T_world_camera.rotate(R_body_optical());
    write_png(colour, frame.colour);
    write_png(depth, frame.depth);
    frames_.frames.push_back(frame);
  }

  TempFolder temp_;
  FrameRecord frames_;
};

TEST_F(FrameSightTest, SeesAPointWhereItProjectsUnlessSomethingElseIsThere) {
  add(0, Vec3::Zero(), {7, 8, 9}, 2000, 4000);
  const FrameSight sight(frames_, 0);
  const auto seen = sight.sees(Vec3(4, -1, 0.5), 0.0);
  ASSERT_TRUE(seen.has_value());
  EXPECT_NEAR(seen->u_px, 40.0, 1e-9);
  EXPECT_NEAR(seen->v_px, 20.0, 1e-9);
  EXPECT_NEAR(seen->z_m, 4.0, 1e-9);
  EXPECT_EQ(sight.colour_at(*seen), (Rgb8{7, 8, 9}));
  EXPECT_FALSE(sight.sees(Vec3(4, 1, 0.5), 0.0)) << "2 m away, something hides it";
  EXPECT_TRUE(sight.sees(Vec3(2, 1, 0.5), 0.0));
  for (const Vec3& beside : {Vec3(4, -5, 0), Vec3(4, 5, 0), Vec3(4, -1, 5), Vec3(4, -1, -5)}) {
    EXPECT_FALSE(sight.sees(beside, 100.0)) << beside.transpose();
  }
  EXPECT_FALSE(sight.sees(Vec3(-4, 1, 0), 100.0)) << "behind the camera";
}

TEST_F(FrameSightTest, AllowsForASteepSurfaceAndForBlur) {
  add(0, Vec3::Zero(), {0, 0, 0}, 0, 4000);
  const FrameSight sight(frames_, 0);
  EXPECT_FALSE(sight.sees(Vec3(4, 1, 0), 100.0)) << "nothing was measured there";
  // half a pixel of a surface at 80 degrees, 4 m away: 4 / 32 / 2 * tan(80 deg) = 0.354 m
  EXPECT_TRUE(sight.sees(Vec3(4.35, -1, 0), 0.0));
  EXPECT_FALSE(sight.sees(Vec3(4.45, -1, 0), 0.0));
  EXPECT_TRUE(sight.sees(Vec3(4.45, -1, 0), 0.1));
}

TEST_F(FrameSightTest, EachFrameIsLookedAtOnce) {
  constexpr std::uint8_t kFrames = 40;  // more than are held at once
  for (std::uint8_t i = 0; i < kFrames; ++i) add(i, Vec3::Zero(), {i, 0, 0}, 4000, 4000);
  for (const int threads : {1, 2}) {
    std::mutex mutex;
    std::map<std::size_t, int> reds;
    double done = 0.0;
    for_each_frame(
        frames_, threads,
        [&](double share) {
          EXPECT_GE(share, done);
          done = share;
        },
        [&](std::size_t frame, const FrameSight& sight) {
          const Rgb8 rgb = sight.colour_at({.u_px = 1.0, .v_px = 1.0});
          const std::lock_guard lock(mutex);
          EXPECT_TRUE(reds.emplace(frame, rgb[0]).second) << "twice";
        });
    EXPECT_EQ(done, 1.0);
    EXPECT_EQ(reds.size(), kFrames);
    for (const auto& [frame, red] : reds) EXPECT_EQ(red, static_cast<int>(frame));
  }
}

TEST_F(FrameSightTest, APointHasTheColourOfTheNearestFrameOfItsView) {
  add(0, Vec3(0, 0, 0), {10, 0, 0}, 4000, 4000);
  add(0, Vec3(1, 0, 0), {20, 0, 0}, 3000, 3000);
  add(1, Vec3(2, 0, 0), {30, 0, 0}, 2000, 2000);
  RunRecord record;
  record.views.resize(2);
  record.views[1].iteration = 1;
  // a point of the profile, one of each view, one from after the last view, one that nobody sees
  const RunCloud cloud{
      .points_world_m = {{4, 0.1F, 0}, {4, 0.2F, 0}, {4, 0.3F, 0}, {4, 0.4F, 0}, {-4, 0, 0}},
      .profile_points = 1,
      .view_points = {2, 3}};
  for (const int threads : {1, 3}) {
    const auto colours = colours_of_cloud(record, cloud, frames_, threads, [](double) {});
    EXPECT_EQ(colours,
              (std::vector<Rgb8>{{30, 0, 0}, {20, 0, 0}, {30, 0, 0}, {30, 0, 0}, kNoColour}));
  }
}

/// Cameras that run in flight bring points that the view at the end of the leg may not show.
TEST_F(FrameSightTest, APointSeenInFlightHasTheColourOfTheNearestFrameWhoseDepthAgrees) {
  add(0, Vec3(0, 0, 0), {10, 0, 0}, 4000, 4000);
  add(1, Vec3(8, 0, 0), {20, 0, 0}, 4000, 4000);  // beyond the points of its own leg
  add(2, Vec3(2, 0, 0), {30, 0, 0}, 1000, 1000);  // nearest, but something is before them
  add(3, Vec3(1, 0, 0), {40, 0, 0}, 3000, 3000);
  RunRecord record;
  record.views.resize(4);
  for (int view = 0; view < 4; ++view)
    record.views[static_cast<std::size_t>(view)].iteration = view;
  record.scenario.cameras.resize(1);
  // of view 0, seen by it and nearer by view 3; two of the leg to view 1, one of them hidden to all
  const RunCloud cloud{.points_world_m = {{4, 0.1F, 0}, {4, 0.2F, 0}, {6, 0.3F, 0}},
                       .profile_points = 0,
                       .view_points = {1, 3, 3, 3}};
  const auto colours = [&](double rate_hz, int threads) {
    record.scenario.cameras[0].rate_hz = rate_hz;
    return colours_of_cloud(record, cloud, frames_, threads, [](double) {});
  };
  EXPECT_EQ(colours(0.0, 1), (std::vector<Rgb8>{{10, 0, 0}, kNoColour, kNoColour}));
  for (const int threads : {1, 3}) {
    EXPECT_EQ(colours(2.0, threads), (std::vector<Rgb8>{{10, 0, 0}, {40, 0, 0}, kNoColour}));
  }
}

}  // namespace
}  // namespace gnbv
