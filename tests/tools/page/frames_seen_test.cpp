// Laws of what pages take from camera frames: thumbnails, the colours of points, the cloud that
// stands in for one that is not written yet; each image is read once.
#include "tools/page/frames_seen.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <map>
#include <set>

#include "sim/core/error.hpp"
#include "tests/support/made_frames.hpp"
#include "tests/support/made_run.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/page/jpeg.hpp"
#include "tools/page/packs.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

constexpr Rgb8 kRed = {200, 0, 0};
constexpr Rgb8 kBlue = {0, 0, 200};

Image halves(const Rgb8& left, const Rgb8& right) {
  Image image{64, 48, {}};
  for (int i = 0; i < 64 * 48; ++i) {
    const Rgb8& rgb = i % 64 < 32 ? left : right;
    image.rgb.insert(image.rgb.end(), rgb.begin(), rgb.end());
  }
  return image;
}

/// One camera that looks along +x from the origin.
class FramesSeenTest : public testing::Test {
 protected:
  FramesSeenTest() {
    frames_.cameras = {{.name = "c",
                        .width_px = 64,
                        .height_px = 48,
                        .fx_px = 32.0,
                        .fy_px = 32.0,
                        .cx_px = 32.0,
                        .cy_px = 24.0}};
  }
  void add(int view, const Image& colour, const GreyImage16& depth) {
    RecordedFrame frame{.iteration = view,
                        .colour = temp_.path() / fmt::format("{}.png", view),
                        .depth = temp_.path() / fmt::format("{}.depth.png", view)};
    frame.T_world_camera.linear() = R_body_optical();
    write_png(colour, frame.colour);
    write_png(depth, frame.depth);
    frames_.frames.push_back(frame);
  }
  static GreyImage16 wall(std::uint16_t left_mm, std::uint16_t right_mm) {
    GreyImage16 depth{64, 48, {}};
    for (int i = 0; i < 64 * 48; ++i) depth.values.push_back(i % 64 < 32 ? left_mm : right_mm);
    return depth;
  }

  TempFolder temp_;
  FrameRecord frames_;
  RunRecord record_;
};

/// Pictures are red left and blue right, that of view 1 the other way round.
TEST_F(FramesSeenTest, APointHasTheColourOfItsPixel) {
  for (int view = 0; view < 8; ++view) {
    add(view, view == 1 ? halves(kBlue, kRed) : halves(kRed, kBlue), wall(4000, 4000));
    record_.views.push_back({.iteration = view});
  }
  // profile: left (+y), beside every picture; view 0: left, right, left but hidden; view 1: left
  const RunCloud cloud{
      .points_world_m = {{4, 1.1F, 0}, {4, 3, 9}, {4, 1, 0}, {4, -1, 0}, {5, 1, 0}, {4, 1, 1}},
      .profile_points = 2,
      .view_points = {5, 6, 6, 6, 6, 6, 6, 6}};
  const std::vector<std::size_t> all = {0, 1, 2, 3, 4, 5};
  const auto look = [&](int threads) {
    return look_at_frames(record_, frames_, cloud, all, threads, [](double) {});
  };
  const FramesSeen seen = look(1);
  const Rgb8 grey = seen.colour[1];  // what no camera saw
  EXPECT_EQ(seen.colour, (std::vector<Rgb8>{kRed, grey, kRed, kBlue, grey, kBlue}))
      << "the pixel of the fifth shows what is before it";
  for (const int threads : {2, 7}) EXPECT_TRUE(look(threads) == seen) << threads;
  ASSERT_EQ(seen.thumbnails.size(), 8U);
  write_png(shrunk(halves(kRed, kBlue), 2), frames_.frames[5].colour);
  EXPECT_THROW(look(2), BadInput);
}

/// A wall at 4 m, seen by view 0 and, in front of another one at 3 m in the left half of the
/// picture, by view 2; view 1 has no frame.
TEST_F(FramesSeenTest, AGrowingCloudHoldsWhatImagesShowAboveTheFloorOnceALeaf) {
  GreyImage16 first = wall(4000, 4000);
  first.values[0] = 0;
  add(0, halves(kRed, kBlue), first);
  add(2, halves(kBlue, kRed), wall(3000, 4000));
  for (int view = 0; view < 3; ++view) record_.views.push_back({.iteration = view});
  record_.scenario.planner.floor_z_m = -0.5;
  record_.scenario.planner.cloud.leaf_m = 0.25;
  RunCloud cloud;
  const FramesSeen seen = look_at_growing_frames(
      record_, frames_, 1, [](double) {}, cloud);
  ASSERT_EQ(cloud.view_points.size(), 3U);
  ASSERT_EQ(seen.colour.size(), cloud.points_world_m.size());
  EXPECT_EQ(seen.thumbnails.size(), 2U);
  EXPECT_EQ(cloud.profile_points, 0U);
  EXPECT_GT(cloud.view_points[0], 300U);
  EXPECT_EQ(cloud.view_points[1], cloud.view_points[0]);
  EXPECT_GT(cloud.view_points[2], cloud.view_points[1]);
  EXPECT_EQ(cloud.view_points[2], cloud.points_world_m.size());
  for (std::size_t i = 0; i < cloud.points_world_m.size(); ++i) {
    const Vec3f& p_m = cloud.points_world_m[i];
    const bool is_first = i < cloud.view_points[1];
    EXPECT_NEAR(p_m.x(), is_first ? 4.0 : 3.0, 1e-5);
    EXPECT_GE(p_m.z(), -0.5F);
    EXPECT_LE(p_m.z(), 3.0F);
    EXPECT_GE(p_m.y(), is_first ? -4.0F : 0.0F) << "the left half is at +y";
    EXPECT_EQ(seen.colour[i], is_first && p_m.y() > 0.0F ? kRed : kBlue);
  }
  EXPECT_EQ(first_points(cloud.points_world_m, 0.25).size(), cloud.points_world_m.size());
  RunCloud again;
  EXPECT_TRUE(look_at_growing_frames(
                  record_, frames_, 3, [](double) {}, again) == seen);
  EXPECT_EQ(again.points_world_m, cloud.points_world_m);
}

