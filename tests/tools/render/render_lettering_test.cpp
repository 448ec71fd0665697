// Laws of words and colours on pictures.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/render/caption.hpp"
#include "tools/render/lettering.hpp"

namespace gnbv {
namespace {

const Image kBlank{200, 40, std::vector<std::uint8_t>(200 * 40 * 3, 255)};

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

TEST(Lettering, ACapitalIsAsHighAsAskedFor) {
  int top = 40;
  int bottom = 0;
  for_each_difference(drawn("H"), kBlank, [&](int, int y) {
    top = std::min(top, y);
    bottom = std::max(bottom, y);
  });
  EXPECT_EQ(top, 10);
  EXPECT_EQ(bottom, 29);  // the last row above the baseline
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
  TempFolder temp;
  const std::string text_file = temp.path() / "letters.ttf";
  write_file_atomically(text_file, "these are no letters");
  for (const std::string& file : {text_file, std::string("/nowhere/sans.ttf")}) {
    setenv("GNBV_FONT", file.c_str(), 1);
    std::thread([&] {  // a thread reads its font when it draws its first letter
      try {
        draw_text(*std::make_unique<Image>(kBlank), "a", 50.0, 30.0, 20.0, {0, 0, 0});
        ADD_FAILURE() << file;
      } catch (const BadInput& error) {
        EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("GNBV_FONT"), std::string::npos);
      }
    })
        .join();
  }
  unsetenv("GNBV_FONT");
}

/// The legend of panels is read as a text is: groups begin rows at the left, all of it on its
/// paper.
TEST(Caption, OnPaperGroupsBeginRowsAtTheLeft) {
  const auto drawn = [](const std::vector<LegendItem>& legend) {
    Image image{640, 360, {}};
    image.rgb.assign(static_cast<std::size_t>(3 * 640 * 360), 255);
    draw_caption(image, {.title = "", .detail = "", .legend = legend, .paper_px = 60});
    return image;
  };
  const auto rows_of = [](const Image& image, const Rgb8& colour) {
    std::array<int, 4> box = {640, 0, 360, 0};  // left, right, top, bottom
    for (int y = 0; y < 360; ++y) {
      for (int x = 0; x < 640; ++x) {
        if (image.at(x, y) != colour) continue;
        box = {std::min(box[0], x), std::max(box[1], x), std::min(box[2], y), std::max(box[3], y)};
      }
    }
    return box;
  };
  const LegendItem red{"a", {srgb(0xff0000)}};
  LegendItem blue{"b", {srgb(0x0000ff)}};
  const Image one = drawn({red, blue});
  EXPECT_EQ(rows_of(one, {255, 0, 0})[2], rows_of(one, {0, 0, 255})[2]);
  EXPECT_LT(rows_of(one, {255, 0, 0})[1], rows_of(one, {0, 0, 255})[0]);
  blue.begins_row = true;
  const Image two = drawn({red, blue});
  EXPECT_LT(rows_of(two, {255, 0, 0})[3], rows_of(two, {0, 0, 255})[2]);
  EXPECT_EQ(rows_of(two, {255, 0, 0})[0], rows_of(two, {0, 0, 255})[0]);
  for (const Image& image : {one, two}) {
    EXPECT_GE(rows_of(image, {255, 0, 0})[2], 300);
    EXPECT_LT(rows_of(image, {0, 0, 255})[3], 360);
  }
}

/// What the middle of a bar stands for is set upon it, in what can be read there.
TEST(Caption, ABarsMiddleStandsUponIt) {
  const auto drawn = [](const std::string& middle, const Rgb& colour) {
    Image image{640, 360, {}};
    image.rgb.assign(static_cast<std::size_t>(3 * 640 * 360), 200);
    const LegendItem bar{.label = "", .colours = {colour, colour}, .label_middle = middle};
    draw_caption(image, {.title = "", .detail = "", .legend = {bar}, .paper_px = 60});
    return image;
  };
  const auto columns_of = [](const Image& image, const Rgb8& colour) {
    std::vector<int> columns;
    for (int x = 0; x < 640; ++x) {
      for (int y = 310; y < 350; ++y) {
        if (image.at(x, y) != colour) continue;
        columns.push_back(x);
        break;
      }
    }
    return columns;
  };
  for (const auto& [rrggbb, ink] :
       {std::pair{0x20104aU, Rgb8{255, 255, 255}}, std::pair{0xe8e070U, kInk}}) {
    const Rgb8 paint = to_rgb8(srgb(rrggbb));
    const std::vector<int> bar = columns_of(drawn("", srgb(rrggbb)), paint);
    const Image image = drawn("1,234", srgb(rrggbb));
    const std::vector<int> numbered = columns_of(image, paint);
    ASSERT_FALSE(bar.empty());
    EXPECT_EQ(numbered.front(), bar.front());  // no longer, and no gap
    EXPECT_EQ(numbered.back(), bar.back());
    EXPECT_EQ(numbered.size(), bar.size());
    const int middle = (bar.front() + bar.back()) / 2;
    int letters = 0;
    for (int x = middle - 20; x <= middle + 20; ++x) {
      for (int y = 310; y < 350; ++y) {
        const Rgb8 at = image.at(x, y);
        int away = 0;
        for (std::size_t k = 0; k < 3; ++k) away = std::max(away, std::abs(at[k] - ink[k]));
        letters += away < 60 ? 1 : 0;
      }
    }
    EXPECT_GT(letters, 5) << rrggbb;
  }
}

/// Pictures that will be shown smaller ask for larger words: all of a caption grows with them.
TEST(Caption, LettersAreAsLargeAsAskedFor) {
  const auto rows = [](double letters) {
    Image image{1280, 720, {}};
    image.rgb.assign(static_cast<std::size_t>(3 * 1280 * 720), 255);
    draw_caption(image,
                 {.title = "", .detail = "H", .legend = {}, .letters = letters, .paper_px = 60});
    int first = 720;
    int last = 0;
    for (int y = 0; y < 720; ++y) {
      for (int x = 0; x < 640; ++x) {
        if (image.at(x, y)[0] > 128) continue;
        first = std::min(first, y);
        last = std::max(last, y);
      }
    }
    return last - first + 1;
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

}  // namespace
}  // namespace gnbv
