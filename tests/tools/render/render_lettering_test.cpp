// Laws of words and colours on pictures.
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "sim/core/file.hpp"
#include "tests/tools/render/laid_out.hpp"
#include "tools/render/caption.hpp"

namespace gnbv {
namespace {

const Image kBlank = paper(200, 40);

Image drawn(std::string_view text) {
  Image image = kBlank;
  draw_text(image, text, 50.0, 30.0, 20.0, {0, 0, 0});
  return image;
}

/// visit(x, y) where the two are not the same.
void for_each_difference(const Image& a, const Image& b,
                         const std::function<void(int, int)>& visit) {
  for (int y = 0; y < a.height_px; ++y) {
    for (int x = 0; x < a.width_px; ++x) {
      if (a.at(x, y) != b.at(x, y)) visit(x, y);
    }
  }
}

TEST(Lettering, InkStaysWithinItsWidthAndThePicture) {
  for (char c = ' '; c <= '~'; ++c) {
    Image image = kBlank;
    const std::string text(1, c);
    const double end = draw_text(image, text, 50.0, 30.0, 20.0, {0, 0, 0});
    EXPECT_NEAR(end, 50.0 + text_width_px(text, 20.0), 1e-9);
    int inked = 0;
    for_each_difference(image, kBlank, [&](int x, int) {
      ++inked;
      EXPECT_TRUE(x >= 48 && x < end + 1.0) << text;  // a j and an f reach beyond
    });
    EXPECT_EQ(inked == 0, c == ' ') << text;
  }
  Image image = kBlank;
  draw_text(image, "clipped, \xc3\xa9", 185.0, 5.0, 30.0, {0, 0, 0});  // no other memory
  draw_text(image, "above and to the left", -40.0, -3.0, 30.0, {0, 0, 0});
  draw_line(image, {-50.0, -50.0}, {500.0, 90.0}, 3.0, {0, 0, 0});
  EXPECT_NE(image.rgb, kBlank.rgb);
}

using PixelBox2 = Eigen::AlignedBox2i;

/// What holds the pixels of which that is true.
PixelBox2 box_of(const Image& image, const std::function<bool(const Rgb8&)>& is_meant) {
  PixelBox2 box;
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      if (is_meant(image.at(x, y))) box.extend(Eigen::Vector2i(x, y));
    }
  }
  return box;
}
PixelBox2 box_of(const Image& image, const Rgb8& colour) {
  return box_of(image, [&](const Rgb8& at) { return at == colour; });
}

TEST(Lettering, ACapitalIsAsHighAsAskedFor) {
  const PixelBox2 ink = box_of(drawn("H"), [](const Rgb8& at) { return at[0] < 255; });
  EXPECT_EQ(ink.min().y(), 10);
  EXPECT_EQ(ink.max().y(), 29);  // the last row above the baseline
}

TEST(Lettering, EveryCodePointIsItsOwnLetter) {
  const double u_begins = 50.0 + text_width_px("K", 20.0);
  const double u_ends = 50.0 + text_width_px("Ku", 20.0);
  int dots = 0;
  for_each_difference(drawn("K\xc3\xbchlturm"), drawn("Kuhlturm"), [&](int x, int y) {
    ++dots;
    EXPECT_TRUE(x >= u_begins && x <= u_ends && y < 16) << x << ' ' << y;  // above the u
  });
  EXPECT_GT(dots, 4);
  EXPECT_NE(drawn("\xc2\xb2").rgb, drawn("\xc2\xb5").rgb);
  // bytes that are none, one by one
  EXPECT_EQ(drawn("a\xff\xc3").rgb, drawn("a\xef\xbf\xbd\xef\xbf\xbd").rgb);
  EXPECT_NE(drawn("a\xff").rgb, drawn("a").rgb);
}

