// Laws of axes: they hold what is drawn, and their ticks can be read.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tools/figures/figure.hpp"

namespace gnbv {
namespace {

std::vector<std::string> texts(const Axis& axis) {
  std::vector<std::string> texts;
  for (const AxisTick& tick : axis.ticks) texts.push_back(tick.text);
  return texts;
}

using Texts = std::vector<std::string>;

TEST(Axes, TicksSeparateThousandsAndHaveAsManyDecimalsAsTheirStep) {
  EXPECT_EQ(texts(axis_from("", 900.0, 2100.0)), (Texts{"1,000", "1,500", "2,000"}));
  EXPECT_EQ(texts(axis_around("", -1900.0, 0.0)),
            (Texts{"−2,000", "−1,500", "−1,000", "−500", "0"}));
  EXPECT_EQ(texts(axis_around("", 93.7, 94.1)), (Texts{"93.7", "93.8", "93.9", "94.0", "94.1"}));
  EXPECT_EQ(texts(axis_around("", 0.0, 1'830'000.0)), (Texts{"0", "0.5M", "1M", "1.5M", "2M"}));
  EXPECT_EQ(texts(axis_around("", 0.0, 1.2e-8)).back(), "1.5e-08");
}

/// The axis holds the values, and two ticks at least, however close to each other these are.
TEST(Axes, HoldWhatIsDrawnOnEvenSteps) {
  const std::vector<std::pair<double, double>> ranges = {
      {0.0, 0.0},    {7.0, 7.0},   {-3e6, -3e6}, {1e-12, 1e-12}, {123456.7, 123456.9},
      {-20.3, 19.8}, {0.0, 0.029}, {0.2, 1.4},   {0.0, 7.2}};
  for (const auto& [low, high] : ranges) {
    for (const Axis& axis : {axis_around("", low, high), axis_around("", low, high, 3)}) {
      const double rounding = 1e-12 * std::max(1.0, std::abs(low));
      EXPECT_LE(axis.low, low + rounding);
      EXPECT_GE(axis.high, high - rounding);
      ASSERT_GE(axis.ticks.size(), 3U) << low << " " << high;
      EXPECT_LE(axis.ticks.size(), 9U) << low << " " << high;
      EXPECT_NEAR(axis.ticks.front().at, axis.low, 1e-9 * std::abs(axis.low));
      EXPECT_NEAR(axis.ticks.back().at, axis.high, 1e-9 * std::abs(axis.high));
    }
  }
}

TEST(Axes, ALogarithmicAxisHasATickAtEachPowerOfTen) {
  const Axis axis = log_axis("", 0.03, 20.0);
  EXPECT_TRUE(axis.is_log);
  EXPECT_EQ(texts(axis), (Texts{"0.01", "0.1", "1", "10", "100"}));
}

}  // namespace
}  // namespace gnbv
