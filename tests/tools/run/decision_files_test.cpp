// Laws of the files that tell of decisions, a tour's among them: what was written is what is read,
// an interrupted run goes on where they end, and what is left of a plan is what was not yet flown.
#include <gtest/gtest.h>

#include "tests/support/fault.hpp"
#include "tests/support/made_run.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/run/decision_lines.hpp"
#include "tools/run/tour_files.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;
using test::fault_of;
using test::says;

/// Two views of it are kept; one that is valid is not, and one sees nothing.
Plan made_burst() {
  Plan burst;
  burst.candidates.assign(5, {.view = {Vec3(1, 2, 3), 0.5}, .sampler = Sampler::fvs, .cluster = 0});
  burst.candidates[0].rejected = Rejection::collision;
  burst.candidates[1].covers = 4;
  burst.candidates[2].covers = 3;
  burst.candidates[3].covers = 2;
  burst.candidates[3].score.value = 0.25;
  burst.candidates[4].covers = 0;
  burst.candidates[4].rejected = Rejection::cluster_hidden;
  burst.chosen = {1, 3};
  return burst;
}

/// A run that was killed between two views of a burst has all that told of its decision.
TEST(CandidatesFile, GoesOnWithinABurstAndAtItsEnd) {
  TempFolder temp;
  const fs::path part = part_of(temp.path() / kCandidatesFile);
  CandidatesFile(temp.path(), 1).write(4, made_burst());  // chose views 4 and 5
  const std::string text = read_file(part);
  for (const std::size_t flown : {5U, 6U}) {
    CandidatesFile(temp.path(), flown);
    EXPECT_EQ(read_file(part), text) << flown;
  }
  EXPECT_TRUE(says(fault_of([&] { CandidatesFile(temp.path(), 7); }),
                   {"holds no candidates of iteration 6, which was flown"}));
}

TEST(CandidatesFile, OfAnOracleStaysEmptyAndThatOfARunWithoutOneIsRefused) {
  TempFolder temp;
  EXPECT_THROW(CandidatesFile(temp.path(), 3), BadInput);
  CandidatesFile(temp.path(), 1);  // the start alone is no decision
  EXPECT_NO_THROW(CandidatesFile(temp.path(), 7));
  EXPECT_EQ(read_file(part_of(temp.path() / kCandidatesFile)), "");
  EXPECT_FALSE(read_candidates(temp.path(), 1));
}

TEST(RoundTrip, CandidatesJsonl) {
  TempFolder temp;
  EXPECT_FALSE(read_candidates(temp.path(), 1)) << "no file";
  Plan plan;
  plan.candidates = {
      {.view = {Vec3(1.0 / 3.0, -1e-300, 2), 0.1 + 0.2},
       .sampler = Sampler::agvs,
       .scale = 4.0 / 7.0,
       .path_m = 5e-324,
       .score = {.value = 2.0 / 3.0,
                 .information = 1e20,
                 .density = 0.7,
                 .prediction = 0.3,
                 .distance = 1.0 / 9.0}},
      {.view = {Vec3(1, 2, 3), 0.5}, .sampler = Sampler::fvs, .cluster = 2, .path_m = 4.0}};
  plan.candidates[1].rejected = Rejection::cluster_hidden;
  plan.chosen = {0};
  CandidatesFile file(temp.path(), 1);
  file.write(1, plan);
  plan.chosen.clear();
  file.write(2, plan);
  const Plan burst = made_burst();
  file.write(3, burst);
  file.finish();
  const std::string text = read_file(temp.path() / kCandidatesFile);
  // the text of a number is the shortest that reads back as it: equal texts are equal numbers
  TempFolder again;
  CandidatesFile copy(again.path(), 1);
  for (const std::size_t iteration : {1U, 2U}) {
    const std::optional<Plan> read = read_candidates(temp.path(), iteration);
    ASSERT_TRUE(read && read->candidates.size() == 2U);
    EXPECT_EQ(read->candidates[0].view.p_world_m, plan.candidates[0].view.p_world_m);
    EXPECT_EQ(read->candidates[1].rejected, Rejection::cluster_hidden);
    copy.write(iteration, *read);
  }
  EXPECT_TRUE(
      says(fault_of([&] { read_candidates(temp.path(), 99); }), {"--candidates --out NEW"}));
  const std::optional<Plan> read = read_candidates(temp.path(), 3);
  EXPECT_EQ(read->chosen, burst.chosen);
  for (std::size_t i = 0; i < burst.candidates.size(); ++i) {
    EXPECT_EQ(read->candidates.at(i).covers, burst.candidates[i].covers) << i;
  }
  EXPECT_EQ(read->candidates[3].score.value, 0.25);
  copy.write(3, *read);
  copy.finish();
  EXPECT_EQ(read_file(again.path() / kCandidatesFile), text);
  write_file_atomically(part_of(temp.path() / kCandidatesFile), "{\"iteration\":1}\nno\n");
  EXPECT_TRUE(
      says(fault_of([&] { CandidatesFile(temp.path(), 2); }), {"candidates.jsonl.part:2: "}));
}

