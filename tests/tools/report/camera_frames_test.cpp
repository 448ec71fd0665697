// Laws of what the report takes from camera frames: the colours of points, and thumbnails.
#include "tools/report/camera_frames.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sensors/camera_model.hpp"
#include "sim/core/error.hpp"
#include "sim/core/image.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/report/jpeg.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// One camera that looks along +x from the origin. Its picture is red left and blue right, that of
/// view 1 the other way round.
TEST(CameraFrames, APointHasTheColourOfItsPixelAndThumbnailsKeepTheirBudget) {
  TempFolder temp;
  Image image{64, 48, {}};
  Image other{64, 48, {}};
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      constexpr Rgb8 kRed = {200, 0, 0};
      constexpr Rgb8 kBlue = {0, 0, 200};
      const Rgb8& left = x < 32 ? kRed : kBlue;
      const Rgb8& right = x < 32 ? kBlue : kRed;
      image.rgb.insert(image.rgb.end(), left.begin(), left.end());
      other.rgb.insert(other.rgb.end(), right.begin(), right.end());
    }
  }
  FrameRecord frames;
  frames.cameras = {{.name = "c",
                     .width_px = 64,
                     .height_px = 48,
                     .fx_px = 32.0,
                     .fy_px = 32.0,
                     .cx_px = 32.0,
                     .cy_px = 24.0}};
  for (int view = 0; view < 8; ++view) {
    const fs::path png = temp.path() / fmt::format("{}.png", view);
    const fs::path depth = temp.path() / fmt::format("{}.depth.png", view);
    write_png(view == 1 ? other : image, png);
    write_png(GreyImage16{64, 48, std::vector<std::uint16_t>(64 * 48, 4000)}, depth);
    frames.frames.push_back({.iteration = view, .colour = png, .depth = depth});
    frames.frames.back().T_world_camera.linear() = R_body_optical();
  }
  // profile: left (+y), beside every picture; view 0: left, right, left but hidden; view 1: left
  const RunCloud cloud{
      .points_world_m = {{4, 1.1F, 0}, {4, 3, 9}, {4, 1, 0}, {4, -1, 0}, {5, 1, 0}, {4, 1, 1}},
      .profile_points = 2,
      .view_points = {5, 6, 6, 6, 6, 6, 6, 6}};
  const std::vector<std::size_t> all = {0, 1, 2, 3, 4, 5};
  RunRecord record;
  for (int view = 0; view < 8; ++view) record.views.push_back({.iteration = view});
  const auto read = [&](std::size_t max_bytes, int threads) {
    return read_camera_frames(record, frames, cloud, all, max_bytes, threads, [](double) {});
  };
  const CameraFrames seen = read(1'000'000, 1);
  EXPECT_EQ(seen.colour[2], (Rgb8{200, 0, 0}));
  EXPECT_EQ(seen.colour[3], (Rgb8{0, 0, 200}));
  EXPECT_EQ(seen.colour[5], (Rgb8{0, 0, 200}));
  EXPECT_EQ(seen.colour[0], seen.colour[2]);
  EXPECT_EQ(seen.colour[1][0], 150);  // the grey of what no camera saw
  EXPECT_EQ(seen.colour[4][0], 150) << "its pixel shows what is before it";
  const std::vector<std::size_t> some = {0, 3, 5};
  const CameraFrames of_some =
      read_camera_frames(record, frames, cloud, some, 1'000'000, 1, [](double) {});
  EXPECT_EQ(of_some.colour, (std::vector{seen.colour[0], seen.colour[3], seen.colour[5]}));
  ASSERT_EQ(seen.thumbnails.size(), 8U);
  const Thumbnail& one = seen.thumbnails[0];
  const std::size_t each = one.jpeg.size() + one.depth_jpeg.size() + 6;  // as they are aligned
  const CameraFrames few = read(3 * each, 3);
  ASSERT_EQ(few.thumbnails.size(), 3U);  // views 0, 3, 6
  EXPECT_EQ(few.thumbnails[1].frame, 3U);
  EXPECT_EQ(few.colour, seen.colour);
  EXPECT_TRUE(few == read(3 * each, 1));
  EXPECT_TRUE(read(each / 2, 1).thumbnails.empty());
  for (const int threads : {2, 4, 7}) EXPECT_TRUE(read(1'000'000, threads) == seen) << threads;
  write_png(shrunk(image, 2), frames.frames[5].colour);
  EXPECT_THROW(read(1'000'000, 2), BadInput);
}

TEST(CameraFrames, DepthIsColouredByItsShareOfTheRange) {
  const GreyImage16 depth{4, 2, {0, 9, 4000, 9, 8000, 9, 60000, 9}};
  const Image picture = depth_picture(depth, 0.001, 8.0, 1);
  const auto pixel = [&](std::size_t i) {
    return Rgb8{picture.rgb[3 * i], picture.rgb[3 * i + 1], picture.rgb[3 * i + 2]};
  };
  EXPECT_EQ(pixel(0), (Rgb8{150, 156, 164}));
  EXPECT_EQ(pixel(4), (Rgb8{0xad, 0xdc, 0x30}));  // the far end of the ramp
  EXPECT_EQ(pixel(6), pixel(4));
  EXPECT_NE(pixel(2), pixel(4));
  const Image small = depth_picture(depth, 0.001, 8.0, 2);
  EXPECT_EQ(small.width_px, 2);
  EXPECT_EQ(small.rgb,
            (std::vector<std::uint8_t>{150, 156, 164, pixel(2)[0], pixel(2)[1], pixel(2)[2]}));
}

}  // namespace
}  // namespace gnbv
