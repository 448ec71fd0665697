#include "tools/terminal/progress.hpp"

#include <gtest/gtest.h>

namespace gnbv {
namespace {

TEST(SecondsLeft, GoOnAtThePaceSoFar) {
  EXPECT_DOUBLE_EQ(seconds_left(30.0, 0.25).value(), 90.0);
  EXPECT_DOUBLE_EQ(seconds_left(60.0, 0.5).value(), 60.0);
}

TEST(SecondsLeft, AreUnknownBeforeThereIsAPaceAndAtTheEnd) {
  EXPECT_FALSE(seconds_left(10.0, 0.0));
  EXPECT_FALSE(seconds_left(10.0, 0.005));
  EXPECT_FALSE(seconds_left(0.5, 0.5));
  EXPECT_FALSE(seconds_left(10.0, 1.0));
}

TEST(DurationText, NamesTwoUnitsAtMost) {
  EXPECT_EQ(duration_text(0.2), "0 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(59.6), "1 min 00 s");
  EXPECT_EQ(duration_text(185.0), "3 min 05 s");
  EXPECT_EQ(duration_text(4830.0), "1 h 20 min");
  EXPECT_EQ(duration_text(-1.0), "0 s");
}

TEST(ProgressBar, TellsEachQuarterWithTimeLeftWhereNobodyWatches) {
  testing::internal::CaptureStderr();
  {
    ProgressBar bar("cells", false);
    for (int i = 0; i <= 8; ++i) bar.show(i / 8.0, "flying", 61.0);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "cells  25 % flying, 1 min 01 s left\ncells  50 % flying, 1 min 01 s left\n"
            "cells  75 % flying, 1 min 01 s left\ncells 100 % flying, 1 min 01 s left\n");
}

}  // namespace
}  // namespace gnbv
