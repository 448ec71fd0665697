// Laws of the comparison with the paper: ours is taken after as many views as the paper's row took,
// a profile counts once a seed, and differences are paired by seed.
#include "tools/paper/comparisons.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/covered_record.hpp"

namespace gnbv {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kEntropy = 0;  // of compared_columns()
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
      .request = {.scenarios = {"power_plant"}, .seeds = {1, 2}, .overrides = {}}};
  for (const std::uint64_t seed : {1U, 2U}) {
    material.missions.push_back(
        made_mission("bircher", seed, 360, 0.001 * static_cast<double>(seed)));
    material.missions.push_back(made_mission("isler", seed, 100));
  }
  return material;
}

Json plant(const PaperMaterial& material) {
  return compared_table(material, *find_paper_table("power_plant"));
}

TEST(ComparedRow, IsTakenAfterAsManyViewsAsThePapers) {
  const Json rows = plant(made_material())["rows"];
  ASSERT_EQ(rows.size(), 4U);
  const Json& bircher = rows[0];  // the paper's took 162 views
  EXPECT_EQ(bircher["views"], 162);
  EXPECT_EQ(bircher["flown_views"], 360);
  const auto ours = [](const Json& row, std::size_t i) {
    return row["figures"][i]["ours"].get<double>();
  };
  EXPECT_NEAR(ours(bircher, kEntropy), 162.0, 1e-9);
  EXPECT_NEAR(ours(bircher, kMetres), 324.0, 1e-9);
  EXPECT_NEAR(ours(bircher, kFine), 16.2 + 0.15, 1e-9);
  EXPECT_NEAR(ours(bircher, kDensity), 171.0, 1e-9);
  const Json& isler = rows[1];  // the paper's took 360, ours ended before
  EXPECT_EQ(isler["views"], 100);
  EXPECT_NEAR(ours(isler, kEntropy), 100.0, 1e-9);
}

TEST(ComparedRow, SaysHowFarOursIsInPointsOfCoverageOrPercentOfTheAmount) {
  const Json figures = plant(made_material())["rows"][0]["figures"];
  EXPECT_NEAR(figures[kEntropy]["difference"], 100.0 * (162.0 / 14574.0 - 1.0), 1e-9);
  EXPECT_NEAR(figures[kFine]["difference"], 16.35 - 95.9, 1e-9);
}

TEST(ComparedRow, ThatALimitCutShortDoesNotDifferForThat) {
  PaperMaterial material = made_material();
  const auto verdict = [&](std::size_t row) {
    return plant(material)["rows"][row]["figures"][kFine]["verdict"];
  };
  EXPECT_EQ(verdict(1), "differs");
  material.missions[1].record.figures->termination = "no_valid_view";  // the planner's own end
  EXPECT_EQ(verdict(1), "differs");
  material.missions[1].record.figures->termination = "max_iterations";
  EXPECT_EQ(verdict(1), "cut short");
  for (const Json& figure : plant(material)["pairs"][0]["figures"]) {
    if (figure.is_null()) continue;
    EXPECT_EQ(figure["verdict"], "undecided");
  }
  material.missions[0].record.figures->termination = "max_iterations";  // after the paper's views
  EXPECT_EQ(verdict(0), "differs");
}

TEST(ComparedRow, WithoutMissionsHasThePapersNumbersAlone) {
  const Json proposed = plant(made_material())["rows"][2];
  EXPECT_EQ(proposed["utility"], "proposed");
  EXPECT_EQ(proposed["missions"], 0);
  for (const Json& figure : proposed["figures"]) {
    for (const char* const key : {"ours", "half_width", "difference", "verdict"}) {
      EXPECT_TRUE(figure[key].is_null()) << key;
    }
  }
  EXPECT_EQ(proposed["figures"][kFine]["printed"], 97.5);
}

TEST(ComparedRow, OfTheProfileCountsEachSeedOnce) {
  const Json profile = plant(made_material())["rows"][3];
  EXPECT_EQ(profile["label"], "Profile");
  EXPECT_EQ(profile["missions"], 2);
  EXPECT_NEAR(profile["figures"][kMetres]["ours"], 501.5, 1e-9);
  EXPECT_EQ(profile["figures"][kMetres]["verdict"], "close");
  EXPECT_TRUE(profile["figures"][kDensity]["ours"].is_null());
}

