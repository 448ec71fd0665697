#include "tools/terminal/progress.hpp"

#include <gtest/gtest.h>

#include "sim/core/text.hpp"

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

TEST(ProgressLine, GivesUpBarBeforeWordsAndNeverPartOfAWord) {
  const std::string note = "view 6/12  12 m  2,306 points";
  EXPECT_EQ(progress_line("smoke", 0.5, "9 s", note, 79),
            "smoke [############............]  50 % 9 s  view 6/12  12 m  2,306 points");
  EXPECT_EQ(progress_line("smoke", 0.5, "9 s", note, 60),
            "smoke [#####......]  50 % 9 s  view 6/12  12 m  2,306 points");
  EXPECT_EQ(progress_line("smoke", 0.5, "9 s", note, 50),
            "smoke [####....]  50 % 9 s  view 6/12  12 m…");
}

TEST(ProgressLine, FitsEveryTerminal) {
  for (std::size_t columns = 0; columns < 90; ++columns) {
    const std::string line = progress_line("a scénario", 0.25, "1 min 05 s, 12 s left",
                                           "finding what there is to see", columns);
    EXPECT_LE(width_of(line), columns) << line;
  }
}

}  // namespace
}  // namespace gnbv
