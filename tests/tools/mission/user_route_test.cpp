// Missions that fly a user's views.
#include <gtest/gtest.h>

#include "sim/core/error.hpp"
#include "tests/support/flown_into.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/run/iterations_csv.hpp"
#include "tools/run/run_directory.hpp"

namespace gnbv {
namespace {

using Given = std::vector<ViewPose>;

const ViewPose kEast{Vec3(3.2, 0, 2), kPi};
const ViewPose kNorth{Vec3(0, 3.2, 2.5), -0.5 * kPi};
const ViewPose kOutside{Vec3(0, 5, 2), 0.0};       // the workspace ends at 4
const ViewPose kInside{Vec3(0, 0, 1.0), 0.0};      // in the structure
const ViewPose kBelow{Vec3(3.2, 0, 0.3), 0.0};     // validity.z_min_m = 0.7
const ViewPose kPitched{Vec3(3.2, 0, 2), 0, 0.3};  // and there is no gimbal

Scenario route_of(const Given& views, const std::vector<std::string>& more = {}) {
  // an entropy that hardly changes would end any other mission
  std::vector<std::string> overrides = {
      "planner.utility.name=route", "planner.termination.max_iterations=100",
      "planner.termination.entropy_change_percent=50", "planner.termination.entropy_window=1"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  Scenario scenario = smoke(overrides);
  scenario.planner.routes.views = views;
  return scenario;
}

const Given& mixed() {
  static const Given views = {kOutside, kEast, kInside, kNorth, kBelow, kPitched, kEast, kEast};
  return views;
}

TEST(UserRoute, FliesWhatMayBeFlownInItsOrderAndSaysWhyTheRestIsNot) {
  const Flown flight(route_of(mixed()));
  const MissionResult& result = flight.result;
  EXPECT_EQ(result.termination, Termination::route_flown);
  ASSERT_EQ(result.user_views.size(), mixed().size());
  std::vector<std::string> outcomes;
  for (const UserView& given : result.user_views) {
    outcomes.emplace_back(given.rejected ? std::string(name_of(*given.rejected))
                                         : fmt::format("{}", given.iteration.value()));
  }
  EXPECT_EQ(outcomes[0], "out_of_bounds");
  EXPECT_EQ(outcomes[1], "1");
  EXPECT_TRUE(outcomes[2] == "not_free" || outcomes[2] == "collision") << outcomes[2];
  EXPECT_EQ(outcomes[3], "2");
  EXPECT_EQ(outcomes[4], "out_of_bounds");
  EXPECT_EQ(outcomes[5], "beyond_gimbal");
  EXPECT_EQ(outcomes[6], "3");
  EXPECT_EQ(outcomes[7], "4");         // twice given, twice flown
  ASSERT_EQ(result.views.size(), 5U);  // and the start
  for (const UserView& given : result.user_views) {
    if (!given.iteration) continue;
    const Decision& flown = result.views[*given.iteration].decision;
    EXPECT_TRUE(is_same_view(flown.view, given.view));
    EXPECT_EQ(flown.sampler, Sampler::route);
  }
  // it was there: the trajectory passes by every view that was flown
  for (const ViewPose& view : {kEast, kNorth}) {
    double nearest_m = 1e9;
    for (const TrajectorySample& sample : result.trajectory) {
      nearest_m = std::min(nearest_m, (sample.T_world_body.translation() - view.p_world_m).norm());
    }
    EXPECT_LT(nearest_m, 2.0 * flight.scenario.guidance.arrival_distance_m);
  }
}

TEST(UserRoute, EndsAtMaxIterationsAndLeavesTheRest) {
  const Flown flight(route_of(mixed(), {"planner.termination.max_iterations=2"}));
  EXPECT_EQ(flight.result.termination, Termination::max_iterations);
  EXPECT_EQ(flight.result.views.size(), 2U);
  EXPECT_FALSE(flight.result.user_views.back().rejected ||
               flight.result.user_views.back().iteration);
}

/// One view after the other, as a pipe gives them.
MissionInputs one_by_one(const Given& views, std::vector<std::size_t>& refused) {
  MissionInputs inputs;
  inputs.sources.next_view = [views, next = std::size_t{0}]() mutable -> std::optional<ViewPose> {
    return next < views.size() ? std::optional(views[next++]) : std::nullopt;
  };
  inputs.sources.on_refused = [&](std::size_t index, Rejection) { refused.push_back(index); };
  return inputs;
}

TEST(UserRoute, OneByOneIsAsAllAtOnceAtAnyNumberOfThreads) {
  const std::string sha = result_sha256(Flown(route_of(mixed())).result);
  std::vector<std::size_t> refused;
  EXPECT_EQ(result_sha256(Flown(route_of({}), one_by_one(mixed(), refused), 1).result), sha);
  EXPECT_EQ(refused, (std::vector<std::size_t>{0, 2, 4, 5}));
  // the first ones from the scenario, as in a piped mission that was interrupted
  refused.clear();
  const Given first(mixed().begin(), mixed().begin() + 3);
  const Given rest(mixed().begin() + 3, mixed().end());
  EXPECT_EQ(result_sha256(Flown(route_of(first), one_by_one(rest, refused)).result), sha);
  EXPECT_EQ(refused, (std::vector<std::size_t>{0, 2, 4, 5}));
}

TEST(UserRoute, ResumedEqualsTheUninterruptedOne) {
  TempFolder temp;
  const Scenario scenario = route_of(mixed());
  const auto run = temp.path() / "run";
  EXPECT_EQ(fly_into(run, scenario, false, 3).termination, Termination::interrupted);
  ASSERT_EQ(read_decisions(temp.path() / "run/iterations.csv.part").size(), 3U);
  const MissionResult resumed = fly_into(run, scenario, true);
  EXPECT_EQ(result_sha256(resumed), result_sha256(Flown(scenario).result));
  EXPECT_EQ(resumed.user_views[2].rejected.has_value(), true);  // reasons are found again
}

/// Its scenario holds the planner, not the views: the record has them. It is asked again where it
/// is there, and may not answer otherwise.
TEST(UserRoute, ARecordOfAUsersPlannerFliesAgainWithItAndWithoutIt) {
  Scenario scenario = route_of({});
  scenario.planner.utility.name = kUserUtilityName;
  scenario.planner.utility.python = {
      .kind = UserFunctionKind::planner, .function = "plan", .source = "def plan(b, h): ..."};
  std::vector<std::size_t> refused;
  const MissionResult flown = Flown(scenario, one_by_one(mixed(), refused)).result;
  EXPECT_EQ(flown.termination, Termination::route_flown);
  EXPECT_EQ(result_sha256(flown), result_sha256(Flown(route_of(mixed())).result));
  std::vector<Decision> record;
  for (const ViewRecord& view : flown.views) record.push_back(view.decision);
  const Flown alone(scenario, {.replay = record});
  EXPECT_EQ(alone.result.views.size(), flown.views.size());
  EXPECT_EQ(alone.result.views.back().entropy_nat, flown.views.back().entropy_nat);
  MissionInputs again = one_by_one(mixed(), refused);
  again.replay = record;
  const MissionResult repeated = Flown(scenario, again).result;
  EXPECT_EQ(result_sha256(repeated), result_sha256(flown));
  EXPECT_EQ(repeated.user_views.size(), flown.user_views.size());
  MissionInputs otherwise = one_by_one({kNorth, kEast}, refused);
  otherwise.replay = record;
  EXPECT_THROW(Flown(scenario, otherwise), BadInput);
}

TEST(UserRoute, ARecordOfOtherViewsIsNotResumed) {
  const MissionInputs inputs = {
      .replay = {{.view = {}}, {.view = kNorth, .sampler = Sampler::route}}};
  EXPECT_THROW(Flown(route_of({kEast}), inputs), BadInput);
}

}  // namespace
}  // namespace gnbv