/// made_record() as if a tour had flown it.
RunRecord tour_record(const fs::path& folder) {
  RunRecord record = made_record();
  record.folder = folder;
  record.scenario.planner.utility.name = "tour";
  return record;
}

/// The first view of the first plan is passed over, the second one taken, the third never reached:
/// by then there is another plan.
std::vector<MadePlan> made_plans() {
  const RunRecord record = made_record();
  MadePlan first{.iteration = 1, .plan = {}};
  first.plan.cube_m = 0.5;
  first.plan.views = {
      {Vec3(1.25, -2.5, 3.0625), 0.5, 0.25}, record.views[1].decision.view, {Vec3(0, 0, 5), -1.0}};
  first.plan.cubes = {{PatchSource::sampled, Vec3(1.25, 0.5, -0.75), 12.5},
                      {PatchSource::opposite, Vec3(-1, 0, 2), 0.5},
                      {PatchSource::boundary, Vec3(0, 0, 3), 1234.0}};
  MadePlan second{.iteration = 2, .plan = {}};
  second.plan.cube_m = 1.0;
  second.plan.views = {record.views[2].decision.view, {Vec3(2, 2, 2), 1.0}};
  MadePlan last{.iteration = 3, .plan = {}};  // nothing pays any more
  last.plan.cube_m = 1.0;
  return {first, second, last};
}

TEST(RoundTrip, PlanJsonl) {
  TempFolder temp;
  const std::vector<MadePlan> made = made_plans();
  write_file_atomically(temp.path() / kPlanFile, plan_jsonl(made));
  const std::vector<MadePlan> read = read_plans(tour_record(temp.path()));
  EXPECT_EQ(plan_jsonl(read), plan_jsonl(made));
  EXPECT_TRUE(is_same_view(read.at(0).plan.views.at(0), made[0].plan.views[0]));
  EXPECT_EQ(read[0].plan.cubes.at(1).source, PatchSource::opposite);
  EXPECT_EQ(read[0].plan.cubes[0].p_world_m, made[0].plan.cubes[0].p_world_m);
}

TEST(PlanFile, RunsWithoutOneSayWhatWritesIt) {
  TempFolder temp;
  RunRecord record = tour_record(temp.path());
  const auto fault = [&] { return fault_of([&] { read_plans(record); }); };
  EXPECT_TRUE(says(fault(), {"plan.jsonl: is missing; `gnbv run", "--resume"}));
  write_file_atomically(temp.path() / kSummaryFile, "{}");
  EXPECT_TRUE(says(fault(), {"--out NEW"}));
  record.scenario.planner.utility.name = "isler";
  EXPECT_TRUE(says(fault(), {"was flown by isler", "--utility tour"}));
}

