// What the planner's options do to a whole mission: the smoke one, a second or so each.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "planner/utility.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tests/support/at_simd_level.hpp"
#include "tests/support/flown.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/run_files/candidates_jsonl.hpp"
#include "tools/run_files/iterations_csv.hpp"
#include "tools/run_files/profile_map.hpp"

namespace gnbv {
namespace {

TEST(PlannerMission, EveryUtilityFliesWithoutACollision) {
  std::vector<std::string_view> names = utility_names();
  names.insert(names.end(), kRouteNames.begin(), kRouteNames.end());
  EXPECT_GE(names.size(), 17U);
  for (const std::string_view name : names) {
    const Flown flight(smoke(
        {fmt::format("planner.utility.name={}", name), "planner.termination.max_iterations=5"}));
    EXPECT_NE(flight.result.termination, Termination::collision) << name;
    EXPECT_GE(flight.result.views.size(), 2U) << name;
    EXPECT_EQ(flight.result.views.back().decision.sampler == "route", is_route(name)) << name;
  }
}

class PlannerMissionAt : public AtSimdLevel {};

TEST_P(PlannerMissionAt, IsThatOfTheBaseline) {
  const std::string ours = result_sha256(Flown(smoke()).result);
  set_simd_level(SimdLevel::baseline);
  EXPECT_EQ(ours, result_sha256(Flown(smoke()).result));
}

GNBV_ABOVE_THE_BASELINE(PlannerMissionAt);

TEST(PlannerMission, ThePresetsFlyDifferently) {
  const Flown paper(smoke());
  const Flown released(smoke({"planner.preset=released"}));
  EXPECT_NE(result_sha256(paper.result), result_sha256(released.result));
  EXPECT_GE(released.result.views.size(), 3U);
}

TEST(PlannerMission, ASavedProfileIsTakenUpWhereItEnded) {
  // the ideal vehicle stands still where it is, however it came there
  const TempFolder folder;
  const std::filesystem::path file = folder.path() / "profile.map";
  MissionHooks hooks;
  hooks.on_profile_belief = [&](const Belief& belief) { write_belief(belief, file); };
  const Flown flown(smoke({"vehicle.kind=ideal"}), hooks);
  const Flown saved(smoke({"vehicle.kind=ideal", "planner.profiling.method=saved",
                           fmt::format("planner.profiling.file='{}'", file.string())}));
  EXPECT_EQ(saved.result.distance.profile_m, 0.0);
  EXPECT_EQ(saved.result.entropy_after_profile_nat, flown.result.entropy_after_profile_nat);
  ASSERT_EQ(saved.result.views.size(), flown.result.views.size());
  for (std::size_t i = 0; i < saved.result.views.size(); ++i) {
    const ViewRecord& a = saved.result.views[i];
    const ViewRecord& b = flown.result.views[i];
    EXPECT_EQ(a.decision.view.p_world_m, b.decision.view.p_world_m) << i;
    EXPECT_EQ(a.cloud_points, b.cloud_points) << i;
    EXPECT_EQ(a.entropy_nat, b.entropy_nat) << i;
  }
}

TEST(PlannerMission, TheCircularProfileSeesTheStructure) {
  const Flown circle(
      smoke({"planner.profiling.method=circular", "planner.termination.max_iterations=1"}));
  EXPECT_NE(circle.result.termination, Termination::collision);
  EXPECT_GT(circle.result.profile_points_world_m.size(), 100U);
}

TEST(PlannerMission, FliesByThePointsOnTheWay) {
  const Scenario scenario = smoke({"planner.termination.max_iterations=2"});
  const Flown straight(scenario);
  std::vector<Decision> recorded;
  for (const ViewRecord& view : straight.result.views) recorded.push_back(view.decision);
  const Vec3 from_m = recorded[0].view.p_world_m;
  const Vec3 via_m = from_m + Vec3(0.0, 0.0, 1.0);
  recorded[1].via_world_m = {via_m};
  MissionHooks hooks;
  hooks.replay = recorded;
  const Flown around(scenario, hooks);
  const double way_m = 1.0 + (recorded[1].view.p_world_m - via_m).norm();
  EXPECT_NEAR(around.result.distance.straight_m, way_m, 0.05);  // from where the profile left it
  EXPECT_NEAR(around.result.distance.flown_m, way_m, 0.1);
  double nearest_m = 1e9;
  for (const TrajectorySample& sample : around.result.trajectory) {
    if (sample.time_s < around.result.views[0].time_s) continue;
    nearest_m = std::min(nearest_m, (sample.T_world_body.translation() - via_m).norm());
  }
  EXPECT_LT(nearest_m, scenario.guidance.arrival_distance_m);
}

std::string candidates_of(const std::filesystem::path& folder, const std::vector<Decision>& replay,
                          std::size_t stop_after) {
  CandidatesFile file(folder, replay.size());
  std::size_t views = 0;
  MissionHooks hooks;
  hooks.replay = replay;
  hooks.on_view = [&](const ViewRecord&) { ++views; };
  hooks.should_stop = [&] { return views >= stop_after; };
  hooks.on_candidates = [&](const auto&... all) { file.write(all...); };
  const Flown flown(smoke({"planner.termination.max_iterations=6"}), hooks);
  file.finish();
  return read_file(folder / "candidates.jsonl");
}

TEST(CandidatesFile, HasEachCandidateOnceAndOneChosenADecision) {
  const TempFolder folder;
  std::istringstream lines(candidates_of(folder.path(), {}, 99));
  std::vector<int> chosen(6, 0);
  std::vector<int> all(6, 0);
  for (std::string line; std::getline(lines, line);) {
    const auto json = nlohmann::json::parse(line);
    const auto iteration = json["iteration"].get<std::size_t>();
    ++all.at(iteration);
    EXPECT_NE(json.contains("rejected"), json.contains("utility"));
    chosen.at(iteration) += json.value("chosen", false) ? 1 : 0;
  }
  EXPECT_EQ(chosen, (std::vector<int>{0, 1, 1, 1, 1, 1}));
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_GE(all[i], 12) << i;
}

TEST(CandidatesFile, IsRefusedForARunThatDidNotWriteOneBefore) {
  const TempFolder temp;
  EXPECT_THROW(CandidatesFile(temp.path(), 3), BadInput);
  EXPECT_NO_THROW(CandidatesFile(temp.path(), 1));  // the start alone is no decision
}

TEST(CandidatesFile, OfAResumedMissionIsThatOfAnUninterruptedOne) {
  const TempFolder whole;
  const TempFolder parts;
  const std::string expected = candidates_of(whole.path(), {}, 99);
  const Flown flown(smoke({"planner.termination.max_iterations=6"}));
  std::vector<Decision> recorded;
  for (std::size_t i = 0; i < 3; ++i) recorded.push_back(flown.result.views[i].decision);
  candidates_of(parts.path(), {}, 3);
  EXPECT_EQ(candidates_of(parts.path(), recorded, 99), expected);
}

TEST(IterationsCsv, KeepsTheWayToAView) {
  const TempFolder folder;
  ViewRecord view;
  view.decision.sampler = "fvs";
  view.decision.via_world_m = {Vec3(1.0 / 3.0, -2, 3), Vec3(4, 5e-7, 6)};
  write_file_atomically(folder.path() / "i.csv",
                        iterations_csv_header() + iterations_csv_row(view));
  const std::vector<Decision> read = read_decisions(folder.path() / "i.csv");
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].via_world_m, view.decision.via_world_m);
  EXPECT_EQ(read[0].sampler, "fvs");
}

}  // namespace
}  // namespace gnbv
