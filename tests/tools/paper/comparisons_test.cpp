// Laws of the comparison with the paper: ours is taken after as many views as the paper's row took,
// a profile counts once a seed, and differences are paired by seed.
#include "tools/paper/comparisons.hpp"

#include <gtest/gtest.h>

#include "sim/core/error.hpp"
#include "tests/support/covered_record.hpp"
#include "tools/paper/page_parts.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kEntropy = 0;  // of compared_figures()
constexpr std::size_t kMetres = 1;
constexpr std::size_t kFine = 3;
constexpr std::size_t kDensity = 6;

/// So many views; after n of them the coverage is n / 1000 + `ahead`, the entropy 5000 - n.
PaperMission made_mission(const std::string& utility, std::uint64_t seed, int views,
                          double ahead = 0.0) {
  std::vector<double> coverage;
  for (int i = 0; i <= views; ++i) coverage.push_back(0.001 * i + ahead);
  PaperMission mission{"power_plant", utility, seed, covered_record(seed, coverage)};
  mission.record.views.clear();
  for (int i = 0; i < views; ++i) {
    ViewRecord view{.iteration = i};
    view.entropy_nat = 5000.0 - (i + 1);
    view.density_points_per_voxel = 10.0 + i;
    mission.record.views.push_back(view);
  }
  mission.record.figures->entropy_reduction_nat = views;
  mission.record.figures->before.profile_m = 500.0 + static_cast<double>(seed);
  mission.record.figures->coverage_final = {0.9 + ahead, 0.9, 0.9};
  return mission;
}

PaperMaterial made_material() {
  PaperMaterial material{
      .request = {.scenarios = {"power_plant"}, .seeds = {1, 2}, .overrides = {}},
      .missions = {},
      .with_images = {},
      .notes = {}};
  for (const std::uint64_t seed : {1U, 2U}) {
    material.missions.push_back(
        made_mission("bircher", seed, 360, 0.001 * static_cast<double>(seed)));
    material.missions.push_back(made_mission("isler", seed, 100));
  }
  return material;
}

const PaperTable& plant() { return *find_paper_table("power_plant"); }

TEST(ComparedRow, IsTakenAfterAsManyViewsAsThePapers) {
  const std::vector<ComparedRow> rows = compare_rows(made_material(), plant());
  ASSERT_EQ(rows.size(), 4U);
  const ComparedRow& bircher = rows[0];  // the paper's took 162 views
  EXPECT_EQ(bircher.views, 162);
  EXPECT_EQ(bircher.flown_views, 360);
  EXPECT_NEAR(bircher.figures[kEntropy].ours->mean, 162.0, 1e-9);
  EXPECT_NEAR(bircher.figures[kMetres].ours->mean, 324.0, 1e-9);
  EXPECT_NEAR(bircher.figures[kFine].ours->mean, 16.2 + 0.15, 1e-9);
  EXPECT_NEAR(bircher.figures[kDensity].ours->mean, 171.0, 1e-9);
  const ComparedRow& isler = rows[1];  // the paper's took 360, ours ended before
  EXPECT_EQ(isler.views, 100);
  EXPECT_NEAR(isler.figures[kEntropy].ours->mean, 100.0, 1e-9);
  EXPECT_EQ(isler.figures[kFine].agreement, Agreement::differs);
}

TEST(ComparedRow, ThatALimitCutShortDoesNotDifferForThat) {
  PaperMaterial material = made_material();
  const auto fine_of_isler = [&] {
    return *compare_rows(material, plant())[1].figures[kFine].agreement;
  };
  material.missions[1].record.figures->termination = "no_valid_view";  // the planner's own end
  EXPECT_EQ(fine_of_isler(), Agreement::differs);
  material.missions[1].record.figures->termination = "max_iterations";
  EXPECT_EQ(fine_of_isler(), Agreement::cut);
  for (const ComparedPair& pair : compare_pairs(material, plant())) {
    EXPECT_EQ(pair.order, PairOrder::undecided);
  }
  material.missions[0].record.figures->termination = "max_iterations";  // after the paper's views
  EXPECT_EQ(compare_rows(material, plant())[0].figures[kFine].agreement, Agreement::differs);
}

TEST(Summary, SaysEveryAmountInPercentAndNoSignedZero) {
  const PaperMaterial material = made_material();
  PaperPage page;
  page.tables = shown_tables(material);
  page.claims = check_claims(material);
  const std::string html = summary_html(page);
  EXPECT_NE(html.find("-99 %"), std::string::npos);  // 162 nat of 14,574
  EXPECT_EQ(html.find("×"), std::string::npos);
  EXPECT_EQ(html.find("+0.0<"), std::string::npos);
  EXPECT_NE(html.find("or at its own end where that came first"), std::string::npos);
}

TEST(ComparedRow, WithoutMissionsHasThePapersNumbersAlone) {
  const ComparedRow proposed = compare_rows(made_material(), plant())[2];
  EXPECT_EQ(proposed.utility, "proposed");
  EXPECT_EQ(proposed.missions, 0U);
  for (const ComparedFigure& figure : proposed.figures) {
    EXPECT_FALSE(figure.ours);
    EXPECT_FALSE(figure.agreement);
  }
  EXPECT_EQ(proposed.figures[kFine].printed, 97.5);
}