TEST(StandingPlan, IsWhatWasNotYetFlownOfTheLastOne) {
  TempFolder temp;
  RunRecord record = tour_record(temp.path());
  std::vector<MadePlan> plans = made_plans();
  const auto left = [&](std::size_t iteration) {
    return standing_plan(plans, record, iteration).value();
  };
  EXPECT_EQ(left(0).made, &plans[0]);
  EXPECT_EQ(left(0).views().size(), 3U);
  EXPECT_EQ(left(1).made, &plans[1]);
  EXPECT_EQ(left(2).made, &plans[2]);
  EXPECT_TRUE(left(2).views().empty());
  plans.resize(1);  // that one goes on
  ASSERT_EQ(left(1).views().size(), 1U);
  EXPECT_EQ(left(1).views()[0].p_world_m, Vec3(0, 0, 5));
  plans[0].iteration = 2;
  EXPECT_FALSE(standing_plan(plans, record, 0).has_value());
  EXPECT_FALSE(standing_plan({}, record, 2).has_value());
}

TEST(RoundTrip, PredictionsCsv) {
  TempFolder temp;
  const std::vector<ViewOutcome> outcomes = {
      {1, {PatchSource::boundary, 4, 2, 17, 130.5, 65.2, 0.0}},
      {2, {PatchSource::opposite, 0, 1, 1, 6.0, 5.5, 6.0}}};
  write_file_atomically(temp.path() / kPredictionsFile, predictions_csv(outcomes));
  const std::vector<ViewOutcome> read = read_predictions_csv(temp.path() / kPredictionsFile);
  EXPECT_EQ(predictions_csv(read), predictions_csv(outcomes));
  EXPECT_EQ(read.at(0).gain.observations, 4U);
  EXPECT_EQ(read.at(1).gain.predicted, 5.5);
}

bool operator==(const BelievedVoxels& a, const BelievedVoxels& b) {
  return a.unknown == b.unknown && a.predicted == b.predicted && a.frontier == b.frontier &&
         a.looked_at == b.looked_at;
}

TEST(VoxelRuns, AreTheVoxelsThatWereListed) {
  const std::vector<VoxelIndex> voxels = {0, 1, 2, 7, 9, 10};
  const VoxelRuns runs = runs_of(voxels);
  EXPECT_EQ(runs, (VoxelRuns{{0, 3}, {7, 1}, {9, 2}}));
  EXPECT_EQ(voxel_count(runs), voxels.size());
  EXPECT_TRUE(runs_of(std::span<const VoxelIndex>()).empty());
}

class Beliefs : public testing::Test {
 protected:
  TempFolder temp_;
  const BelievedVoxels first_{.unknown = {{0, 5}, {7, 1}}, .predicted = {{4, 1}}};
  const BelievedVoxels last_{.unknown = {{3, 97}}, .frontier = {{1, 9}}, .looked_at = {{2, 2}}};
};

TEST_F(Beliefs, AreReadAsTheyWereWritten) {
  EXPECT_TRUE(read_beliefs(temp_.path(), 4, 100).empty());  // kept none
  BeliefsFile file(temp_.path(), 1);
  file.write(1, first_);
  file.write(3, last_);
  file.finish();
  const std::vector<BelievedVoxels> read = read_beliefs(temp_.path(), 4, 100);
  ASSERT_EQ(read.size(), 4U);
  EXPECT_TRUE(read[1] == first_);
  EXPECT_TRUE(read[2] == BelievedVoxels{});
  EXPECT_TRUE(read[3] == last_);
  EXPECT_EQ(read_beliefs(temp_.path(), 2, 100).size(), 2U);  // of a run that was cut there
}

TEST_F(Beliefs, OfAnInterruptedRunGoOnWhereTheyEnd) {
  {
    BeliefsFile file(temp_.path(), 1);
    file.write(1, first_);
    file.write(2, last_);
    file.write(3, last_);
  }
  const auto part = part_of(temp_.path() / kBeliefsFile);
  write_file_atomically(part, read_file(part) + "{\"iterat");  // died while it wrote
  BeliefsFile file(temp_.path(), 2);
  file.write(3, last_);
  file.finish();
  const std::vector<BelievedVoxels> read = read_beliefs(temp_.path(), 4, 100);
  EXPECT_TRUE(read.at(1) == first_);
  EXPECT_TRUE(read.at(2) == BelievedVoxels{});
  EXPECT_TRUE(read.at(3) == last_);
  TempFolder older;  // an older program's run has no such file
  EXPECT_NO_THROW(BeliefsFile(older.path(), 5));
}

}  // namespace
}  // namespace gnbv
