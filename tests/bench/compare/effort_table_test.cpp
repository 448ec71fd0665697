#include "bench/compare/effort_table.hpp"

#include <gtest/gtest.h>

#include "bench/compare/paper_table.hpp"

namespace gnbv {
namespace {

/// A run that covers 0.9 of the structure after its first view of so many metres, all after two.
RunFigures reaching(const std::string& utility, std::uint64_t seed, double metres,
                    bool to_the_end) {
  RunFigures r;
  r.scenario = "aircraft";
  r.utility = utility;
  r.seed = seed;
  r.curve = {.coverage = {{0.1, 1, 1}, {0.9, 1, 1}}, .metres = {0, metres}, .seconds = {0, 1}};
  if (to_the_end) {
    r.curve.coverage.push_back({1.0, 1.0, 1.0});
    r.curve.metres.push_back(2.0 * metres);
    r.curve.seconds.push_back(2.0);
  }
  r.coverage_final = r.curve.coverage.back();
  return r;
}

const PaperTable& paper() { return *find_paper_table("aircraft"); }

TEST(EffortTable, IsTheMedianAndHowManyGotThere) {
  const std::vector<RunFigures> runs = {
      reaching("proposed", 1, 100.0, true), reaching("proposed", 2, 120.0, true),
      reaching("proposed", 3, 400.0, false), reaching("oracle_metres", 1, 50.0, true),
      reaching("oracle_metres", 2, 60.0, false)};
  Ceiling ceiling;
  ceiling.leaf_outside = {1.0, 1.0, 1.0};
  const TextTable table = effort_table(paper(), runs, ceiling);
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0][0].text, "Proposed");
  EXPECT_EQ(table.rows[0][2].text, "120.0 (3 of 3)");  // 90 %
  EXPECT_EQ(table.rows[0][5].text, "240.0 (2 of 3)");  // 99 %: 200, 240, never
  EXPECT_EQ(table.rows[0][5].values[0], 240.0);
  EXPECT_EQ(table.rows[0][5].values[1], 2.0);
  EXPECT_EQ(table.rows[1][0].text, "Oracle, few metres");
  EXPECT_EQ(table.rows[1][2].text, "55.0 (2 of 2)");
  EXPECT_EQ(table.rows[1][3].text, "- (1 of 2)");
  EXPECT_EQ(table.rows[1][3].values[0], std::nullopt);
}

TEST(EffortTable, ItsRowsAreThoseOfThePapersTable) {
  const std::vector<RunFigures> runs = {reaching("tour", 1, 100.0, true),
                                        reaching("proposed", 1, 100.0, true),
                                        reaching("proposed", 1, 90.0, true)};
  const std::vector<std::string> settings = {"", "", "leaf_m=0.07"};
  Ceiling ceiling;
  ceiling.leaf_outside = {1.0, 1.0, 1.0};
  const TextTable both =
      with_columns_of(comparison_table(paper(), runs, ceiling, settings),
                      effort_table(paper(), runs, ceiling, settings), kSharedColumns);
  int filled = 0;
  for (const auto& row : both.rows) {
    ASSERT_EQ(row.size(), both.columns.size());
    filled += row.back().text == "-" ? 0 : 1;
    const bool is_mission = row[1].text == "ours" && row[0].text != "Profile";
    EXPECT_EQ(row.back().text != "-", is_mission);
  }
  EXPECT_EQ(filled, 3);
}

TEST(EffortTable, HasNoRowsWithoutACeilingAndDashesWithoutACurve) {
  std::vector<RunFigures> runs = {reaching("proposed", 1, 100.0, true)};
  EXPECT_TRUE(effort_table(paper(), runs, {}).rows.empty());
  EXPECT_TRUE(effort_table(paper(), runs, Ceiling{}).rows.empty());
  runs[0].curve = {};
  Ceiling ceiling;
  ceiling.leaf_outside = {1.0, 1.0, 1.0};
  EXPECT_EQ(effort_table(paper(), runs, ceiling).rows.at(0)[2].text, "-");
}

}  // namespace
}  // namespace gnbv
