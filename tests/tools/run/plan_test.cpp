// Laws of a tour's files: what was planned and what came of it read back as they were written, a
// damaged file is refused by file and line, and what is left of a plan is what was not yet flown.
#include <gtest/gtest.h>

#include "sim/core/error.hpp"
#include "tests/support/made_run.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/run/tour_files.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// What the action complains of.
template <typename Action>
std::string said_by(const Action& action) {
  try {
    action();
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
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

TEST(PlanFile, ReadsBackAsItWasWritten) {
  TempFolder temp;
  const std::vector<MadePlan> made = made_plans();
  write_file_atomically(temp.path() / kPlanFile, plan_jsonl(made));
  const std::vector<MadePlan> read = read_plans(tour_record(temp.path()));
  ASSERT_EQ(read.size(), made.size());
  EXPECT_EQ(plan_jsonl(read), plan_jsonl(made));
  for (std::size_t i = 0; i < made.size(); ++i) {
    EXPECT_EQ(read[i].iteration, made[i].iteration);
    EXPECT_EQ(read[i].plan.cube_m, made[i].plan.cube_m);
    ASSERT_EQ(read[i].plan.views.size(), made[i].plan.views.size());
    for (std::size_t k = 0; k < made[i].plan.views.size(); ++k) {
      EXPECT_TRUE(is_same_view(read[i].plan.views[k], made[i].plan.views[k])) << i << ' ' << k;
    }
    ASSERT_EQ(read[i].plan.cubes.size(), made[i].plan.cubes.size());
    for (std::size_t k = 0; k < made[i].plan.cubes.size(); ++k) {
      EXPECT_EQ(read[i].plan.cubes[k].source, made[i].plan.cubes[k].source);
      EXPECT_EQ(read[i].plan.cubes[k].p_world_m, made[i].plan.cubes[k].p_world_m);
      EXPECT_EQ(read[i].plan.cubes[k].expected, made[i].plan.cubes[k].expected);
    }
  }
}

TEST(PlanFile, WhatIsDamagedIsNamedByFileAndLine) {
  TempFolder temp;
  const RunRecord record = tour_record(temp.path());
  const std::string good = plan_jsonl(made_plans());
  const auto expect_complaint = [&](const std::string& from, const std::string& to,
                                    const std::string& words) {
    std::string text = good;
    text.replace(text.rfind(from), from.size(), to);
    write_file_atomically(temp.path() / kPlanFile, text);
    const std::string said = said_by([&] { read_plans(record); });
    EXPECT_TRUE(says(said, words)) << said;
  };
  expect_complaint("\"iteration\":3", "\"iteration\":2", "plan.jsonl:3: iteration 2 comes after 2");
  expect_complaint("\"iteration\":2", "\"iteration\":-2", "plan.jsonl:2: iteration");
  expect_complaint("\"x_m\":2.0000", "\"x_m\":\"two\"", "plan.jsonl:2: ");
  expect_complaint("\"x_m\":2.0000", "\"x_m\":2e9", "plan.jsonl:2: ");
  expect_complaint("\"frontier\":[[0.00,0.00,3.00,", "\"frontier\":[[0.00,3.00,", "plan.jsonl:1: ");
  expect_complaint("[0.00,0.00,3.00,1234.0]", "[0.00,0.00,3.00,-1]", "plan.jsonl:1: ");
  expect_complaint("}\n", "", "plan.jsonl:3: ");
}

TEST(PlanFile, RunsWithoutOneSayWhatWritesIt) {
  TempFolder temp;
  RunRecord record = tour_record(temp.path());
  EXPECT_TRUE(says(said_by([&] { read_plans(record); }), "plan.jsonl: is missing; `gnbv run"));
  EXPECT_TRUE(says(said_by([&] { read_plans(record); }), "--resume"));
  write_file_atomically(temp.path() / kSummaryFile, "{}");
  EXPECT_TRUE(says(said_by([&] { read_plans(record); }), "--out NEW"));
  record.scenario.planner.utility.name = "isler";
  const std::string said = said_by([&] { read_plans(record); });
  EXPECT_TRUE(says(said, "was flown by isler")) << said;
  EXPECT_TRUE(says(said, "--utility tour")) << said;
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

TEST(PredictionsFile, ReadsBackAsItWasWritten) {
  TempFolder temp;
  const fs::path file = temp.path() / kPredictionsFile;
  const std::vector<ViewOutcome> outcomes = {
      {1, {PatchSource::boundary, 4, 2, 17, 130.5, 65.2, 0.0}},
      {2, {PatchSource::opposite, 0, 1, 1, 6.0, 5.5, 6.0}}};
  const std::string good = predictions_csv(outcomes);
  write_file_atomically(file, good);
  const std::vector<ViewOutcome> read = read_predictions_csv(file);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(predictions_csv(read), good);
  EXPECT_EQ(read[0].gain.source, PatchSource::boundary);
  EXPECT_EQ(read[0].gain.observations, 4U);
  EXPECT_EQ(read[1].gain.incidence, 1U);
  EXPECT_EQ(read[0].gain.predicted, 65.2);
  for (const auto& [from, to, words] : std::vector<std::array<std::string, 3>>{
           {"opposite", "behind", "predictions.csv:3: 'behind' is no source"},
           {",45,", ",44,", "predictions.csv:3: '44' is no"},
           {",4,65,", ",5,65,", "predictions.csv:2: looks 5 must be less than 5"},
           {",5.5,", ",", "predictions.csv:3: '2,opposite"},
           {",5.5,", ",many,", "predictions.csv:3: promised `many` is not a number"},
           {"missing,", "", "predictions.csv:1: "}}) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    write_file_atomically(file, text);
    const std::string said = said_by([&] { read_predictions_csv(file); });
    EXPECT_TRUE(says(said, words)) << said;
  }
}

}  // namespace
}  // namespace gnbv
