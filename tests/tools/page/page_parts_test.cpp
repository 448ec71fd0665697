// The law of a program that was built without the bundle: it says why. The parts are those that
// this folder's CMakeLists.txt writes.
#include <gtest/gtest.h>

#include "tools/page/page_text.hpp"

namespace gnbv {
namespace {

TEST(PageParts, WithoutTheBundleTheReasonIsThere) {
  EXPECT_EQ(why_no_page(), "npm is missing");
  EXPECT_EQ(page_script(), "");
  EXPECT_EQ(page_style(), "");
  EXPECT_NE(page_template().find("{SCRIPT}"), std::string_view::npos);
}

}  // namespace
}  // namespace gnbv
