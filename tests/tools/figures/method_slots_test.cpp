// Laws of the numbers that colours of methods go by.
#include "tools/run/method_slots.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace gnbv {
namespace {

TEST(MethodSlots, AMethodHasItsColourInWhateverCompany) {
  const std::vector<std::string> few = {"tour", "proposed"};
  const std::vector<std::string> more = {"isler", "proposed", "bircher", "tour"};
  EXPECT_EQ(method_slots(few), (std::vector<std::size_t>{3, 0}));
  EXPECT_EQ(method_slots(more), (std::vector<std::size_t>{2, 0, 1, 3}));
}

TEST(MethodSlots, NoTwoHaveTheSameNumberAndStrangersTakeWhatIsLeft) {
  const std::vector<std::string> methods = {"mine", "proposed", "tour", "proposed", "yours"};
  EXPECT_EQ(method_slots(methods), (std::vector<std::size_t>{1, 0, 3, 2, 4}));
  const std::vector<std::string> many(14, "mine");
  std::vector<std::size_t> all(many.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  EXPECT_EQ(method_slots(many), all);
  EXPECT_TRUE(method_slots({}).empty());
}

TEST(MethodSlots, TheReleasedCodeIsAMethodAndAUtilityIsItsName) {
  std::vector<RunRecord> runs(2);
  for (RunRecord& run : runs) run.scenario.planner.utility.name = "bircher";
  runs[1].scenario.planner.preset = "released";
  EXPECT_EQ(methods_of(runs), (std::vector<std::string>{"bircher", "released"}));
  const std::vector<RunGroup> groups = {{"b", {&runs[1]}}, {"a", {&runs[0]}}};
  EXPECT_EQ(methods_of(groups), (std::vector<std::string>{"released", "bircher"}));
}

}  // namespace
}  // namespace gnbv
