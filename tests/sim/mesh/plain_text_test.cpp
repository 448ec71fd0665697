#include "sim/mesh/plain_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gnbv {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(PlainText, ADecimalIsTheNearestDouble) {
  EXPECT_EQ(read_decimal("0.1"), 0.1);
  EXPECT_EQ(read_decimal("+1"), 1.0);
  EXPECT_EQ(read_decimal("-.5"), -0.5);
  EXPECT_EQ(read_decimal("2."), 2.0);
  EXPECT_EQ(read_decimal("1E3"), 1000.0);
  EXPECT_EQ(read_decimal("4.9e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(read_decimal("-inf"), -kInfinity);
  EXPECT_TRUE(std::isnan(*read_decimal("nan")));
}

TEST(PlainText, OutOfADoublesRangeIsInfiniteOrZero) {
  const std::string many(400, '0');
  const std::string large[] = {"1e309", "0.0001e999", "1e+999999999999999999999", "1" + many,
                               "1" + many + ".5e-10"};
  for (const std::string& text : large) {
    EXPECT_EQ(read_decimal(text), kInfinity) << text;
    EXPECT_EQ(read_decimal("-" + text), -kInfinity) << text;
  }
  const std::string small[] = {"1e-400", "9999e-999", "1e-999999999999999999999", "." + many + "1",
                               "0." + many + "1e10"};
  for (const std::string& text : small) {
    EXPECT_EQ(read_decimal(text), 0.0) << text;
    EXPECT_TRUE(std::signbit(*read_decimal("-" + text))) << text;
  }
}

TEST(PlainText, WhatIsNoNumberIsNone) {
  for (const char* text :
       {"", "+", "-", "+-1", "++1", "--1", "1x", "x", "1,5", "1 ", " 1", "0x10", ".", "e5", "1e"}) {
    EXPECT_FALSE(read_decimal(text)) << text;
  }
}

TEST(PlainText, WordsStandBetweenBlanks) {
  std::vector<std::string_view> words = {"old"};
  split("  a\tbc   d e \r", words);
  EXPECT_EQ(words, (std::vector<std::string_view>{"a", "bc", "d", "e"}));
  EXPECT_EQ(joined(Words(words).subspan(1)), "bc   d e");
  split(" \t\r", words);
  EXPECT_TRUE(words.empty());
}

}  // namespace
}  // namespace gnbv
