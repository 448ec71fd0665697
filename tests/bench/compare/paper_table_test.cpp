#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "tests/bench/compare/paper_runs.hpp"

namespace gnbv {
namespace {

TextTable paper_alone(std::string_view scenario) {
  return comparison_table(*find_paper_table(scenario), {});
}

/// Almadhoun et al. 2019, Tables 2 and 3 and section 3.2.2, as printed.
TEST(PaperTable, FiguresAreThePapersAsPrintedItsDoubtfulColumnsMarked) {
  EXPECT_EQ(all_texts(paper_alone("aircraft")),
            (std::vector<Texts>{{"Bircher [17]", "paper", "-", "577", "10,504", "1,347.6", "86.5%",
                                 "93.9%", "98.8%", "-", "-"},
                                {"Isler [29]", "paper", "-", "585", "10,846", "1,500.9", "85.1%",
                                 "92.0%", "98.5%", "-", "-"},
                                {"Proposed", "paper", "-", "635", "10,970", "1,396.5", "94.1%",
                                 "97.2%", "99.8%", "-", "-"},
                                {"Profile", "paper", "-", "-", "-", "370.0", "15.3%", "63.9%",
                                 "87.3%", "-", "-"}}));
  EXPECT_EQ(all_texts(paper_alone("power_plant")),
            (std::vector<Texts>{{"Bircher [17]", "paper", "-", "162", "14,574", "479.5", "95.9%†",
                                 "87.0%†", "98.5%", "-", "140"},
                                {"Isler [29]", "paper", "-", "360", "24,425", "945.4", "95.7%†",
                                 "86.3%†", "98.1%", "-", "152"},
                                {"Proposed", "paper", "-", "210", "23,983", "469.5", "97.5%†",
                                 "93.6%†", "98.9%", "-", "177"},
                                {"Profile", "paper", "-", "-", "-", "512.0", "15.1%", "69.5%",
                                 "86.3%", "-", "-"}}));
  EXPECT_EQ(all_texts(paper_alone("lab_model")),
            (std::vector<Texts>{{"Proposed", "paper", "-", "40", "30,140", "32.0", "8.0", "-", "-",
                                 "-", "-", "33"}}));
  EXPECT_EQ(all_texts(paper_alone("lab_airplane")),
            (std::vector<Texts>{{"Proposed", "paper", "-", "60", "28,949", "55.4", "15.0", "-", "-",
                                 "-", "-", "45"}}));
  EXPECT_NE(terminal_text(paper_alone("power_plant")).find("\n† as printed"), std::string::npos);
  EXPECT_EQ(terminal_text(paper_alone("aircraft")).find("†"), std::string::npos);
  EXPECT_EQ(cell_of(paper_alone("power_plant"), 3, "coverage_0.10").values[0], 0.695);
  EXPECT_EQ(find_paper_table("lab"), nullptr);
}

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
  Ceiling ceiling;
  ceiling.leaf_counted = {1.0, 1.0, 1.0};
  const TextTable table = comparison_table(*find_paper_table("aircraft"), rows_of(runs, ceiling));
  std::vector<std::string> order;
  for (const auto& row : table.rows) order.push_back(row[0].text + ": " + row[1].text);
  EXPECT_EQ(order, (std::vector<std::string>{
                       "Bircher [17]: paper", "Isler [29]: paper", "Proposed: ours",
                       "Proposed: paper", "Oracle, few views: ours", "Profile: ours",
                       "Profile: paper", "Ceiling: physical", "Ceiling: leaf filter"}));
}

TEST(ComparisonTable, AGivenCeilingDividesAndHasNoRow) {
  Ceiling given;
  given.leaf_counted[0] = 0.5;
  given.is_given = true;
  const std::vector<RunFigures> runs = {example()};
  const TextTable table = comparison_table(*find_paper_table("aircraft"), rows_of(runs, given));
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
  ceiling.leaf_counted = {0.9, 0.95, 1.0};
  const TextTable table = comparison_table(*find_paper_table("aircraft"), rows_of(runs, ceiling));
  const double half_width = 0.01 * 4.302653 / std::sqrt(3.0);
  const TableCell& coverage = cell_of(table, 2, "coverage_0.05");
  EXPECT_EQ(coverage.text, "80.0 ±2.5%");
  EXPECT_NEAR(*coverage.values[1], half_width, 1e-8);
  const TableCell& share = cell_of(table, 2, "share_of_ceiling");
  EXPECT_NEAR(*share.values[0], 0.8 / 0.9, 1e-12);
  EXPECT_NEAR(*share.values[1], half_width / 0.9, 1e-8);
  EXPECT_EQ(cell_of(table, 2, "runs").text, "3");
  ASSERT_EQ(table.rows.at(6)[0].text, "Profile");
  EXPECT_EQ(cell_of(table, 6, "runs").text, "3");
  EXPECT_NEAR(*cell_of(table, 6, "coverage_0.05").values[1], half_width, 1e-8);
  EXPECT_EQ(cell_of(table, 9, "coverage_0.05").text, "90.0%");
}

// One run each is printed: 94.1 % of Proposed, 86.5 % of Bircher, and 1,396.5 and 1,347.6 m.
TEST(ComparisonTable, TellsWhichOfOursLieBelowThePaperAndHowOftenItsOrderComes) {
  std::vector<RunFigures> runs(5, example());
  const std::array coverage = {0.93, 0.95, 0.90, 0.94, 0.86};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].seed = i;
    runs[i].utility = i < 3 ? "proposed" : "bircher";
    runs[i].coverage_final[0] = coverage[i];
    runs[i].straight_m = i == 0 ? 1400.0 : 900.0;
  }
  const TextTable table = comparison_table(*find_paper_table("aircraft"), rows_of(runs));
  const auto place = std::find_if(table.rows.begin(), table.rows.end(), [](const auto& row) {
    return row[0].text == "Proposed" && row[1].text == "ours below";
  });
  ASSERT_NE(place, table.rows.end());
  const auto row = static_cast<std::size_t>(place - table.rows.begin());
  EXPECT_NEAR(*cell_of(table, row, "coverage_0.05").values[0], 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(*cell_of(table, row, "distance_m").values[0], 2.0 / 3.0, 1e-12);
  EXPECT_EQ(cell_of(table, row, "density_points_per_voxel").text, "-");  // the paper has none
  // 0.95 above both of Bircher's, 0.93 and 0.90 above one: 4 of 6 pairs; 1,400 m above both: 2 of 6
  EXPECT_TRUE(std::any_of(table.notes.begin(), table.notes.end(), [](const std::string& note) {
    return note.ends_with(
        "coverage at 0.05 m Proposed > Bircher [17]: 67 %, distance Proposed > Bircher [17]: 33 %, "
        "entropy reduction Proposed > Bircher [17]: 0 %");
  }));
}

