#include "bench/compare/paper_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "bench/compare/terminal_table.hpp"

namespace gnbv {
namespace {

RunFigures example() {
  RunFigures r;
  r.scenario = "aircraft";
  r.structure = "aircraft";
  r.utility = "proposed";
  r.termination = "max_iterations";
  r.seed = 1;
  r.iterations = 635;
  r.entropy_reduction_nat = 3702.4;
  r.straight_m = 504.26;
  r.flown_m = 530.0;
  r.before.profile_m = 349.0;
  r.coverage_final = {0.852, 0.95, 0.9951};
  r.coverage_profile = {0.167, 0.666, 0.896};
  r.coverage_final_raw = {0.75, 0.85, 0.95};
  r.density_points_per_voxel = 103.2;
  r.wall_s = 61.0;
  return r;
}

std::vector<std::string> texts(const std::vector<TableCell>& row) {
  std::vector<std::string> all;
  for (const TableCell& cell : row) all.push_back(cell.text);
  return all;
}

bool has_row(const TextTable& table, const std::vector<std::string>& row) {
  return std::any_of(table.rows.begin(), table.rows.end(),
                     [&](const auto& r) { return texts(r) == row; });
}

const TableCell& cell_of(const TextTable& table, std::size_t row, const std::string& key) {
  const auto column = std::find_if(table.columns.begin(), table.columns.end(),
                                   [&](const TableColumn& c) { return c.key == key; });
  return table.rows.at(row).at(static_cast<std::size_t>(column - table.columns.begin()));
}

TextTable paper_alone(std::string_view scenario) {
  return comparison_table(*find_paper_table(scenario), {}, {});
}

TEST(PaperTable, AircraftFiguresAreTable2AsPrinted) {
  const TextTable table = paper_alone("aircraft");
  ASSERT_EQ(table.rows.size(), 4U);
  EXPECT_TRUE(has_row(table, {"Bircher [17]", "paper", "-", "577", "10,504", "1,347.6", "86.5%",
                              "93.9%", "98.8%", "-", "-"}));
  EXPECT_TRUE(has_row(table, {"Isler [29]", "paper", "-", "585", "10,846", "1,500.9", "85.1%",
                              "92.0%", "98.5%", "-", "-"}));
  EXPECT_TRUE(has_row(table, {"Proposed", "paper", "-", "635", "10,970", "1,396.5", "94.1%",
                              "97.2%", "99.8%", "-", "-"}));
  EXPECT_TRUE(has_row(
      table, {"Profile", "paper", "-", "-", "-", "370.0", "15.3%", "63.9%", "87.3%", "-", "-"}));
}

TEST(PaperTable, PowerPlantFiguresAreTable3AsPrintedItsDoubtfulColumnsMarked) {
  const TextTable table = paper_alone("power_plant");
  ASSERT_EQ(table.rows.size(), 4U);
  EXPECT_TRUE(has_row(table, {"Bircher [17]", "paper", "-", "162", "14,574", "479.5", "95.9%†",
                              "87.0%†", "98.5%", "-", "140"}));
  EXPECT_TRUE(has_row(table, {"Isler [29]", "paper", "-", "360", "24,425", "945.4", "95.7%†",
                              "86.3%†", "98.1%", "-", "152"}));
  EXPECT_TRUE(has_row(table, {"Proposed", "paper", "-", "210", "23,983", "469.5", "97.5%†",
                              "93.6%†", "98.9%", "-", "177"}));
  EXPECT_TRUE(has_row(
      table, {"Profile", "paper", "-", "-", "-", "512.0", "15.1%", "69.5%", "86.3%", "-", "-"}));
  EXPECT_NE(terminal_text(table).find("\n† as printed"), std::string::npos);
  EXPECT_EQ(terminal_text(paper_alone("aircraft")).find("†"), std::string::npos);
}

TEST(PaperTable, LabFiguresAreThoseOfSection322) {
  EXPECT_EQ(texts(paper_alone("lab_model").rows.at(0)),
            (std::vector<std::string>{"Proposed", "paper", "-", "40", "30,140", "32.0", "8.0", "-",
                                      "-", "-", "-", "33"}));
  EXPECT_EQ(texts(paper_alone("lab_airplane").rows.at(0)),
            (std::vector<std::string>{"Proposed", "paper", "-", "60", "28,949", "55.4", "15.0", "-",
                                      "-", "-", "-", "45"}));
  EXPECT_EQ(paper_alone("lab_model").rows.size(), 1U);
}

TEST(PaperTable, UnknownScenarioHasNone) { EXPECT_EQ(find_paper_table("lab"), nullptr); }

TEST(PaperTable, KnowsItsOwnStructures) {
  const PaperTable& aircraft = *find_paper_table("aircraft");
  EXPECT_TRUE(is_papers_structure(aircraft, "aircraft"));
  EXPECT_FALSE(is_papers_structure(aircraft, "power_plant"));
  EXPECT_FALSE(is_papers_structure(aircraft, "/absent.obj"));
  EXPECT_FALSE(is_papers_structure(aircraft, __FILE__));
  const std::string mesh = GNBV_SHARED_MESHES "/a340.obj";
  if (!std::filesystem::exists(mesh)) GTEST_SKIP() << mesh << " is not here";
  EXPECT_TRUE(is_papers_structure(aircraft, mesh));
  EXPECT_FALSE(is_papers_structure(*find_paper_table("power_plant"), mesh));
}

TEST(ComparisonTable, PutsOursAboveThePapersRowAndOthersAfter) {
  RunFigures oracle = example();
  oracle.utility = "oracle_views";
  const std::vector<RunFigures> runs = {oracle, example()};
  const TextTable table = comparison_table(*find_paper_table("aircraft"), runs, Ceiling{});
  std::vector<std::string> order;
  for (const auto& row : table.rows) order.push_back(row[0].text + ": " + row[1].text);
  EXPECT_EQ(order, (std::vector<std::string>{
                       "Bircher [17]: paper", "Isler [29]: paper", "Proposed: ours",
                       "Proposed: paper", "Oracle, few views: ours", "Profile: ours",
                       "Profile: paper", "Ceiling: physical", "Ceiling: leaf filter"}));
}

TEST(ComparisonTable, AGivenCeilingDividesAndHasNoRow) {
  Ceiling given;
  given.leaf_outside[0] = 0.5;
  given.is_given = true;
  const std::vector<RunFigures> runs = {example()};
  const TextTable table = comparison_table(*find_paper_table("aircraft"), runs, given);
  EXPECT_DOUBLE_EQ(*cell_of(table, 2, "share_of_ceiling").values[0],
                   example().coverage_final[0] / 0.5);
  for (const auto& row : table.rows) EXPECT_NE(row[0].text, "Ceiling");
}

// Oracle: t(0.975, 2) = 4.303 and the deviation of -1, 0, 1 is 1, so the half width
// is 4.303/sqrt 3.
TEST(ComparisonTable, SeveralSeedsGiveMeanAndInterval) {
  std::vector<RunFigures> runs(3, example());
  for (std::size_t i = 0; i < 3; ++i) {
    const double step = static_cast<double>(i) - 1.0;
    runs[i].seed = i;
    runs[i].coverage_final[0] = 0.8 + 0.01 * step;
    runs[i].coverage_profile[0] = 0.2 + 0.01 * step;
  }
  runs.push_back(runs[0]);  // a second utility of a seed adds no profile
  runs.back().utility = "tour";
  Ceiling ceiling;
  ceiling.leaf_outside = {0.9, 0.95, 1.0};
  const TextTable table = comparison_table(*find_paper_table("aircraft"), runs, ceiling);
  const double half_width = 0.01 * 4.302653 / std::sqrt(3.0);
  const TableCell& coverage = cell_of(table, 2, "coverage_0.05");
  EXPECT_EQ(coverage.text, "80.0 ±2.5%");
  EXPECT_NEAR(*coverage.values[1], half_width, 1e-8);
  const TableCell& share = cell_of(table, 2, "share_of_ceiling");
  EXPECT_NEAR(*share.values[0], 0.8 / 0.9, 1e-12);
  EXPECT_NEAR(*share.values[1], half_width / 0.9, 1e-8);
  EXPECT_EQ(cell_of(table, 2, "runs").text, "3");
  ASSERT_EQ(table.rows.at(5)[0].text, "Profile");
  EXPECT_EQ(cell_of(table, 5, "runs").text, "3");
  EXPECT_NEAR(*cell_of(table, 5, "coverage_0.05").values[1], half_width, 1e-8);
  EXPECT_EQ(cell_of(table, 8, "coverage_0.05").text, "90.0%");
}

TEST(ComparisonTable, ProfilesThatDifferAtASizeOfOnesOwnAreTwoRows) {
  const std::vector<std::string> settings = {"leaf_m=0.05", "leaf_m=0.07"};
  std::vector<RunFigures> runs = {example(), example()};
  for (RunFigures& run : runs) run.more = {{.size_m = 0.2, .profile = 0.7, .final = 0.97}};
  const auto profiles = [&] {
    const TextTable table = comparison_table(*find_paper_table("aircraft"), runs, {}, settings);
    return std::count_if(table.rows.begin(), table.rows.end(), [](const auto& row) {
      return row[0].text.starts_with("Profile") && row[1].text == "ours";
    });
  };
  EXPECT_EQ(profiles(), 1);
  runs[1].more[0].profile = 0.6;
  EXPECT_EQ(profiles(), 2);
}

/// As the distances do; the way to the first view is in neither.
TEST(ComparisonTable, LabTimesCountFromTheFirstViewToTheLast) {
  RunFigures run = example();
  run.scenario = run.structure = "lab_model";
  run.curve = {.coverage = {{}, {}, {}}, .metres = {0.0, 0.0, 9.0}, .seconds = {0.0, 30.0, 120.0}};
  const TextTable table = comparison_table(*find_paper_table("lab_model"), {&run, 1}, {});
  EXPECT_EQ(cell_of(table, 0, "time_min").text, "1.5");
  EXPECT_NE(table.notes[1].find("time from the first view on"), std::string::npos);
}

/// The paper's planners stopped at numbers of views of their own.
TEST(ComparisonTable, OursStandsBesideThePapersRowAfterAsManyViews) {
  std::vector<RunFigures> runs(2, example());
  runs[1].seed = 2;
  for (RunFigures& run : runs) {
    run.utility = "bircher";  // the paper's took 577 views
    CoverageCurve& curve = run.curve;
    for (int view = 0; view <= 635; ++view) {
      curve.coverage.push_back({view / 1000.0, view / 900.0, view / 800.0});
      curve.metres.push_back(view * 2.0);
      curve.seconds.push_back(view * 3.0);
    }
  }
  const auto cut_row = [&] {
    const TextTable table = comparison_table(*find_paper_table("aircraft"), runs, {});
    const auto at = std::find_if(table.rows.begin(), table.rows.end(),
                                 [](const auto& row) { return row[1].text == "ours, cut"; });
    return at == table.rows.end() ? std::vector<std::string>{} : texts(*at);
  };
  const std::vector<std::string> row = cut_row();
  ASSERT_FALSE(row.empty());
  EXPECT_EQ(row[0], "Bircher [17]");
  EXPECT_EQ(row[2], "2");
  EXPECT_EQ(row[3], "577 ±0");
  EXPECT_EQ(row[4], "-");  // of entropy the end alone is known
  EXPECT_EQ(row[5], "1,154.0 ±0.0");
  EXPECT_EQ(row[6], "57.7 ±0.0%");
  EXPECT_NE(one_row_summary(runs[0], true).find("ours, cut"), std::string::npos);
  runs[0].curve.coverage.resize(401);  // it ended before: as it is
  runs[0].curve.metres.resize(401);
  runs[0].curve.seconds.resize(401);
  runs[0].coverage_final = runs[0].curve.coverage.back();
  EXPECT_EQ(cut_row()[6].substr(0, 4), "48.9");
  runs[1] = runs[0];
  EXPECT_TRUE(cut_row().empty());
}

TEST(ComparisonTable, NotesTellHowEachRunEnded) {
  std::vector<RunFigures> runs(3, example());
  runs[1].termination = "collision";
  const TextTable table = comparison_table(*find_paper_table("aircraft"), runs, {});
  EXPECT_NE(table.notes.back().find("collision (1), max iterations (2)"), std::string::npos);
}

TEST(OneRowSummary, ShowsTheMissionOverThePaper) {
  const std::string text = one_row_summary(example(), true);
  const std::size_t ours = text.find("proposed  ours "), paper = text.find("proposed  paper");
  ASSERT_NE(ours, std::string::npos) << text;
  EXPECT_LT(ours, paper) << text;
  EXPECT_NE(paper, std::string::npos) << text;
  for (const char* words : {"Coverage 0.05 m", "504.3", "1,396.5", "85.2%", "94.1%",
                            "ended by max iterations after 635 views"}) {
    EXPECT_NE(text.find(words), std::string::npos) << words << " in " << text;
  }
}

TEST(OneRowSummary, StandsAloneWhereThePaperHasNoRow) {
  RunFigures tour = example();
  tour.utility = "tour";
  RunFigures smoke = example();
  smoke.scenario = "smoke";
  RunFigures own_mesh = example();
  own_mesh.structure = "/somewhere/bridge.obj";
  for (const std::string& text :
       {one_row_summary(tour, true), one_row_summary(smoke, true), one_row_summary(own_mesh, true),
        one_row_summary(tour, false), one_row_summary(own_mesh, false)}) {
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4) << text;
    EXPECT_EQ(text.find("paper"), std::string::npos) << text;
    EXPECT_NE(text.find("504.3"), std::string::npos) << text;
  }
}

/// A mission with other settings says why the paper's row is not there.
TEST(OneRowSummary, SaysWhyThePapersRowIsLeftOut) {
  const std::string text = one_row_summary(example(), false);
  EXPECT_EQ(text.find("proposed  paper"), std::string::npos) << text;
  EXPECT_NE(text.find("without the paper's row: ours has other sensors"), std::string::npos)
      << text;
}

}  // namespace
}  // namespace gnbv
