// Laws of words and colours on pictures.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tools/render/caption.hpp"
#include "tools/render/lettering.hpp"

namespace gnbv {
namespace {

TEST(Lettering, InkStaysWithinItsWidthAndThePicture) {
  const Image blank{200, 40, std::vector<std::uint8_t>(200 * 40 * 3, 255)};
  std::string all;
  for (char c = ' '; c <= '~'; ++c) all += c;
  for (const char c : all) {
    Image image = blank;
    const std::string text(1, c);
    const double end = draw_text(image, text, 50.0, 30.0, 20.0, {0, 0, 0});
    EXPECT_NEAR(end, 50.0 + text_width_px(text, 20.0), 1e-9);
    int inked = 0;
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 200; ++x) {
        if (image.at(x, y)[0] == 255) continue;
        ++inked;
        EXPECT_TRUE(x >= 47 && x < end) << text;  // a pen's half width (1.2 px) to the left
      }
    }
    EXPECT_EQ(inked == 0, c == ' ') << text;
  }
  Image image = blank;
  draw_text(image, "clipped, \xc3\xa9", 185.0, 5.0, 30.0,
            {0, 0, 0});  // must not touch other memory
  draw_line(image, {-50.0, -50.0}, {500.0, 90.0}, 3.0, {0, 0, 0});
  EXPECT_NE(image.rgb, blank.rgb);
}

TEST(Lettering, CodePointsCountOnceAndLongTextsFit) {
  // one '?' for each of two, three and four bytes
  for (const char* const letter : {"\xc3\xa9", "\xe2\x82\xac", "\xf0\x9f\x9a\x81"}) {
    EXPECT_EQ(text_width_px(letter, 20.0), text_width_px("?", 20.0));
  }
  const std::string title(200, 'W');
  const double height_px = fitting_height_px(title, 15.0, 500.0);
  EXPECT_NEAR(text_width_px(title, height_px), 500.0, 1e-9);
  EXPECT_EQ(fitting_height_px("short", 15.0, 500.0), 15.0);
  EXPECT_EQ(fitting_height_px("", 15.0, 500.0), 15.0);
}

/// However small the picture and long the words, the scale can be read.
TEST(Caption, NoLegendLiesOnTheScale) {
  const auto drawn = [](int width_px, const std::vector<LegendItem>& legend) {
    Image image{width_px, 240, {}};
    image.rgb.assign(static_cast<std::size_t>(3 * width_px * image.height_px), 255);
    RenderView view;
    view.width_px = width_px;
    view.height_px = image.height_px;
    draw_caption(image, {.title = "t", .detail = "d", .legend = legend}, view);
    return image;
  };
  const LegendItem bar{
      .label = "216 or more points a voxel", .colours = path_colours(), .label_before = "1"};
  for (const int width_px : {320, 330, 340, 420, 640}) {
    const Image scale = drawn(width_px, {});
    const Image both = drawn(width_px, {bar, {"covered", {srgb(0x123456)}}, bar});
    for (int y = 120; y < 240; ++y) {
      for (int x = 0; x < width_px; ++x) {
        if (scale.at(x, y) == Rgb8{255, 255, 255}) continue;
        EXPECT_EQ(both.at(x, y), scale.at(x, y)) << width_px << ": " << x << ' ' << y;
      }
    }
  }
}

TEST(Colour, RampsRunFromFirstToLastAndSrgbRoundTrips) {
  EXPECT_EQ(path_ramp(-1.0), path_ramp(0.0));
  EXPECT_EQ(path_ramp(2.0), path_ramp(1.0));
  EXPECT_EQ(to_rgb8(path_ramp(0.0)), (Rgb8{0x2b, 0x0f, 0x8a}));
  EXPECT_EQ(to_rgb8(path_ramp(1.0)), (Rgb8{0xf9, 0xa0, 0x1f}));
  EXPECT_EQ(to_rgb8(srgb(0x0180fe)), (Rgb8{0x01, 0x80, 0xfe}));
}

}  // namespace
}  // namespace gnbv
