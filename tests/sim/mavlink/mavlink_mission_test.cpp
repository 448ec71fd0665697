// Missions: how they are uploaded, what is refused, and how they are flown.
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "tests/sim/mavlink/mavlink_session.hpp"

namespace gnbv::mavlink {
namespace {

enum Item : std::uint16_t {  // MAV_CMD
  kWaypoint = 16,
  kLoiterTime = 19,
  kReturnToLaunch = 20,
  kLand = 21,
  kTakeoff = 22,
  kChangeSpeed = 178,
  kMissionStart = 300
};
constexpr std::uint8_t kAccepted = 0, kCancelled = 15;  // MAV_MISSION_RESULT

MissionItemInt item_at(std::uint16_t command, const Vec3& p_world_m, float hold_s = 0) {
  const GlobalPlace place = place_of(p_world_m);
  return {.param = {hold_s, 0, 0, std::nanf("")},
          .x = place.lat_deg_e7,
          .y = place.lon_deg_e7,
          .z = static_cast<float>(p_world_m.z()),
          .command = command,
          .frame = 6,
          .autocontinue = 1};
}

using Items = std::vector<MissionItemInt>;

/// As a client does: the count, and each item that is asked for. MAV_MISSION_RESULT.
int upload(Session& session, const Items& items) {
  session.answers<MissionAck>(MissionCount{static_cast<std::uint16_t>(items.size()), 1, 1, 0});
  for (std::size_t sent = 0; session.count<MissionAck>() == 0 && sent <= items.size(); ++sent) {
    const std::uint16_t asked = session.last<MissionRequestInt>().number;
    MissionItemInt item = items.at(asked);
    item.seq = asked;
    item.target_system = item.target_component = 1;
    session.answers<MissionAck>(item);
  }
  return session.last<MissionAck>().result;
}

Items download(Session& session) {
  const auto count = session.answers<MissionCount>(MissionRequestList{1, 1, 0}).at(0).number;
  Items items;
  for (std::uint16_t i = 0; i < count; ++i) {
    items.push_back(session.answers<MissionItemInt>(MissionRequestInt{i, 1, 1, 0}).at(0));
  }
  return items;
}

/// Whether they ask for the same: number, target and what is current are the protocol's.
bool same(MissionItemInt a, MissionItemInt b) {
  for (MissionItemInt* item : {&a, &b}) {
    item->seq = 0;
    item->target_system = item->target_component = item->current = 0;
  }
  return payload_of(a) == payload_of(b);
}

TEST(MavlinkMission, WhatWasUploadedIsDownloadedItemByItem) {
  Items items;
  for (int i = 0; i < 1500; ++i) items.push_back(item_at(kWaypoint, {0.1 * i, 0, 5}, 0.5F));
  Session session;
  ASSERT_EQ(upload(session, items), kAccepted);
  const Items read = download(session);
  ASSERT_EQ(read.size(), items.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    EXPECT_TRUE(same(read[i], items[i])) << i;
    EXPECT_EQ(read[i].seq, i);
  }
  EXPECT_EQ(session.vehicle().px4().mission().steps.size(), items.size());
  session.send(MissionClearAll{1, 1, 0});
  EXPECT_TRUE(download(session).empty());
}

TEST(MavlinkMission, AnUploadThatFailsLeavesTheMissionAsItWas) {
  Session session;
  const Items good = {item_at(kTakeoff, {0, 0, 3}), item_at(kWaypoint, {5, 0, 3})};
  ASSERT_EQ(upload(session, good), kAccepted);
  const auto bad = [&](int result, const auto& change) {
    MissionItemInt item = item_at(kWaypoint, {1, 1, 3});
    change(item);
    EXPECT_EQ(upload(session, {good[0], good[1], item}), result);
    const Items kept = download(session);
    ASSERT_EQ(kept.size(), 2U) << result;
    EXPECT_TRUE(same(kept[0], good[0]) && same(kept[1], good[1])) << result;
    EXPECT_EQ(session.vehicle().px4().mission().steps.size(), 2U);
  };
  const float nan = std::nanf(""), inf = std::numeric_limits<float>::infinity();
  bad(2, [](MissionItemInt& i) { i.frame = 1; });
  bad(3, [](MissionItemInt& i) { i.command = 9999; });
  bad(6, [](MissionItemInt& i) { i.param[0] = -1; });
  bad(6, [&](MissionItemInt& i) { i.param[0] = inf; });
  bad(9, [&](MissionItemInt& i) { i.param[3] = inf; });
  bad(10, [](MissionItemInt& i) { i.x = 900'000'001; });
  bad(10, [](MissionItemInt& i) { i.x = i.y = 0; });
  bad(11, [](MissionItemInt& i) { i.y = -1'800'000'001; });
  bad(12, [&](MissionItemInt& i) { i.z = nan; });
  bad(7, [](MissionItemInt& i) { i = {.param = {1, -5}, .command = kChangeSpeed}; });
  EXPECT_EQ(session.answers<MissionAck>(MissionCount{60000, 1, 1, 0}).at(0).result, 4);
}

TEST(MavlinkMission, LostAndRepeatedItemsAreAskedForAgainAndSilenceGivesUp) {
  Session session;
  session.send(MissionCount{2, 1, 1, 0});
  session.step_for(2);  // the request was lost
  EXPECT_GE(session.count<MissionRequestInt>(), 2U);
  EXPECT_GE(session.count<MissionRequest>(), 1U) << "who does not know integers";
  EXPECT_EQ(session.last<MissionRequestInt>().number, 0);
  MissionItemInt item = item_at(kWaypoint, {1, 1, 3});
  item.target_system = item.target_component = 1;
  session.forget();
  for (int i = 0; i < 3; ++i) session.send(item);  // once would do
  session.step_for(1);
  EXPECT_EQ(session.last<MissionRequestInt>().number, 1);
  EXPECT_EQ(session.count<MissionAck>(), 0U);
  session.step_for(6);
  ASSERT_EQ(session.count<MissionAck>(), 1U);
  EXPECT_EQ(session.last<MissionAck>().result, kCancelled);
  EXPECT_TRUE(session.vehicle().px4().mission().steps.empty());
  item.seq = 1;
  EXPECT_EQ(session.answers<MissionAck>(item).at(0).result, 13) << "nobody uploads";
  item.seq = 0;
  ASSERT_EQ(upload(session, {item}), kAccepted);
  EXPECT_EQ(session.answers<MissionAck>(item).at(0).result, kAccepted) << "the answer was lost";
}

TEST(MavlinkMission, TwoClientsOfALinkDoNotMixTheirUploads) {
  Session session;
  session.send(MissionCount{2, 1, 1, 0});
  session.set_sender(254);
  EXPECT_EQ(session.answers<MissionAck>(MissionCount{1, 1, 1, 0}).at(0).result, 1);
  MissionItemInt item = item_at(kWaypoint, {9, 9, 9});
  EXPECT_EQ(session.answers<MissionAck>(item).at(0).result, 1);
  session.send(MissionAck{1, 1, kCancelled, 0});
  session.set_sender(255);
  item = item_at(kWaypoint, {1, 1, 3});
  EXPECT_EQ(session.answers<MissionRequestInt>(item).at(0).number, 1);
  item.seq = 1;
  EXPECT_EQ(session.answers<MissionAck>(item).at(0).result, kAccepted);
}

TEST(MavlinkMission, WhoAsksInFloatsIsAnsweredInFloats) {
  Session session;
  const float nan = std::nanf("");
  const MissionItem takeoff = {.x = nan, .y = nan, .z = 3, .command = kTakeoff, .frame = 3};
  session.send(MissionCount{1, 1, 1, 0});
  ASSERT_EQ(session.answers<MissionAck>(takeoff).at(0).result, kAccepted);
  const auto read = session.answers<MissionItem>(MissionRequest{0, 1, 1, 0});
  EXPECT_TRUE(std::isnan(read.at(0).x) && std::isnan(read[0].y));
  EXPECT_EQ(read[0].z, 3.0F);
  ASSERT_EQ(upload(session, {item_at(kWaypoint, {100, -50, 3})}), kAccepted);
  const auto there = session.answers<MissionItem>(MissionRequest{0, 1, 1, 0}).at(0);
  EXPECT_LT((world_of_place(there.x, there.y, 3) - Vec3(100, -50, 3)).norm(), 0.5);
}

TEST(MavlinkMission, TakesOffFliesItsWaypointsInOrderAndLandsAtTheLast) {
  Session session;
  const std::vector<Vec3> corners = {{0, 0, 3}, {6, 0, 3}, {6, 6, 4}, {0, 6, 4}};
  const Items items = {item_at(kTakeoff, corners[0]), item_at(kWaypoint, corners[1]),
                       item_at(kLoiterTime, corners[2], 3), item_at(kWaypoint, corners[3]),
                       item_at(kLand, Vec3(-4, 6, 0))};
  ASSERT_EQ(upload(session, items), kAccepted);
  EXPECT_EQ(session.result_of(kMissionStart, 9), 2) << "no such item";
  ASSERT_EQ(session.result_of(kMissionStart, 0), 0);
  EXPECT_TRUE(session.vehicle().px4().is_armed());
  session.step_for(1);
  std::vector<double> nearest(corners.size(), 1e9);
  std::vector<int> states;
  for (int part = 0; part < 90 && session.vehicle().px4().is_armed(); ++part) {
    for (int tick = 0; tick < kTicksPerSecond; ++tick) {
      session.step();
      const Vec3 p_m = session.vehicle().state().T_world_body.translation();
      for (std::size_t i = 0; i < corners.size(); ++i) {
        nearest[i] = std::min(nearest[i], (p_m - corners[i]).norm());
      }
      const int state = session.last<ExtendedSysState>().landed_state;
      if (states.empty() || states.back() != state) states.push_back(state);
    }
  }
  EXPECT_EQ(states, (std::vector<int>{1, 3, 2, 4, 1}));
  for (std::size_t i = 0; i < corners.size(); ++i) EXPECT_LT(nearest[i], 2.0) << i;
  EXPECT_LT(nearest[2], 0.2) << "it stays there for 3 s";
  std::vector<std::uint16_t> reached;
  for (const auto& told : session.all<MissionItemReached>()) reached.push_back(told.seq);
  EXPECT_EQ(reached, (std::vector<std::uint16_t>{0, 1, 2, 3, 4}));
  EXPECT_LT((session.vehicle().state().T_world_body.translation() - Vec3(-4, 6, 0)).norm(), 0.7);
  session.step_for(2);
  EXPECT_EQ(session.last<MissionCurrent>().state, 5) << "complete";
  EXPECT_EQ(session.last<MissionCurrent>().total, 5);
}

TEST(MavlinkMission, ItsSpeedIsWhatItAsksForAndReturningEndsAtHome) {
  const auto top_speed_m_s = [](float speed_m_s) {
    Session session;
    session.send(ParamSet{4.0F, 1, 1, id_of("RTL_RETURN_ALT"), 9});
    const MissionItemInt speed = {.param = {1, speed_m_s}, .command = kChangeSpeed, .frame = 2};
    const MissionItemInt home = {.command = kReturnToLaunch, .frame = 2};
    EXPECT_EQ(upload(session, {speed, item_at(kWaypoint, {30, 0, 3}), home}), kAccepted);
    EXPECT_EQ(session.result_of(kMissionStart, 0), 0);
    double top_m_s = 0.0;
    for (int tick = 0; tick < 90 * kTicksPerSecond; ++tick) {
      session.step();
      const Px4& px4 = session.vehicle().px4();
      const VehicleState state = session.vehicle().state();
      if (px4.nav_state() == NavState::mission) {
        top_m_s = std::max(top_m_s, state.v_world_m_s.head<2>().norm());
      }
      if (!px4.is_armed()) break;
    }
    EXPECT_FALSE(session.vehicle().px4().is_armed());
    EXPECT_LT(session.vehicle().state().T_world_body.translation().norm(), 0.7);
    return top_m_s;
  };
  EXPECT_NEAR(top_speed_m_s(2), 2.0, 0.2);
  EXPECT_NEAR(top_speed_m_s(-2), 5.0, 0.5) << "MPC_XY_CRUISE";
}

TEST(MavlinkMission, PausesInHoldAndGoesOnFromTheItemThatIsCurrent) {
  Session session;
  ASSERT_EQ(upload(session, {item_at(kTakeoff, {0, 0, 3}), item_at(kWaypoint, {20, 0, 3}),
                             item_at(kWaypoint, {20, 20, 3})}),
            kAccepted);
  ASSERT_EQ(session.result_of(kMissionStart, 0), 0);
  const auto current = [&] { return session.vehicle().px4().mission().current; };
  for (int i = 0; i < 60 * kTicksPerSecond && current() == 0; ++i) session.step();
  session.step_for(2);
  session.send(SetMode{.custom_mode = custom_mode_of(NavState::hold), .target_system = 1});
  session.step_for(10);
  const Vec3 held_m = session.vehicle().state().T_world_body.translation();
  session.step_for(3);
  EXPECT_LT((session.vehicle().state().T_world_body.translation() - held_m).norm(), 0.1);
  EXPECT_EQ(session.last<MissionCurrent>().state, 4) << "paused";
  EXPECT_EQ(current(), 1U);
  session.send(MissionSetCurrent{2, 1, 1});
  session.send(MissionSetCurrent{3, 1, 1});
  session.listen();
  EXPECT_EQ(session.last<MissionCurrent>().seq, 2);
  EXPECT_STREQ(session.last<StatusText>().text.data(), "no mission item 3");
  session.send(SetMode{.custom_mode = custom_mode_of(NavState::mission), .target_system = 1});
  session.step_for(20);
  EXPECT_LT((session.vehicle().state().T_world_body.translation() - Vec3(20, 20, 3)).norm(), 0.3);
  EXPECT_EQ(session.vehicle().px4().nav_state(), NavState::hold) << "and then it holds";
}

TEST(MavlinkMission, BeginsAtTheItemMarkedCurrentAndWaitsAtOneThatDoesNotContinue) {
  Session session;
  Items items = {item_at(kTakeoff, {0, 0, 3}), item_at(kWaypoint, {20, 0, 3}),
                 item_at(kWaypoint, {0, 5, 3}), item_at(kWaypoint, {0, 10, 3})};
  items[2].current = 1;
  items[2].autocontinue = 0;
  ASSERT_EQ(upload(session, items), kAccepted);
  ASSERT_EQ(session.result_of(kMissionStart, -1), 0);
  for (std::uint16_t item = 2; item <= 3; ++item) {
    if (item == 3) session.send(MissionSetCurrent{item, 1, 1});
    session.step_for(25);
    const Vec3 p_m = session.vehicle().state().T_world_body.translation();
    EXPECT_LT((p_m - Vec3(0, 5.0 * (item - 1), 3)).norm(), 0.3);
    EXPECT_EQ(session.last<MissionItemReached>().seq, item);
    EXPECT_EQ(session.count<MissionItemReached>(), item - 1U);
  }
}

World level_ground(float z_m) {
  World world{.structure = {}, .has_ground = false};
  world.terrain.vertices_m = {{-50, -50, z_m}, {50, -50, z_m}, {50, 50, z_m}, {-50, 50, z_m}};
  world.terrain.faces = {{0, 1, 2}, {0, 2, 3}};
  return world;
}

TEST(MavlinkMission, HeightsAboveHomeCountFromTheGroundThereAndThoseAboveTheSeaDoNot) {
  constexpr double kGround_m = 3.5;
  Session session({}, std::nullopt, {}, level_ground(kGround_m));
  const auto is_at = [&](double z_m, double after_s = 15) {
    session.step_for(static_cast<int>(after_s));
    EXPECT_NEAR(session.vehicle().state().T_world_body.translation().z(), z_m, 0.15);
    EXPECT_NEAR(session.last<GlobalPositionInt>().relative_alt_mm, 1e3 * (z_m - kGround_m), 150);
  };
  const auto go = [&](std::uint8_t frame, float z_m) {
    const GlobalPlace at = place_of(Vec3(8, 0, 0));
    session.send(CommandInt{.param = {-1, 1, 0, std::nanf("")},
                            .x = at.lat_deg_e7,
                            .y = at.lon_deg_e7,
                            .z = z_m,
                            .command = 192,
                            .target_system = 1,
                            .target_component = 1,
                            .frame = frame});
  };
  session.send(ParamSet{6.0F, 1, 1, id_of("RTL_RETURN_ALT"), 9});
  session.command(kArmDisarm, 1);
  session.send(SetMode{.custom_mode = custom_mode_of(NavState::takeoff), .target_system = 1});
  is_at(kGround_m + 2.5);
  EXPECT_EQ(session.last<HomePosition>().place.alt_mm, 3500);
  go(6, 4.0F);
  is_at(kGround_m + 4.0);
  go(0, 5.0F);
  is_at(5.0);
  MissionItemInt above_sea = item_at(kWaypoint, {8, 0, 8.5});
  above_sea.frame = 5;
  ASSERT_EQ(upload(session, {item_at(kWaypoint, {16, 0, 3}, 10), above_sea}), kAccepted);
  ASSERT_EQ(session.result_of(kMissionStart, 0), 0);
  is_at(kGround_m + 3.0, 12);
  is_at(8.5, 20);
  session.command(kReturnToLaunch);
  is_at(kGround_m + 6.0, 5);
  session.step_for(40);
  EXPECT_FALSE(session.vehicle().px4().is_armed());
}

TEST(MavlinkMission, ATakeoffAskedForBeforeArmingCountsFromTheGroundThere) {
  World slope = level_ground(0);  // rises by a tenth to the east
  for (Vec3f& vertex : slope.terrain.vertices_m) vertex.z() = 0.1F * vertex.x();
  Session session({}, std::nullopt, {}, slope);
  const auto take_off = [&](float alt_m) {
    session.send(CommandLong{.param = {0, 0, 0, 0, 0, 0, alt_m},
                             .command = kTakeoff,
                             .target_system = 1,
                             .target_component = 1});
    session.command(kArmDisarm, 1);
    session.step_for(15);
  };
  take_off(5);
  ASSERT_EQ(session.vehicle().px4().reposition({20, 0, 5}, 0, 0), Ack::accepted);
  session.step_for(15);
  session.command(kLand);
  session.step_for(20);
  ASSERT_FALSE(session.vehicle().px4().is_armed());
  take_off(5);
  EXPECT_NEAR(session.vehicle().state().T_world_body.translation().z(), 5, 0.2);
}

TEST(MavlinkMission, WithoutOneMissionModeDoesNotArm) {
  Session session;
  session.send(SetMode{.custom_mode = custom_mode_of(NavState::mission), .target_system = 1});
  session.listen();
  EXPECT_EQ(session.result_of(kArmDisarm, 1), 1) << "temporarily rejected";
  EXPECT_EQ(session.result_of(kMissionStart, 0), 2) << "denied";
  session.step_for(2);
  EXPECT_EQ(session.vehicle().px4().nav_state(), NavState::mission) << "and nothing is finished";
}

TEST(MavlinkMission, ItsOneStepThatReturnsHomeIsReachedOnce) {
  Session session;
  ASSERT_EQ(upload(session, {{.command = kReturnToLaunch, .frame = 2}}), kAccepted);
  ASSERT_EQ(session.result_of(kMissionStart, 0), 0);
  session.step_for(15);
  EXPECT_FALSE(session.vehicle().px4().is_armed()) << "it never flew";
  EXPECT_EQ(session.count<MissionItemReached>(), 1U);
}

}  // namespace
}  // namespace gnbv::mavlink
