#include <gtest/gtest.h>

#include "bench/speed/speed_rows.hpp"

namespace gnbv {
namespace {

TEST(SpeedRows, RatiosSayHowManyTimesAsFastOursIs) {
  const SpeedRow faster{.ours = 2.0, .reference = 30.0, .competent = 10.0};
  EXPECT_EQ(ratio(faster), 15.0);
  EXPECT_EQ(competent_ratio(faster), 5.0);
  EXPECT_FALSE(competent_ratio({.ours = 2.0, .reference = 30.0}));
  const SpeedRow limited{.ours = 3.0, .reference = 2.0, .is_limit = true};
  EXPECT_EQ(ratio(limited), 1.5);  // times as slow
}

TEST(SpeedRows, AreMetOnTheRightSideOfTheirTargetAndOnlyByRightAnswers) {
  SpeedRow row{.ours = 2.0, .reference = 30.0, .identical = true, .target = 15.0};
  EXPECT_TRUE(is_met(row));
  row.target = 16.0;
  EXPECT_FALSE(is_met(row));
  row.target = 0.0;
  row.identical = false;
  EXPECT_FALSE(is_met(row));
  SpeedRow limited{
      .ours = 3.0, .reference = 2.0, .identical = true, .target = 1.5, .is_limit = true};
  EXPECT_TRUE(is_met(limited));
  limited.target = 1.4;
  EXPECT_FALSE(is_met(limited));
}

}  // namespace
}  // namespace gnbv