TEST(ComparedPair, IsPairedBySeed) {
  PaperMaterial material = made_material();
  for (std::uint64_t seed = 3; seed <= 6; ++seed) {  // the test asks for six
    material.missions.push_back(made_mission("bircher", seed, 360, 0.0015));
    material.missions.push_back(made_mission("isler", seed, 100));
  }
  material.missions.push_back(made_mission("isler", 7, 100));  // nobody else flew seed 7
  const Json pairs = plant(material)["pairs"];
  ASSERT_EQ(pairs.size(), 1U);  // nothing of Proposed, which was not flown
  EXPECT_EQ(pairs[0]["first"], "Isler [29]");
  EXPECT_EQ(pairs[0]["second"], "Bircher [17]");
  const Json& fine = pairs[0]["figures"][kFine];
  EXPECT_NEAR(fine["printed"], 95.7 - 95.9, 1e-9);
  EXPECT_NEAR(fine["ours"], 10.0 - 16.2 - 0.15, 1e-9);
  EXPECT_EQ(fine["verdict"], "same");
}

TEST(PaperCells, AreThoseOfTheTablesSeedBySeed) {
  const std::vector<Cell> cells =
      paper_cells({.scenarios = {"power_plant", "lab_model"}, .seeds = {3, 4}, .overrides = {}});
  ASSERT_EQ(cells.size(), 8U);
  for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_EQ(cells[i].seed, i < 4 ? 3U : 4U);
  EXPECT_EQ(cells[3].scenario, "lab_model");
  EXPECT_EQ(cells[0].resolved.planner.utility.name, cells[0].method);
}

/// What the document says of a figure of the paper; null where nothing.
Json claim_on(const PaperMaterial& material, const char* figure) {
  for (const Json& claim : checked_claims(material)) {
    EXPECT_EQ(claim["rule"].get<std::string>().rfind("holds ", 0), 0U);  // none without its measure
    if (claim["figure"] == figure) return claim;
  }
  return nullptr;
}

/// A mission that a limit of ours ended below it says nothing of where it would have come to.
TEST(Claims, DoNotFailByMissionsThatWereCutShort) {
  PaperMaterial material = made_material();
  EXPECT_TRUE(claim_on(material, "10").is_null());  // nobody flew it
  material.missions = {made_mission("proposed", 1, 10), made_mission("proposed", 2, 10, 0.0)};
  const auto verdict = [&] { return claim_on(material, "10")["verdict"]; };
  EXPECT_EQ(verdict(), "does not hold");
  for (PaperMission& mission : material.missions)
    mission.record.figures->termination = "max_iterations";
  EXPECT_EQ(verdict(), "cut short");
  EXPECT_EQ(claim_on(material, "10")["finding"],  // of one value no range
            "Above it at the end, at 0.05 m: 0 of 2 missions; coverage 90.0 %. Not counted, cut "
            "short below it: 2.");
  material.missions[0].record.figures->coverage_final[0] = 0.95;  // cut short, but above already
  EXPECT_EQ(verdict(), "holds");
  material.missions[1].record.figures->termination = "no_valid_view";
  EXPECT_EQ(verdict(), "partly");
}

TEST(Claims, AboutPhasesCountThoseWhereBothHappen) {
  PaperMaterial material = made_material();
  material.missions = {made_mission("proposed", 1, 10)};
  std::vector<ViewRecord>& views = material.missions[0].record.views;
  for (const std::size_t i : {2U, 3U, 6U}) views[i].decision.sampler = Sampler::fvs;
  EXPECT_EQ(claim_on(material, "11")["verdict"], "holds");
  views[6].entropy_nat = views[5].entropy_nat + 1.0;
  EXPECT_EQ(claim_on(material, "11")["verdict"], "partly");
  EXPECT_EQ(claim_on(material, "11")["finding"],
            "Of 2 such phases, entropy fell in 1, density rose in 2: both in 1, 50.0 %.");
}

}  // namespace
}  // namespace gnbv