TEST(Lettering, LongTextsFit) {
  const std::string title(200, 'W');
  const double height_px = fitting_height_px(title, 15.0, 500.0);
  EXPECT_NEAR(text_width_px(title, height_px), 500.0, 1e-9);
  EXPECT_EQ(fitting_height_px("short", 15.0, 500.0), 15.0);
  EXPECT_EQ(fitting_height_px("", 15.0, 500.0), 15.0);
}

TEST(Lettering, WhatIsNoFontIsNamed) {
  const TempFolder temp;
  const std::string text_file = temp.path() / "letters.ttf";
  write_file_atomically(text_file, "these are no letters");
  for (const std::string& file : {text_file, std::string("/nowhere/sans.ttf")}) {
    setenv("GNBV_FONT", file.c_str(), 1);
    std::thread([&] {  // a thread reads its font when it draws its first letter
      EXPECT_TRUE(test::says(test::fault_of([] { drawn("a"); }), {file, "GNBV_FONT"}));
    })
        .join();
  }
  unsetenv("GNBV_FONT");
}

Image captioned(Image image, const Caption& caption) {
  draw_caption(image, caption);
  return image;
}

/// The legend of panels is read as a text is: groups begin rows at the left, all of it on its
/// paper.
TEST(Caption, OnPaperGroupsBeginRowsAtTheLeft) {
  for (const bool begins_row : {false, true}) {
    const Image image = captioned(
        paper(640, 360),
        {.title = "",
         .detail = "",
         .legend = {{"a", {srgb(0xff0000)}},
                    {.label = "b", .colours = {srgb(0x0000ff)}, .begins_row = begins_row}},
         .paper_px = 60});
    const PixelBox2 red = box_of(image, {255, 0, 0});
    const PixelBox2 blue = box_of(image, {0, 0, 255});
    EXPECT_EQ(red.min().y() == blue.min().y(), !begins_row);
    EXPECT_EQ(red.max().y() < blue.min().y(), begins_row);
    EXPECT_EQ(red.min().x() == blue.min().x(), begins_row);
    EXPECT_EQ(red.max().x() < blue.min().x(), !begins_row);
    EXPECT_TRUE(red.min().y() >= 300 && blue.max().y() < 360);
  }
}

/// What the middle of a bar stands for is set upon it, in what can be read there.
TEST(Caption, ABarsMiddleStandsUponIt) {
  const auto bar_with = [](const std::string& middle, const Rgb& colour) {
    const LegendItem bar{.label = "", .colours = {colour, colour}, .label_middle = middle};
    return captioned(paper(640, 360, 200),
                     {.title = "", .detail = "", .legend = {bar}, .paper_px = 60});
  };
  for (const auto& [rrggbb, ink] :
       {std::pair{0x20104aU, Rgb8{255, 255, 255}}, std::pair{0xe8e070U, kInk}}) {
    const Rgb8 colour = to_rgb8(srgb(rrggbb));
    const PixelBox2 bare = box_of(bar_with("", srgb(rrggbb)), colour);
    const Image image = bar_with("1,234", srgb(rrggbb));
    const PixelBox2 bar = box_of(image, colour);
    ASSERT_FALSE(bare.isEmpty());
    EXPECT_EQ(bar.min().x(), bare.min().x());  // no longer
    EXPECT_EQ(bar.max().x(), bare.max().x());
    int letters = 0;
    for (int x = bar.center().x() - 20; x <= bar.center().x() + 20; ++x) {
      for (int y = bar.min().y(); y <= bar.max().y(); ++y) {
        const Rgb8 at = image.at(x, y);
        letters += std::abs(at[0] - ink[0]) < 60 && std::abs(at[2] - ink[2]) < 60 ? 1 : 0;
      }
    }
    EXPECT_GT(letters, 5) << rrggbb;
  }
}