TEST(DepthPicture, IsColouredByItsShareOfTheRange) {
  const GreyImage16 depth{4, 2, {0, 9, 4000, 9, 8000, 9, 60000, 9}};
  const Image picture = depth_picture(depth, 0.001, 8.0, 1);
  const Rgb8 grey = picture.at(0, 0);  // nothing there
  EXPECT_EQ(picture.at(0, 1), picture.at(2, 1)) << "the far end of the ramp";
  EXPECT_NE(picture.at(2, 0), picture.at(0, 1));
  const Image small = depth_picture(depth, 0.001, 8.0, 2);
  EXPECT_EQ(small.width_px, 2);
  EXPECT_EQ(small.at(0, 0), grey);
  EXPECT_EQ(small.at(1, 0), picture.at(2, 0));
}

TEST(Thumbnails, APixelIsTheMeanOfTheSquareItReplaces) {
  const Image image{4, 2, {0,  0, 0, 10, 0, 0, 9, 9, 9, 9, 9, 9,  //
                           20, 0, 0, 30, 0, 0, 9, 9, 9, 9, 9, 9}};
  const Image half = shrunk(image, 2);
  EXPECT_EQ(half.height_px, 1);
  EXPECT_EQ(half.at(0, 0), (Rgb8{15, 0, 0}));
  EXPECT_EQ(half.at(1, 0), (Rgb8{9, 9, 9}));
  const std::vector<std::uint8_t> jpeg = jpeg_bytes(half, 80);
  ASSERT_GT(jpeg.size(), 4U);
  EXPECT_EQ(jpeg[0] << 8U | jpeg[1], 0xffd8);  // start and end of image, ITU T.81 B.1.1.3
  EXPECT_EQ(jpeg[jpeg.size() - 2] << 8U | jpeg.back(), 0xffd9);
}

TEST(FramesSeen, AreOfEveryNthViewWhereThereIsNoRoomForAll) {
  TempFolder temp;
  write_made_run(temp.path());
  write_made_frames(temp.path());
  const RunRecord record = read_run(temp.path());
  std::set<std::vector<int>> all;
  for (std::size_t bytes = 1'000; bytes < 20'000; bytes += 200) {
    page::Arrays arrays;
    page::RunData run;
    pack_run(
        record, nullptr, {.bytes = bytes, .points = 1}, 1, [](double) {}, arrays, run);
    std::vector<int> views;
    for (const page::FrameData& frame : run.frames) views.push_back(frame.view);
    all.insert(views);
  }
  EXPECT_EQ(all, (std::set<std::vector<int>>{{}, {0}, {0, 2}, {0, 1, 2}}));
}

/// Of a run that has ended and of one that still flies.
TEST(FramesSeen, EachImageIsReadOnce) {
  for (const bool is_growing : {false, true}) {
    TempFolder temp;
    write_made_run(temp.path());
    write_made_frames(temp.path());
    if (is_growing) fs::remove(temp.path() / "cloud.ply");
    const int events = inotify_init1(IN_NONBLOCK);
    ASSERT_GE(inotify_add_watch(events, (temp.path() / "frames").c_str(), IN_OPEN), 0);
    page::Arrays arrays;
    page::RunData run;
    pack_run(
        read_run(temp.path()), nullptr, {.bytes = 1'000'000, .points = 100}, 1, [](double) {},
        arrays, run);
    EXPECT_EQ(run.frames.size(), 3U);
    EXPECT_TRUE(run.cloud && run.cloud->colour);
    std::map<std::string, int> opened;
    alignas(inotify_event) std::array<char, 1 << 16> buffer{};
    const ssize_t size = read(events, buffer.data(), buffer.size());
    for (ssize_t at = 0; at < size;) {
      const auto* const event = reinterpret_cast<const inotify_event*>(buffer.data() + at);
      if (event->len > 0) ++opened[event->name];
      at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
    }
    close(events);
    for (const char* const png : {"0.png", "1.png", "2.png", "depth_0.png"}) {
      EXPECT_EQ(opened[png], 1) << png << (is_growing ? " of a growing run" : "");
    }
  }
}

}  // namespace
}  // namespace gnbv
