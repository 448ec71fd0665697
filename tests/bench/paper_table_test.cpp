#include "bench/paper_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnbv {
namespace {

MissionFigures example() {
  MissionFigures m;
  m.utility = "proposed";
  m.termination = "max_iterations";
  m.iterations = 635;
  m.entropy_reduction_nat = 3702.4;
  m.straight_m = 504.26;
  m.flown_m = 530.0;
  m.profile_m = 349.0;
  m.coverage_final = {0.852, 0.95, 0.9951};
  m.coverage_profile = {0.167, 0.666, 0.896};
  m.coverage_final_raw = {0.75, 0.85, 0.95};
  m.density_points_per_voxel = 103.2;
  m.wall_s = 61.0;
  return m;
}

bool has_row(const TextTable& table, const std::vector<std::string>& row) {
  return std::find(table.rows.begin(), table.rows.end(), row) != table.rows.end();
}

TEST(PaperTable, AircraftFiguresAreTable2AsPrinted) {
  const TextTable table = comparison_table(*find_paper_table("aircraft"), {});
  ASSERT_EQ(table.rows.size(), 4U);
  EXPECT_TRUE(has_row(table, {"Yes", "Bircher [17]", "paper", "577", "10,504", "1347.6", "86.5%",
                              "93.9%", "98.8%"}));
  EXPECT_TRUE(has_row(
      table, {"Yes", "Isler [29]", "paper", "585", "10,846", "1500.9", "85.1%", "92.0%", "98.5%"}));
  EXPECT_TRUE(has_row(
      table, {"Yes", "Proposed", "paper", "635", "10,970", "1396.5", "94.1%", "97.2%", "99.8%"}));
  EXPECT_TRUE(
      has_row(table, {"Profile", "-", "paper", "-", "-", "370.0", "15.3%", "63.9%", "87.3%"}));
}

TEST(PaperTable, PowerPlantFiguresAreTable3AsPrinted) {
  const PaperTable& paper = *find_paper_table("power_plant");
  const TextTable table = comparison_table(paper, {});
  ASSERT_EQ(table.rows.size(), 4U);
  EXPECT_TRUE(has_row(table, {"Yes", "Bircher [17]", "paper", "162", "14,574", "479.5", "95.9%",
                              "87.0%", "98.5%"}));
  EXPECT_TRUE(has_row(
      table, {"Yes", "Isler [29]", "paper", "360", "24,425", "945.4", "95.7%", "86.3%", "98.1%"}));
  EXPECT_TRUE(has_row(
      table, {"Yes", "Proposed", "paper", "210", "23,983", "469.5", "97.5%", "93.6%", "98.9%"}));
  EXPECT_TRUE(
      has_row(table, {"Profile", "-", "paper", "-", "-", "512.0", "15.1%", "69.5%", "86.3%"}));
  EXPECT_EQ(paper.rows[0].density_points_per_voxel, 140.0);
  EXPECT_EQ(paper.rows[1].density_points_per_voxel, 152.0);
  EXPECT_EQ(paper.rows[2].density_points_per_voxel, 177.0);
  EXPECT_NE(terminal_text(table).find("0.05 m than at 0.10 m"), std::string::npos);
}

TEST(PaperTable, UnknownScenarioHasNone) { EXPECT_EQ(find_paper_table("lab"), nullptr); }

TEST(ComparisonTable, PutsOursAboveThePapersRowAndOthersAfter) {
  MissionFigures tour = example();
  tour.utility = "tour";
  tour.profile_m = 350.0;
  const std::vector<MissionFigures> missions = {tour, example(), example()};
  const TextTable table = comparison_table(*find_paper_table("aircraft"), missions);
  std::vector<std::string> order;
  for (const auto& row : table.rows) order.push_back(row[1] + " " + row[2]);
  EXPECT_EQ(order, (std::vector<std::string>{"Bircher [17] paper", "Isler [29] paper",
                                             "Proposed ours", "Proposed ours", "Proposed paper",
                                             "tour ours", "- ours", "- ours", "- paper"}));
}

TEST(ComparisonTable, TerminalTextIsAligned) {
  const std::vector<MissionFigures> missions = {example()};
  const std::string expected = R"(Table 2, Scenario 1 (aircraft)
Profiling  Utility       Row    Iterations  Entropy reduction  Distance (m)  0.05 m  0.10 m  0.50 m
---------------------------------------------------------------------------------------------------
Yes        Bircher [17]  paper         577             10,504        1347.6   86.5%   93.9%   98.8%
Yes        Isler [29]    paper         585             10,846        1500.9   85.1%   92.0%   98.5%
Yes        Proposed      ours          635              3,702         504.3   85.2%   95.0%   99.5%
Yes        Proposed      paper         635             10,970        1396.5   94.1%   97.2%   99.8%
Profile    -             ours            -                  -         349.0   16.7%   66.6%   89.6%
Profile    -             paper           -                  -         370.0   15.3%   63.9%   87.3%
0.05, 0.10, 0.50 m: coverage at that voxel size, ours of the surface seen from outside
ours: entropy reduction in nat; distance in straight lines between views, profile apart
proposed: ended by max_iterations after 635 views; flown 530.0 m; 103 points/voxel; )"
                               "all surface, also inner: 75.0 / 85.0 / 95.0 %; 61.0 s\n";
  EXPECT_EQ(terminal_text(comparison_table(*find_paper_table("aircraft"), missions)), expected);
}

TEST(ComparisonTable, MarkdownHasOneCellAColumn) {
  TextTable table;
  table.title = "T";
  table.header = {"a", "b|c"};
  table.right = {false, true};
  table.rows = {{"x", "1"}, {"\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9", "22"}};
  table.notes = {"n"};
  EXPECT_EQ(markdown_text(table),
            "**T**\n\n"
            "| a    | b\\|c |\n"
            "| ---- | ---: |\n"
            "| x    |    1 |\n"
            "| \xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9 |   22 |\n"
            "\n"
            "- n\n");
}

TEST(OneRowSummary, ShowsTheMissionOverThePaper) {
  const std::string with_paper =
      R"(       Utility   Iterations  Entropy reduction  Distance (m)  Cov. 0.05 m  Cov. 0.10 m  Cov. 0.50 m
---------------------------------------------------------------------------------------------------
ours   proposed         635              3,702         504.3        85.2%        95.0%        99.5%
paper  proposed         635             10,970        1396.5        94.1%        97.2%        99.8%
proposed: ended by max_iterations after 635 views; flown 530.0 m; 103 points/voxel; all surface, also inner: 75.0 / 85.0 / 95.0 %; 61.0 s
)";
  EXPECT_EQ(one_row_summary("aircraft", example()), with_paper);
}

TEST(OneRowSummary, StandsAloneWhereThePaperHasNoRow) {
  MissionFigures tour = example();
  tour.utility = "tour";
  for (const std::string& text :
       {one_row_summary("lab", example()), one_row_summary("aircraft", tour)}) {
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4) << text;
    EXPECT_EQ(text.find("paper"), std::string::npos) << text;
    EXPECT_NE(text.find("504.3"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace gnbv
