// Missions that fly a user's views.
#include <gtest/gtest.h>

#include <set>

#include "sim/core/error.hpp"
#include "tests/support/flown.hpp"
#include "tests/support/watch.hpp"

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
  EXPECT_TRUE(outcomes[2] == "not_free" || outcomes[2] == "collision") << outcomes[2];
  outcomes[2] = "in the structure";
  EXPECT_EQ(outcomes,
            (std::vector<std::string>{"out_of_bounds", "1", "in the structure", "2",
                                      "out_of_bounds", "beyond_gimbal", "3", "4"}));  // once more
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
  EXPECT_EQ(refused, (std::vector<std::size_t>{0, 2, 4, 5}));
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

// Missions of a vehicle whose camera hangs on a gimbal.

constexpr const char* kGimbal = "cameras.0.pitch_deg={min: 0, max: 60, step: 30}";

std::vector<ViewPose> around(double pitch_rad) {
  return {{Vec3(3.2, 0, 2), kPi, pitch_rad},
          {Vec3(0, 3.2, 2.5), -0.5 * kPi, pitch_rad},
          {Vec3(-3.2, 0, 2), 0.0, pitch_rad}};
}

Scenario route(const std::vector<ViewPose>& views, const std::string& pitch) {
  Scenario scenario = smoke({"planner.utility.name=route", pitch, "cameras.0.rate_hz=2",
                             "planner.validity.allow_unknown=true"});
  scenario.planner.routes.views = views;
  return scenario;
}

/// The oracle: a gimbal that rests at 20 degrees and is never asked for another pitch is a camera
/// fixed there, frame by frame, at the views and between them.
TEST(GimbalMission, ThatNeverTurnsIsThatOfAFixedCamera) {
  const Flown gimbal(
      route(around(deg_to_rad(20.0)), "cameras.0.pitch_deg={min: 20, max: 50, step: 10}"));
  const Flown fixed(route(around(0.0), "cameras.0.pitch_deg=20"));
  ASSERT_EQ(gimbal.result.views.size(), 4U);
  ASSERT_EQ(fixed.result.views.size(), 4U);
  const auto cloud = gimbal.result.belief.cloud.points_world_m();
  const auto expected = fixed.result.belief.cloud.points_world_m();
  EXPECT_EQ(std::vector(cloud.begin(), cloud.end()), std::vector(expected.begin(), expected.end()));
  const auto map = gimbal.result.belief.grid.all_log_odds();
  const auto expected_map = fixed.result.belief.grid.all_log_odds();
  EXPECT_TRUE(std::equal(map.begin(), map.end(), expected_map.begin(), expected_map.end()));
}

TEST(GimbalMission, TakesEveryFrameAtItsViewsPitch) {
  std::vector<ViewPose> views = around(0.0);
  for (std::size_t i = 0; i < views.size(); ++i) {
    views[i].gimbal_pitch_rad = deg_to_rad(std::array{60.0, 10.0, 30.0}[i]);
  }
  Watch watch;
  std::vector<double> pitches_rad;
  const Scenario scenario = route(views, kGimbal);
  watch.sensed = [&](const SensedView& view) {
    const Isometry T_body_camera = view.T_world_body.inverse() * view.depth[0].T_world_camera;
    const Vec3 ahead = T_body_camera.linear().col(2);
    pitches_rad.push_back(std::atan2(-ahead.z(), ahead.x()));
  };
  const Flown flight(scenario, {.observers = {&watch}});
  ASSERT_EQ(pitches_rad.size(), 4U);
  EXPECT_NEAR(pitches_rad[0], 0.0, 1e-9);  // the start is the most level it can be
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_NEAR(pitches_rad[i + 1], views[i].gimbal_pitch_rad, 1e-9) << i;
  }
}

/// 60 degrees a second: a view that only turns the gimbal takes as long as that.
TEST(GimbalMission, WaitsForTheGimbal) {
  const ViewPose down{Vec3(3.2, 0, 2), kPi, deg_to_rad(60.0)};
  const ViewPose level{Vec3(3.2, 0, 2), kPi, 0.0};
  const Flown flight(route({level, down, level, level}, kGimbal));
  const auto& views = flight.result.views;
  ASSERT_EQ(views.size(), 5U);
  constexpr double kRounding_s = 1e-9;
  EXPECT_GT(views[2].time_s - views[1].time_s, 1.0 - kRounding_s);
  EXPECT_LT(views[2].time_s - views[1].time_s, 1.5);
  EXPECT_GT(views[3].time_s - views[2].time_s, 1.0 - kRounding_s);
  EXPECT_LT(views[4].time_s - views[3].time_s, 0.5);
}

TEST(GimbalMission, ChoosesPitchesOfItsOwn) {
  const Flown flight(smoke({kGimbal, "planner.termination.max_iterations=8"}));
  std::set<double> used;
  for (const ViewRecord& view : flight.result.views) {
    used.insert(view.decision.view.gimbal_pitch_rad);
  }
  EXPECT_GT(used.size(), 1U);
  for (const double pitch_rad : used) {
    const auto all = pitches_rad(*flight.scenario.cameras[0].gimbal);
    EXPECT_NE(std::find(all.begin(), all.end(), pitch_rad), all.end());
  }
}

}  // namespace
}  // namespace gnbv