TEST(ComparisonTable, ProfilesThatDifferAtASizeOfOnesOwnAreTwoRows) {
  const std::vector<std::string> settings = {"leaf_m=0.05", "leaf_m=0.07"};
  std::vector<RunFigures> runs = {example(), example()};
  for (RunFigures& run : runs) run.more = {{.size_m = 0.2, .profile = 0.7, .final = 0.97}};
  const auto profiles = [&] {
    const TextTable table =
        comparison_table(*find_paper_table("aircraft"), rows_of(runs, {}, settings));
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
  const TextTable table = comparison_table(*find_paper_table("lab_model"), rows_of({&run, 1}));
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
    const TextTable table = comparison_table(*find_paper_table("aircraft"), rows_of(runs));
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
  EXPECT_NE(one_row_summary(mission_row(runs[0]), true).find("ours, cut"), std::string::npos);
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
  const TextTable table = comparison_table(*find_paper_table("aircraft"), rows_of(runs));
  EXPECT_NE(table.notes.back().find("collision (1), max iterations (2)"), std::string::npos);
}

TEST(OneRowSummary, ShowsTheMissionOverThePaperOrSaysWhyNot) {
  const std::string text = one_row_summary(mission_row(example()), true);
  const std::size_t ours = text.find("proposed  ours "), paper = text.find("proposed  paper");
  ASSERT_NE(paper, std::string::npos) << text;
  EXPECT_LT(ours, paper) << text;
  for (const char* words : {"Coverage 0.05 m", "504.3", "1,396.5", "85.2%", "94.1%",
                            "ended by max iterations after 635 views"}) {
    EXPECT_NE(text.find(words), std::string::npos) << words << " in " << text;
  }
  const std::string other = one_row_summary(mission_row(example()), false);
  EXPECT_EQ(other.find("proposed  paper"), std::string::npos) << other;
  EXPECT_NE(other.find("without the paper's row: ours has other sensors"), std::string::npos);
}

TEST(OneRowSummary, StandsAloneWhereThePaperHasNoRow) {
  RunFigures tour = example(), smoke = example(), own_mesh = example();
  tour.utility = "tour";
  smoke.scenario = "smoke";
  own_mesh.structure = "/somewhere/bridge.obj";
  for (const RunFigures& run : {tour, smoke, own_mesh}) {
    for (const bool has_papers_setting : {true, false}) {
      const std::string text = one_row_summary(mission_row(run), has_papers_setting);
      EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4) << text;
      EXPECT_EQ(text.find("paper"), std::string::npos) << text;
      EXPECT_NE(text.find("504.3"), std::string::npos) << text;
    }
  }
}

TEST(PaperTable, OfNoisyRunsLeadsWithAccurateCoverage) {
  RunFigures noisy = example();
  noisy.is_noisy = true;
  noisy.coverage_accurate = {0.8, 0.9, 0.95};
  noisy.curve = {.coverage = {{0.167, 0.666, 0.896}}, .metres = {0.0}, .seconds = {0.0}};
  noisy.iterations = 640;  // the paper's has 635
  for (int view = 1; view <= 640; ++view) {
    noisy.curve.coverage.push_back(noisy.coverage_final);
    noisy.curve.metres.push_back(view);
    noisy.curve.seconds.push_back(view);
  }
  noisy.curve.accurate.assign(641, {0.7, 0.8, 0.9});
  const std::vector<RunFigures> runs = {noisy};
  const TextTable table = comparison_table(*find_paper_table("aircraft"), rows_of(runs));
  const auto key_at = [&](std::ptrdiff_t at) {
    return std::ranges::find(table.columns, "accurate_coverage_0.05", &TableColumn::key)[at].key;
  };
  EXPECT_EQ(key_at(1), "coverage_0.05");
  const auto row_of = [&](const std::string& kind) {
    const auto row = std::ranges::find(table.rows, kind, [](const auto& r) { return r[1].text; });
    return static_cast<std::size_t>(row - table.rows.begin());
  };
  EXPECT_EQ(cell_of(table, row_of("ours"), "accurate_coverage_0.05").text, "80.0%");
  EXPECT_EQ(cell_of(table, row_of("ours, cut"), "accurate_coverage_0.05").text, "70.0%");
  EXPECT_EQ(cell_of(table, row_of("paper"), "accurate_coverage_0.05").text, "-");
  for (const bool is_noisy : {true, false}) {
    noisy.is_noisy = is_noisy;
    EXPECT_EQ(
        one_row_summary(mission_row(noisy), false).find("Accurate 0.05 m") != std::string::npos,
        is_noisy);
  }
}

}  // namespace
}  // namespace gnbv