/// Pictures that will be shown smaller ask for larger words: all of a caption grows with them.
TEST(Caption, LettersAreAsLargeAsAskedFor) {
  const auto rows = [](double letters) {
    const Image image =
        captioned(paper(1280, 720),
                  {.title = "", .detail = "H", .legend = {}, .letters = letters, .paper_px = 60});
    return box_of(image, [](const Rgb8& at) { return at[0] <= 128; }).sizes().y() + 1;
  };
  EXPECT_NEAR(rows(2.0), 2.0 * rows(1.0), 2.0);
  EXPECT_GT(rows(1.0), 5);
}

TEST(Colour, RampsRunFromFirstToLastAndSrgbRoundTrips) {
  EXPECT_EQ(path_ramp(-1.0), path_ramp(0.0));
  EXPECT_EQ(path_ramp(2.0), path_ramp(1.0));
  EXPECT_EQ(to_rgb8(path_ramp(0.0)), (Rgb8{0x2b, 0x0f, 0x8a}));
  EXPECT_EQ(to_rgb8(path_ramp(1.0)), (Rgb8{0xf9, 0xa0, 0x1f}));
  EXPECT_EQ(to_rgb8(srgb(0x0180fe)), (Rgb8{0x01, 0x80, 0xfe}));
}

TEST(PlaceMarks, NoBadgeLiesOnAnother) {
  const RenderView view{
      .width_px = 400, .height_px = 300, .T_world_camera = look_at({0, -10, 0}, {0, 0, 0})};
  const auto badge_px = [&](std::initializer_list<double> places) {
    Panel panel;
    for (const double x : places) panel.labels.push_back({Vec3(x, 0, 0), "1", srgb(0x005ac8)});
    Image image = paper(400, 300, 200);
    draw_place_marks(panel, view, 1.0, true, image);
    int count = 0;
    for (int y = 0; y < 300; ++y) {
      for (int x = 0; x < 400; ++x) count += image.at(x, y) == Rgb8{0, 0x5a, 0xc8} ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(badge_px({0.0, 0.1}), badge_px({0.0}));
  EXPECT_NEAR(badge_px({0.0, 1.0}), 2 * badge_px({0.0}), 0.2 * badge_px({0.0}));
}

/// What a page draws by name has a name of its own, and a layer that there is.
TEST(Looks, HaveNamesOfTheirOwnAndKnownLayers) {
  std::set<std::string_view> names, layers{""};
  for (const SceneLayer& layer : scene_layers()) EXPECT_TRUE(layers.insert(layer.name).second);
  for (const Look* const look : all_looks()) {
    EXPECT_TRUE(names.insert(look->name).second) << look->name;
    EXPECT_TRUE(layers.contains(look->layer)) << look->name;
  }
}

/// Hues alone would not do for everybody: Oklab distances (Ottosson 2020).
TEST(Looks, TheColoursOfReasonsAndMarksStandApart) {
  std::vector<Rgb> colours = {looks::kChosen.rgb(), looks::kRayHit.rgb()};
  for (const RejectionLook& look : rejection_looks()) {
    EXPECT_EQ(static_cast<std::size_t>(look.rejection), colours.size() - 2);  // in their order
    colours.push_back(look.rgb());
  }
  const auto oklab = [](const Rgb& c) {
    const Vec3 rgb(c[0], c[1], c[2]);
    const Eigen::Matrix3d lms{{0.4122214708, 0.5363325363, 0.0514459929},
                              {0.2119034982, 0.6806995451, 0.1073969566},
                              {0.0883024619, 0.2817188376, 0.6299787005}};
    const Eigen::Matrix3d lab{{0.2104542553, 0.7936177850, -0.0040720468},
                              {1.9779984951, -2.4285922050, 0.4505937099},
                              {0.0259040371, 0.7827717662, -0.8086757660}};
    return Vec3(lab * Vec3(lms * rgb).array().pow(1.0 / 3.0).matrix());
  };
  constexpr double kApart = 0.13;  // six times what is just noticed side by side
  for (std::size_t i = 0; i < colours.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GT((oklab(colours[i]) - oklab(colours[k])).norm(), kApart) << i << " and " << k;
    }
  }
}

}  // namespace
}  // namespace gnbv
