// Laws of axes and keys.
#include <algorithm>
#include <array>
#include <cstdio>

#include "tests/tools/plots/plot_support.hpp"
#include "tools/plots/script_parts.hpp"

namespace gnbv {
namespace {

TEST(Plots, AxesSeparateThousands) {
  EXPECT_EQ(x_tics(0.0, 999.0, 500.0), "set xtics 500\n");
  EXPECT_EQ(x_tics(900.0, 2100.0, 500.0), "set xtics ('1,000' 1000, '1,500' 1500, '2,000' 2000)\n");
  EXPECT_NE(y_axis(0.0, 5800.0).find("set ytics ('0' 0, '2,000' 2000, '4,000' 4000, '6,000' 6000)"),
            std::string::npos);
  EXPECT_NE(y_axis(-1900.0, 0.0).find("'−2,000' -2000"), std::string::npos);
  EXPECT_NE(y_axis(0.0, 183'000.0).find("'150,000' 150000"), std::string::npos);
  EXPECT_NE(y_axis(0.0, 1'830'000.0).find("set format y '%.1s%c'"), std::string::npos);
}

/// No 94 beside 93.9.
TEST(Plots, AllMarksOfAnAxisHaveAsManyDecimals) {
  EXPECT_NE(y_axis(93.7, 94.1).find("set format y '% .1f'"), std::string::npos);
  EXPECT_NE(y_axis(0.0, 0.05).find("set format y '% .2f'"), std::string::npos);
  EXPECT_NE(y_axis(-30.0, 50.0).find("set format y '% .0f'"), std::string::npos);
  EXPECT_NE(y_axis(0.0, 1.2e-8).find("set format y '% h'"), std::string::npos);
}

/// Panels are low: few marks, one at each end, and little room beyond the values.
TEST(Plots, ACloseAxisEndsOnMarksAroundItsValues) {
  const std::vector<std::array<double, 5>> cases = {
      {-20.3, 19.8, -25.0, 25.0, 25.0}, {-9.0, 9.5, -10.0, 10.0, 10.0}, {0.0, 2.02, 0.0, 3.0, 1.0},
      {0.0, 0.029, 0.0, 0.03, 0.01},    {0.0, 40.0, 0.0, 40.0, 20.0},   {0.0, 7.2, 0.0, 7.5, 2.5}};
  for (const auto& [low, high, from, to, step] : cases) {
    const Axis axis = close_axis(low, high);
    EXPECT_NEAR(axis.low, from, 1e-9) << low << " " << high;
    EXPECT_NEAR(axis.high, to, 1e-9) << low << " " << high;
    EXPECT_NEAR(axis.step, step, 1e-9) << low << " " << high;
  }
  EXPECT_NE(axis_settings(close_axis(0.0, 7.2)).find("set format y '% .1f'"), std::string::npos);
  const Axis same = close_axis(0.0, 0.0);
  EXPECT_LT(same.low, same.high);
}

TEST(Plots, PanelsShareAnAxisThatSeparatesThousands) {
  Panels panels(2, "title", "mission time (s)", {900.0, 2100.0});
  const std::string first = panels.next("above");
  EXPECT_NE(first.find("set xrange [900:2100]"), std::string::npos);
  EXPECT_EQ(first.find("1,000"), std::string::npos);
  EXPECT_NE(panels.next("below").find("'1,000' 1000"), std::string::npos);
}

/// The axis holds the values, and two marks at least, however close to each other these are.
TEST(Plots, AxesHoldWhatIsDrawn) {
  const std::vector<std::pair<double, double>> ranges = {
      {0.0, 0.0}, {7.0, 7.0}, {-3e6, -3e6}, {1e-12, 1e-12}, {123456.7, 123456.9}, {0.2, 1.4}};
  for (const auto& [low, high] : ranges) {
    double bottom = 0.0;
    double top = 0.0;
    double step = 0.0;
    const std::string axis = y_axis(low, high);
    ASSERT_EQ(
        std::sscanf(axis.c_str(), "set yrange [%lf:%lf]\nset ytics %lf", &bottom, &top, &step), 3);
    EXPECT_LE(bottom, low);
    EXPECT_GE(top, high);
    EXPECT_GE(top - bottom, 1.999 * step) << axis;
    EXPECT_LE(top - bottom, 8.0 * step) << axis;
  }
}

/// Rows of a key end within the picture, in its order; an entry wider than that has its own.
TEST(Key, RowsAreAsWideAsThePicture) {
  const KeyEntry entry{.colour = "#0072b2", .text = "mean of each 6 s", .line = 1.0};
  const KeyEntry wide{.colour = "#0072b2", .text = std::string(80, 'n')};
  EXPECT_TRUE(key_rows({}).empty());
  EXPECT_EQ(key_rows({entry, entry}).size(), 1U);
  const auto rows = key_rows({entry, entry, entry, entry, wide, entry});
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[2].front().text, wide.text);
  for (const std::size_t row : {0U, 1U}) {
    double width = 0.02;
    for (const KeyEntry& each : rows[row]) width += text_width(each.text) + 0.06;
    EXPECT_LT(width, 1.0);
  }
}

/// The title, the entries a line each, and below them the plot.
TEST(Key, StandsAboveThePlot) {
  const std::vector<KeyEntry> key = {{.colour = "#0072b2", .text = "one", .has_band = true},
                                     {.colour = "#d55e00", .text = "two", .line = 1.3, .point = 5}};
  const std::string text = key_above("title", key);
  std::vector<double> heights;
  for (const std::string name : {"'title' at screen 0.02,", "'one' at screen 0.0560,",
                                 "'two' at screen 0.0800,", "set tmargin at screen "}) {
    const std::size_t at = text.find(name);
    ASSERT_NE(at, std::string::npos) << name << text;
    heights.push_back(std::stod(text.substr(at + name.size())));
  }
  EXPECT_TRUE(std::is_sorted(heights.rbegin(), heights.rend()));
  EXPECT_NE(text.find(tint("#0072b2", 0.25)), std::string::npos);  // a band's colour
  EXPECT_EQ(tint("#0072b2", 0.25), "#bfdcec");
  expect_drawable({.name = "key", .body = text + "plot x\n"});
}

}  // namespace
}  // namespace gnbv