TEST(ComparedRow, OfTheProfileCountsEachSeedOnce) {
  const ComparedRow profile = compare_rows(made_material(), plant())[3];
  EXPECT_EQ(profile.label, "Profile");
  EXPECT_EQ(profile.missions, 2U);
  EXPECT_NEAR(profile.figures[kMetres].ours->mean, 501.5, 1e-9);
  EXPECT_EQ(profile.figures[kMetres].agreement, Agreement::close);
  EXPECT_FALSE(profile.figures[kDensity].ours);
}

TEST(ComparedPair, IsPairedBySeed) {
  PaperMaterial material = made_material();
  material.missions.push_back(made_mission("isler", 7, 100));  // nobody else flew seed 7
  std::size_t found = 0;
  for (const ComparedPair& pair : compare_pairs(material, plant())) {
    if (pair.figure != kFine) continue;
    ++found;  // nothing of Proposed, which was not flown
    EXPECT_EQ(pair.first, "Isler [29]");
    EXPECT_EQ(pair.second, "Bircher [17]");
    EXPECT_NEAR(pair.printed, 95.7 - 95.9, 1e-9);
    EXPECT_EQ(pair.ours.n, 2U);
    EXPECT_NEAR(pair.ours.mean, 10.0 - 16.2 - 0.15, 1e-9);
    EXPECT_EQ(pair.order, PairOrder::same);
  }
  EXPECT_EQ(found, 1U);
}

TEST(PaperCells, AreThoseOfTheTablesSeedBySeed) {
  const PaperRequest request{
      .scenarios = {"power_plant", "lab_model"}, .seeds = {3, 4}, .overrides = {}};
  const std::vector<Cell> cells = paper_cells(request);
  ASSERT_EQ(cells.size(), 8U);
  for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_EQ(cells[i].seed, i < 4 ? 3U : 4U);
  EXPECT_EQ(cells[3].scenario, "lab_model");
  EXPECT_EQ(cells[0].resolved.planner.utility.name, cells[0].method);
  const std::vector<Cell> pictured = pictured_cells(request);
  ASSERT_EQ(pictured.size(), 1U);
  EXPECT_EQ(pictured[0].id, cells[3].id);
}

TEST(PaperCells, RefuseAKeyThatNoScenarioHas) {
  const PaperRequest request{
      .scenarios = {"lab_model"}, .seeds = {1}, .overrides = {"planner.utilty=1"}};
  EXPECT_THROW(paper_cells(request), BadInput);
}

TEST(Claims, OfOneMissionNameNoRange) {
  PaperMaterial material = made_material();
  material.missions = {made_mission("proposed", 1, 10)};
  const auto about_coverage = [&] {
    for (const CheckedClaim& claim : check_claims(material)) {
      if (claim.figure == "10") return claim.finding;
    }
    return std::string();
  };
  EXPECT_EQ(about_coverage(), "Above it at the end, at 0.05 m: 0 of 1 mission; coverage 90.0 %.");
  material.missions.push_back(made_mission("proposed", 2, 10, 0.05));
  EXPECT_EQ(about_coverage(),
            "Above it at the end, at 0.05 m: 1 of 2 missions; coverage from 90.0 to 95.0 %.");
}

/// A mission that a limit of ours ended below it says nothing of where it would have come to.
TEST(Claims, DoNotFailByMissionsThatWereCutShort) {
  PaperMaterial material = made_material();
  material.missions = {made_mission("proposed", 1, 10), made_mission("proposed", 2, 10)};
  const auto about_coverage = [&] {
    for (const CheckedClaim& claim : check_claims(material)) {
      if (claim.figure == "10") return claim;
    }
    return CheckedClaim{};
  };
  EXPECT_EQ(about_coverage().verdict, ClaimVerdict::fails);
  for (PaperMission& mission : material.missions)
    mission.record.figures->termination = "max_iterations";
  EXPECT_EQ(about_coverage().verdict, ClaimVerdict::cut);
  EXPECT_NE(about_coverage().finding.find("cut short below it: 2."), std::string::npos);
  material.missions[0].record.figures->coverage_final[0] = 0.95;  // cut short, but above already
  EXPECT_EQ(about_coverage().verdict, ClaimVerdict::holds);
  material.missions[1].record.figures->termination = "no_valid_view";
  EXPECT_EQ(about_coverage().verdict, ClaimVerdict::partly);
}

TEST(Claims, AboutPhasesCountThoseWhereBothHappen) {
  PaperMaterial material = made_material();
  material.missions = {made_mission("proposed", 1, 10)};
  std::vector<ViewRecord>& views = material.missions[0].record.views;
  for (const std::size_t i : {2U, 3U, 6U}) views[i].decision.sampler = Sampler::fvs;
  const auto about_phases = [&] {
    for (const CheckedClaim& claim : check_claims(material)) {
      if (claim.figure == "11") return claim;
    }
    return CheckedClaim{};
  };
  EXPECT_EQ(about_phases().verdict, ClaimVerdict::holds);
  views[6].entropy_nat = views[5].entropy_nat + 1.0;
  EXPECT_EQ(about_phases().verdict, ClaimVerdict::partly);
  EXPECT_EQ(about_phases().finding,
            "Of 2 such phases, entropy fell in 1, density rose in 2: both in 1, 50.0 %.");
  for (const CheckedClaim& claim : check_claims(material)) {  // none without its measure
    EXPECT_EQ(claim.rule.substr(0, 6), "holds ") << claim.sentence;
  }
}

}  // namespace
}  // namespace gnbv
