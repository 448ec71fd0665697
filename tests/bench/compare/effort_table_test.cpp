#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/compare/paper_runs.hpp"

namespace gnbv {
namespace {

/// A run that covers 0.9 of the structure after its first view of so many metres, all after two.
RunFigures reaching(const std::string& utility, std::uint64_t seed, double metres,
                    bool to_the_end) {
  RunFigures r = example();
  r.utility = utility;
  r.seed = seed;
  r.curve = {.coverage = {{0.1, 1, 1}, {0.9, 1, 1}}, .metres = {0, metres}, .seconds = {0, 1}};
  if (to_the_end) {
    r.curve.coverage.push_back({1.0, 1.0, 1.0});
    r.curve.metres.push_back(2.0 * metres);
    r.curve.seconds.push_back(2.0);
  }
  return r;
}

Ceiling all_of_it() {
  Ceiling ceiling;
  ceiling.leaf_counted = {1.0, 1.0, 1.0};
  return ceiling;
}

/// Whoever got there after the budget of 300 m did not, and has spent it.
TEST(EffortTable, IsTheMedianHowManyGotThereAndTheMeanWithinTheBudget) {
  const PaperTable& paper = *find_paper_table("aircraft");
  std::vector<RunFigures> runs = {
      reaching("oracle_metres", 1, 50.0, true), reaching("oracle_metres", 2, 60.0, false),
      reaching("proposed", 1, 100.0, true), reaching("proposed", 2, 120.0, true),
      reaching("proposed", 3, 400.0, true)};
  const TextTable unbounded = effort_table(paper, Effort::metres, rows_of(runs, all_of_it()));
  EXPECT_EQ(texts(unbounded.rows[0]),
            (Texts{"Proposed", "ours", "120.0 (3 of 3), 206.7", "120.0 (3 of 3), 206.7",
                   "240.0 (3 of 3), 413.3", "240.0 (3 of 3), 413.3", "240.0 (3 of 3), 413.3"}));
  for (RunFigures& run : runs) run.budgets = {0.0, 300.0, 0.0};
  const TextTable table = effort_table(paper, Effort::metres, rows_of(runs, all_of_it()));
  EXPECT_EQ(all_texts(table),
            (std::vector<Texts>{
                {"Proposed", "ours", "120.0 (2 of 3), 173.3", "120.0 (2 of 3), 173.3",
                 "240.0 (2 of 3), 246.7", "240.0 (2 of 3), 246.7",
                 "240.0 (2 of 3), 246.7"},  // 95 % and more: 200, 240, never
                {"Oracle, few metres", "ours", "55.0 (2 of 2), 55.0", "55.0 (2 of 2), 55.0",
                 "- (1 of 2), 200.0", "- (1 of 2), 200.0", "- (1 of 2), 200.0"}}));
  EXPECT_EQ(table.rows[0][6].values[0], 240.0);
  EXPECT_EQ(table.rows[0][6].values[1], 2.0);
  EXPECT_EQ(table.rows[1][4].values[0], std::nullopt);
  EXPECT_TRUE(effort_table(paper, Effort::metres, rows_of(runs)).rows.empty());
  EXPECT_TRUE(effort_table(paper, Effort::metres, rows_of(runs, Ceiling{})).rows.empty());
  runs[2].curve = {};
  EXPECT_EQ(effort_table(paper, Effort::metres, rows_of(runs, all_of_it())).rows.at(0)[2].text,
            "-");
}

/// What is flown for 90 % may get to 80 % first, too.
TEST(EffortTable, OfMissionsThatWereFlownForAShareTheLeastCounts) {
  const PaperTable& paper = *find_paper_table("aircraft");
  const std::vector<RunFigures> runs = {
      reaching("oracle_metres", 1, 50.0, true),  reaching("oracle_metres", 2, 60.0, true),
      reaching("proposed", 1, 100.0, true),      reaching("oracle_metres", 1, 20.0, false),
      reaching("oracle_metres", 2, 22.0, false), reaching("oracle_metres", 1, 70.0, false)};
  const std::vector<MissionRow> rows =
      rows_of(runs, all_of_it(), {"", "", "", "for 0.90", "for 0.90", "for 0.99"});
  const auto table = [&](Effort effort) {
    auto all = all_texts(effort_table(paper, effort, rows));
    for (Texts& row : all) {
      for (std::string& text : row) text = text.substr(0, text.find(','));
    }
    return all;
  };
  EXPECT_EQ(table(Effort::metres)[0],
            (Texts{"Proposed", "ours", "100.0 (1 of 1)", "100.0 (1 of 1)", "200.0 (1 of 1)",
                   "200.0 (1 of 1)", "200.0 (1 of 1)"}));
  EXPECT_EQ(table(Effort::metres)[1][2], "21.0 (2 of 2)");
  EXPECT_EQ(table(Effort::metres)[1][3], "21.0 (2 of 2)");
  EXPECT_EQ(table(Effort::metres)[1][4], "110.0 (2 of 2)");  // 100 and 120 m
  EXPECT_EQ(table(Effort::seconds)[0][2], "1.0 (1 of 1)");
  EXPECT_EQ(table(Effort::seconds)[0][4], "2.0 (1 of 1)");
  const TextTable whole = comparison_table(paper, rows);
  EXPECT_EQ(std::ranges::count(whole.rows, "Oracle, few metres",
                               [](const auto& row) { return row[0].text; }),
            1);
}

/// A run of two views of 100 s each, after a profile of 100 s: what is reached within the budget of
/// seconds is told from take-off; on one battery is nothing that is not reached.
TEST(EffortTable, FromTakeOffHasTheProfileTheEnergyAndTheBattery) {
  std::vector<RunFigures> runs;
  for (const std::uint64_t seed : {1, 2, 3}) {
    RunFigures& run = runs.emplace_back(reaching("proposed", seed, 50.0, true));
    run.before = {.profile_m = 200.0, .transfer_m = 10.0, .profile_end_s = 100.0};
    run.curve.seconds = {0.0, 100.0 * static_cast<double>(seed), 600.0};
    run.curve.energy_wh = {5.0, 10.0 * static_cast<double>(seed), 40.0};
    run.curve.on_one_battery = {true, seed != 2, false};
    run.budgets = {0.0, 0.0, 250.0};
    run.flight_time_s = 700.0;
    run.energy_wh = 70.0;
  }
  const std::vector<MissionRow> rows = rows_of(runs, all_of_it());
  for (const MissionRow& row : rows) {
    for (const std::string_view share : kReachNames) {
      const auto wh = row.find(figure_to_reach(Effort::wh_with_profile, share));
      const auto seconds = row.find(figure_to_reach(Effort::seconds_with_profile, share));
      EXPECT_EQ(std::isfinite(*wh), std::isfinite(*seconds));
      EXPECT_LE(*row.find(fmt::format("{}{}", kOneBatteryTo, share)), std::isfinite(*wh));
    }
  }
  const PaperTable& paper = *find_paper_table("aircraft");
  const auto of = [&](Effort effort) { return texts(effort_table(paper, effort, rows).rows[0]); };
  EXPECT_EQ(of(Effort::metres_with_profile)[2], "260.0 (3 of 3), 260.0");
  // the third is there after the budget, by when it would have drawn a tenth of its seconds
  EXPECT_EQ(of(Effort::seconds_with_profile)[2], "300.0 (2 of 3), 283.3");
  const Texts energy = of(Effort::wh_with_profile);
  EXPECT_EQ(energy[2], "20.0 (2 of 3), 21.7");
  EXPECT_EQ(energy[3], "1 of 3");  // the first; the third did not get there
  EXPECT_EQ(energy[6], "- (0 of 3), 35.0");
  EXPECT_EQ(energy[7], "0 of 3");
  const TextTable at_95 = take_off_table(paper, rows);
  EXPECT_EQ(texts(at_95.rows[0]), (Texts{"Proposed", "ours", "- (0 of 3), 350.0",
                                         "310.0 (3 of 3), 310.0", "- (0 of 3), 35.0", "0 of 3"}));
  // what one of them does not know is no number; what nobody knows is no column
  std::vector<RunFigures> older = {runs[0], reaching("tour", 1, 50.0, true)};
  EXPECT_EQ(all_texts(take_off_table(paper, rows_of(older, all_of_it())))[1][4], "-");
  older[0].curve.energy_wh.clear();
  EXPECT_EQ(take_off_table(paper, rows_of(older, all_of_it())).columns.size(), 4U);
}

TEST(EffortTable, FromTakeOffWhoNeverGetsThereCountsAsTheLargestBudget) {
  std::vector<RunFigures> runs = {reaching("proposed", 1, 50.0, false),
                                  reaching("tour", 1, 50.0, false)};
  for (RunFigures& run : runs) run.budgets = {0.0, 300.0, 0.0};
  runs[0].before = {.profile_m = 200.0};
  runs[1].before = {};
  const PaperTable& paper = *find_paper_table("aircraft");
  const auto rows =
      all_texts(effort_table(paper, Effort::metres_with_profile, rows_of(runs, all_of_it())));
  EXPECT_EQ(rows.at(0).at(6), "- (0 of 1), 500.0");
  EXPECT_EQ(rows.at(1).at(6), "- (0 of 1), 500.0");
}

TEST(EffortTable, ItsRowsAreThoseOfThePapersTable) {
  const PaperTable& paper = *find_paper_table("aircraft");
  const std::vector<RunFigures> runs = {reaching("tour", 1, 100.0, true),
                                        reaching("proposed", 1, 100.0, true),
                                        reaching("proposed", 1, 90.0, true)};
  const std::vector<MissionRow> rows = rows_of(runs, all_of_it(), {"", "", "leaf_m=0.07"});
  const TextTable both = with_columns_of(comparison_table(paper, rows),
                                         effort_table(paper, Effort::metres, rows), kSharedColumns);
  int filled = 0;
  for (const auto& row : both.rows) {
    ASSERT_EQ(row.size(), both.columns.size());
    filled += row.back().text == "-" ? 0 : 1;
    const bool is_mission = row[1].text == "ours" && !row[0].text.starts_with("Profile");
    EXPECT_EQ(row.back().text != "-", is_mission);
  }
  EXPECT_EQ(filled, 3);
}

}  // namespace
}  // namespace gnbv
