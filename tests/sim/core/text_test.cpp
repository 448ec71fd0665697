// Laws of bytes as text, and of text as code points.
#include "sim/core/text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace gnbv {
namespace {

// RFC 4648, section 10
TEST(Base64, IsThatOfTheStandard) {
  const auto bytes_of = [](std::string_view text) {
    return std::vector<std::uint8_t>(text.begin(), text.end());
  };
  EXPECT_EQ(base64(bytes_of("")), "");
  EXPECT_EQ(base64(bytes_of("f")), "Zg==");
  EXPECT_EQ(base64(bytes_of("fo")), "Zm8=");
  EXPECT_EQ(base64(bytes_of("foo")), "Zm9v");
  EXPECT_EQ(base64(bytes_of("foobar")), "Zm9vYmFy");
  EXPECT_EQ(base64(std::vector<std::uint8_t>{0xff, 0xfe, 0xfb}), "//77");
}

std::u32string code_points(std::string_view text) {
  std::u32string codes;
  while (!text.empty()) codes += take_code_point(text);
  return codes;
}

TEST(Utf8, CodePointsOfOneToFourBytesComeOutInOrder) {
  EXPECT_EQ(code_points("K\xc3\xbchl \xe2\x82\xac\xf0\x9f\x9a\x81."),
            U"K\u00fchl \u20ac\U0001f681.");
  EXPECT_EQ(code_points(std::string_view("\0a", 2)), std::u32string(U"\0a", 2));
}

TEST(Utf8, BytesThatAreNoneAreReplacedOneByOne) {
  EXPECT_EQ(code_points("a\xff\xc3"), U"a\ufffd\ufffd");          // no lead, cut off
  EXPECT_EQ(code_points("\xc3\xc3\xbc"), U"\ufffd\u00fc");        // cut off by the next
  EXPECT_EQ(code_points("\xc0\xaf"), U"\ufffd\ufffd");            // longer than it must be
  EXPECT_EQ(code_points("\xed\xa0\x80"), U"\ufffd\ufffd\ufffd");  // a surrogate
  EXPECT_EQ(code_points("\xf4\x90\x80\x80")[0], U'\ufffd');       // beyond the last
  EXPECT_EQ(code_points("\xe2\x82"), U"\ufffd\ufffd");            // at the end of the text
}

TEST(FoldedText, BreaksAtBlanksButNotBetweenANumberAndItsUnit) {
  EXPECT_EQ(folded_text("up to 25 m, 38 s", 14), "up to 25 m,\n38 s");
  EXPECT_EQ(folded_text("up to 25 m, 38 s", 9), "up to\n25 m,\n38 s");
  EXPECT_EQ(folded_text("(n = 4 seeds)", 6), "(n = 4\nseeds)");  // no unit
  EXPECT_EQ(folded_text("one\n\ntwo", 5), "one\n\ntwo");
  EXPECT_EQ(folded_text("wider than that", 0), "wider than that");
}

TEST(FoldedText, IsTheTextItWasAndNoWiderWhereBlanksAllowIt) {
  const std::string text = "a longer sentence of 12 words with 0.05 m and 98.1 % in it.";
  for (std::size_t width = 9; width < 70; ++width) {
    std::string folded = folded_text(text, width);
    std::size_t begin = 0;
    for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
      end = folded.find('\n', begin);
      EXPECT_LE(folded.substr(begin, end - begin).size(), width) << folded;
    }
    std::replace(folded.begin(), folded.end(), '\n', ' ');
    EXPECT_EQ(folded, text);
  }
}

TEST(Shortened, EndsAfterAWordAndIsNeverWider) {
  EXPECT_EQ(shortened("finding what there is to see", 28), "finding what there is to see");
  EXPECT_EQ(shortened("finding what there is to see", 27), "finding what there is to…");
  EXPECT_EQ(shortened("view 6/12  12 m  2,306 points", 20), "view 6/12  12 m…");
  EXPECT_EQ(shortened("indivisible", 5), "");
}

TEST(Grouped, ThousandsOfCountsAreApart) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(1234567), "1,234,567");
}

TEST(Grouped, NumbersHaveTheirDecimalsAndNoNegativeZero) {
  EXPECT_EQ(grouped(10969.6, 0), "10,970");
  EXPECT_EQ(grouped(1234.56, 1), "1,234.6");
  EXPECT_EQ(grouped(-1234567.25, 1), "-1,234,567.2");
  EXPECT_EQ(grouped(999.0, 2), "999.00");
  EXPECT_EQ(grouped(-0.04, 1), "0.0");
}

}  // namespace
}  // namespace gnbv
