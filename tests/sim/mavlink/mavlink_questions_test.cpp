// What a ground station asks at connection, and what it is answered.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "sim/core/rng.hpp"
#include "sim/mavlink/endpoint.hpp"
#include "sim/mavlink/messages.hpp"
#include "tests/sim/mavlink/mavlink_session.hpp"

namespace gnbv::mavlink {
namespace {

enum Command : std::uint16_t {  // MAV_CMD
  kGetMessageInterval = 510,
  kSetMessageInterval = 511,
  kRequestMessage = 512,
  kRequestAutopilotCapabilities = 520
};

std::string name_of(const ParameterId& id) { return {id.begin(), std::ranges::find(id, '\0')}; }

ParamSet set(std::string_view name, float value, std::uint8_t type = 9) {
  return {value, 1, 1, id_of(name), type};
}

TEST(MavlinkQuestions, TelemetryComesAtTheRatesAskedFor) {
  Session session;
  session.command(kSetMessageInterval, Attitude::kInfo.id, 100'000);
  session.command(kSetMessageInterval, LocalPositionNed::kInfo.id, -1);
  session.command(kSetMessageInterval, GlobalPositionInt::kInfo.id, 20'000);
  session.command(kGetMessageInterval, Attitude::kInfo.id);
  session.listen();
  EXPECT_EQ(session.last<MessageInterval>().interval_us, 100'000);
  EXPECT_EQ(session.last<MessageInterval>().message_id, Attitude::kInfo.id);
  for (const auto& ack : session.all<CommandAck>()) EXPECT_EQ(ack.result, 0);
  session.forget();
  session.step_for(10);
  EXPECT_NEAR(static_cast<double>(session.count<Attitude>()), 100, 2);
  EXPECT_EQ(session.count<LocalPositionNed>(), 0U);
  EXPECT_NEAR(static_cast<double>(session.count<GlobalPositionInt>()), 500, 2);
  session.command(kSetMessageInterval, LocalPositionNed::kInfo.id, 0);
  session.forget();
  session.step_for(10);
  EXPECT_NEAR(static_cast<double>(session.count<LocalPositionNed>()), 300, 2) << "the default";
}

TEST(MavlinkQuestions, AskedForAMessageItComesAndWhatIsNoneIsUnsupported) {
  Session session;
  EXPECT_EQ(session.result_of(kRequestMessage, AutopilotVersion::kInfo.id), 0);
  EXPECT_EQ(session.result_of(kRequestMessage, ProtocolVersion::kInfo.id), 0);
  EXPECT_EQ(session.result_of(kRequestMessage, GpsGlobalOrigin::kInfo.id), 0);
  EXPECT_EQ(session.result_of(kRequestAutopilotCapabilities, 1), 0);
  ASSERT_EQ(session.count<AutopilotVersion>(), 2U);
  EXPECT_EQ(session.last<AutopilotVersion>().capabilities, 8605U);
  EXPECT_EQ(session.last<ProtocolVersion>().max_version, 200);
  EXPECT_EQ(session.last<GpsGlobalOrigin>().place.lat_deg_e7, 473977420);
  EXPECT_EQ(session.result_of(kRequestMessage, 397), 3) << "COMPONENT_METADATA";
  for (const float id : {-1.0F, 12345.0F, 3e38F, std::nanf("")}) {
    EXPECT_EQ(session.result_of(kSetMessageInterval, id, 1000), 3) << id;
  }
  EXPECT_EQ(session.result_of(kSetMessageInterval, Attitude::kInfo.id, std::nanf("")), 3);
}

TEST(MavlinkQuestions, ACameraIsAComponentOfItsOwnWhereThereIsVideo) {
  constexpr std::uint8_t kCameraComponent = 100;
  const auto ask_camera = [&](Session& session, std::uint16_t command, float param1) {
    session.send(CommandLong{.param = {param1},
                             .command = command,
                             .target_system = 1,
                             .target_component = kCameraComponent});
    session.listen();
  };
  Session blind;
  ask_camera(blind, kRequestMessage, CameraInformation::kInfo.id);
  EXPECT_EQ(blind.count<CommandAck>(), 0U) << "nobody is there";
  EXPECT_EQ(blind.result_of(kRequestMessage, CameraInformation::kInfo.id), 3);

  Session session({.video = VideoStream{.camera = "front",
                                        .width_px = 640,
                                        .height_px = 480,
                                        .rate_hz = 10.0,
                                        .fov_x_deg = 60.0,
                                        .port = 5600}});
  session.send(Heartbeat{});
  session.step_for(3);
  std::map<std::uint8_t, int> beats;  // by component
  for (const Frame& frame : session.frames<Heartbeat>()) ++beats[frame.component_id];
  EXPECT_EQ(beats[1], beats[kCameraComponent]);
  EXPECT_GE(beats[1], 3);
  constexpr std::array<std::pair<int, float>, 2> kQuestions = {{{512, 259.0F}, {521, 1.0F}}};
  for (const auto& [command, param] : kQuestions) {
    session.forget();
    ask_camera(session, static_cast<std::uint16_t>(command), param);
    ASSERT_EQ(session.count<CameraInformation>(), 1U);
    for (const Frame& ack : session.frames<CommandAck>()) EXPECT_EQ(ack.component_id, 100);
    EXPECT_EQ(session.last<CommandAck>().result, 0);
    EXPECT_EQ(session.last<CameraInformation>().width_px, 640);
  }
  ask_camera(session, kRequestMessage, VideoStreamInformation::kInfo.id);
  const auto video = session.last<VideoStreamInformation>();
  EXPECT_EQ(std::string(video.uri.data()), "5600");
  EXPECT_EQ(std::string(video.name.data()), "front");
  EXPECT_EQ(video.fov_x_deg, 60);
  ask_camera(session, kArmDisarm, 1);
  EXPECT_EQ(session.last<CommandAck>().result, 3) << "a camera does not fly";
  EXPECT_FALSE(session.vehicle().px4().is_armed());
}

TEST(MavlinkQuestions, EveryParameterIsListedOnceAndCanBeReadBothWays) {
  Session session;
  session.send(ParamRequestList{1, 1});
  session.listen();
  const auto listed = session.all<ParamValue>();
  ASSERT_GT(listed.size(), 20U);
  std::set<std::string> names;
  for (const ParamValue& value : listed) {
    EXPECT_EQ(value.param_count, listed.size());
    EXPECT_TRUE(names.insert(name_of(value.param_id)).second) << name_of(value.param_id);
    const auto index = static_cast<std::int16_t>(value.param_index);
    for (const ParamRequestRead& asked :
         {ParamRequestRead{index, 1, 1, {}}, ParamRequestRead{-1, 1, 1, value.param_id}}) {
      const auto read = session.answers<ParamValue>(asked);
      ASSERT_EQ(read.size(), 1U);
      EXPECT_EQ(payload_of(read[0]), payload_of(value));
    }
  }
  EXPECT_TRUE(session.answers<ParamValue>(ParamRequestRead{-1, 1, 1, id_of("NO_SUCH")}).empty());
  EXPECT_STREQ(session.last<StatusText>().text.data(), "no parameter NO_SUCH");
}

TEST(MavlinkQuestions, AParameterIsSetWithinItsRangeAndTheAnswerIsWhatHolds) {
  Session session;
  session.send(set("MIS_TAKEOFF_ALT", 4.0F));
  session.send(set("COM_OBL_RC_ACT", std::bit_cast<float>(4), 6));
  session.listen();
  EXPECT_EQ(session.vehicle().px4().commander().takeoff_altitude_m, 4.0);
  EXPECT_EQ(session.vehicle().px4().commander().offboard_loss_action, OffboardLoss::land);
  for (const auto& refused :
       {set("MIS_TAKEOFF_ALT", -1.0F), set("MIS_TAKEOFF_ALT", std::nanf("")),
        set("MIS_TAKEOFF_ALT", 5.0F, 6), set("MPC_LAND_ALT1", 123.0F), set("COM_OF_LOSS_T", 0.02F),
        set("COM_OBL_RC_ACT", std::bit_cast<float>(8), 6), set("COM_OBL_RC_ACT", 4.0F, 6)}) {
    const auto before = session.answers<ParamValue>(ParamRequestRead{-1, 1, 1, refused.param_id});
    const auto after = session.answers<ParamValue>(refused);
    ASSERT_EQ(after.size(), 1U);
    EXPECT_EQ(payload_of(after[0]), payload_of(before.at(0))) << name_of(refused.param_id);
    EXPECT_EQ(session.count<StatusText>(), 1U);
  }
  EXPECT_EQ(session.vehicle().px4().commander().takeoff_altitude_m, 4.0);
}

TEST(MavlinkQuestions, EveryParameterOfTheCommanderIsReadAsItWasSet) {
  Session session;
  // both ends of the range and its middle; whole numbers too
  for (const double share : {1.0, 0.0, 0.5}) {
    for (const Px4Parameter& parameter : kPx4Parameters) {
      const bool is_whole = parameter.value == nullptr;
      const double wish = std::lerp(parameter.min, parameter.max, share);
      const float value = is_whole ? std::bit_cast<float>(static_cast<std::int32_t>(wish))
                                   : static_cast<float>(wish);
      const auto answers =
          session.answers<ParamValue>(set(parameter.name, value, is_whole ? 6 : 9));
      ASSERT_EQ(answers.size(), 1U) << parameter.name;
      EXPECT_EQ(std::bit_cast<std::uint32_t>(answers[0].param_value),
                std::bit_cast<std::uint32_t>(value))
          << parameter.name;
      EXPECT_EQ(name_of(answers[0].param_id), parameter.name);
      EXPECT_EQ(session.count<StatusText>(), 0U) << parameter.name;
    }
  }
}

TEST(MavlinkQuestions, EveryNumberOfTheCommanderIsAParameterOnce) {
  // as many doubles as the struct has: its other member is the action, a whole number
  constexpr std::size_t kDoubles = sizeof(CommanderParameters) / sizeof(double) - 1;
  std::set<std::size_t> offsets;
  const CommanderParameters commander;
  for (const Px4Parameter& parameter : kPx4Parameters) {
    if (parameter.value == nullptr) continue;
    offsets.insert(
        static_cast<std::size_t>(&(commander.*parameter.value) - &commander.offboard_loss_s));
  }
  EXPECT_EQ(offsets.size(), kDoubles);
  EXPECT_EQ(kPx4Parameters.size(), kDoubles + 1);
  EXPECT_TRUE(std::ranges::is_sorted(kPx4Parameters, {}, &Px4Parameter::name));
}

TEST(MavlinkQuestions, NoParameterThatCanBeSetBreaksTheVehicle) {
  constexpr std::array kValues = {0.0F,  0.1F,  0.5F,  0.6F,  1.0F,  2.0F,   3.0F,   4.0F,
                                  10.0F, 15.0F, 20.0F, 60.0F, 80.0F, 100.0F, 1000.0F};
  constexpr std::array<std::uint16_t, 3> kNext = {22, 20, 21};  // take off, return, land
  for (std::uint64_t trial = 0; trial < 10; ++trial) {
    Session session;
    session.command(kArmDisarm, 1);
    for (std::size_t leg = 0; leg < kNext.size(); ++leg) {
      for (std::size_t i = 0; i < kPx4Parameters.size(); ++i) {
        const std::uint64_t bits = random_bits({9, Stream::bench, trial, 100 * leg + i});
        session.send(set(kPx4Parameters[i].name, kValues[bits % kValues.size()]));
      }
      session.command(kNext[leg], 0);
      session.step_for(5);  // throws at NaN
    }
    EXPECT_TRUE(session.vehicle().state().T_world_body.matrix().allFinite()) << trial;
    EXPECT_GT(session.endpoint().counts().questions, 60U);
  }
}

TEST(MavlinkQuestions, ThereAreNoFencesNorRallyPointsAndNoneAreTaken) {
  for (std::uint8_t type = 1; type < 3; ++type) {
    Session session;
    const MissionCount count = session.answers<MissionCount>(MissionRequestList{1, 1, type}).at(0);
    EXPECT_EQ(payload_of(count), payload_of(MissionCount{0, 255, 190, type}));
    const auto result_of = [&](const auto& message) {
      const MissionAck ack = session.answers<MissionAck>(message).at(0);
      EXPECT_EQ(ack.mission_type, type);
      return ack.result;
    };
    EXPECT_EQ(result_of(MissionCount{5, 1, 1, type}), 3) << "unsupported";
    EXPECT_EQ(result_of(MissionCount{0, 1, 1, type}), 0);
    EXPECT_EQ(result_of(MissionClearAll{1, 1, type}), 0);
    EXPECT_EQ(result_of(MissionRequest{0, 1, 1, type}), 13) << "no such item";
    EXPECT_EQ(result_of(MissionRequestInt{0, 1, 1, type}), 13);
  }
}

TEST(MavlinkQuestions, TimeIsToldToWhoAsks) {
  Session session;
  session.step_for(1);
  session.send(Timesync{.tc1_ns = 0, .ts1_ns = 77});
  session.send(Timesync{.tc1_ns = 5, .ts1_ns = 78});  // an answer
  session.send(Ping{1234, 5, 0, 0});
  session.listen();
  ASSERT_EQ(session.count<Timesync>(), 1U);
  EXPECT_EQ(session.last<Timesync>().tc1_ns, 1'000'000'000);
  EXPECT_EQ(session.last<Timesync>().ts1_ns, 77);
  EXPECT_EQ(session.last<Ping>().time_us, 1234U);
  EXPECT_EQ(session.last<Ping>().target_system, 255);
}

TEST(MavlinkQuestions, WhatIsAskedWithoutEndIsAnsweredWithinABound) {
  Session session;
  for (int i = 0; i < 1000; ++i) session.send(ParamRequestList{1, 1});
  session.listen();
  EXPECT_LE(session.frames_heard(), kOutgoingMax);
  EXPECT_GT(session.endpoint().counts().unsaid, 20'000U);
  session.forget();
  session.command(kArmDisarm, 1);
  session.listen();
  EXPECT_EQ(session.count<CommandAck>(), 1U) << "and then it hears on";
}

TEST(MavlinkQuestions, SetpointsOfAnotherKindAreRefusedByNameAndIntegerCommandsObeyed) {
  Session session;
  session.answers<StatusText>(SetAttitudeTarget{.target_system = 1, .target_component = 1});
  EXPECT_STREQ(session.last<StatusText>().text.data(), "setpoint of attitude not supported");
  session.answers<StatusText>(
      SetPositionTargetGlobalInt{.target_system = 1, .target_component = 1});
  EXPECT_STREQ(session.last<StatusText>().text.data(), "setpoint out of bounds") << "0 N 0 E";
  EXPECT_EQ(session.endpoint().counts().refused_setpoints, 2U);
  const auto acks = session.answers<CommandAck>(
      CommandInt{.param = {1}, .command = kArmDisarm, .target_system = 1, .target_component = 1});
  EXPECT_EQ(acks.at(0).command, kArmDisarm);
  EXPECT_EQ(acks.at(0).result, 0);
  EXPECT_TRUE(session.vehicle().px4().is_armed());
}

/// Oracle: great circles. North and east of the origin, 30 m are as many on a sphere of 6371 km.
TEST(MavlinkQuestions, PlacesOnTheGlobeAreAsFarApartAsInTheWorld) {
  VehicleState state;
  state.T_world_body.translation() = Vec3(30.0, 40.0, 5.0);
  Session session;
  const auto place = said<GlobalPositionInt>({.estimate = state, .px4 = &session.vehicle().px4()});
  const auto origin = said<GpsGlobalOrigin>({});
  const double to_rad = 1e-7 * kPi / 180.0;
  const double lat_a = origin.place.lat_deg_e7 * to_rad;
  const double lat_b = place.place.lat_deg_e7 * to_rad;
  const double lon = (place.place.lon_deg_e7 - origin.place.lon_deg_e7) * to_rad;
  const double haversine = std::pow(std::sin((lat_b - lat_a) / 2.0), 2.0) +
                           std::cos(lat_a) * std::cos(lat_b) * std::pow(std::sin(lon / 2.0), 2.0);
  // 1e-7 deg is 11 mm
  EXPECT_NEAR(2.0 * 6371000.0 * std::asin(std::sqrt(haversine)), 50.0, 0.02);
  EXPECT_EQ(place.place.alt_mm, 5000);
  EXPECT_EQ(place.heading_cdeg, 9000) << "ENU's x is east";
}

TEST(MavlinkQuestions, TheQuaternionIsTheAttitude) {
  VehicleState state;
  state.T_world_body.linear() =
      (Eigen::AngleAxisd(0.4, Vec3::UnitZ()) * Eigen::AngleAxisd(-0.2, Vec3::UnitY()) *
       Eigen::AngleAxisd(0.3, Vec3::UnitX()))
          .toRotationMatrix();
  const auto q = said<AttitudeQuaternion>({.estimate = state}).q_ned_frd;
  const Eigen::Quaterniond q_ned_frd(q[0], q[1], q[2], q[3]);
  for (const Vec3& v_frd : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
    const Vec3 v_ned = swap_enu_ned(state.T_world_body.linear() * swap_flu_frd(v_frd));
    EXPECT_LT((q_ned_frd * v_frd - v_ned).norm(), 1e-6);  // float
  }
}

TEST(MavlinkQuestions, ReadyToArmIsToldUntilAFailsafe) {
  Session session;
  const Px4& px4 = session.vehicle().px4();
  const auto status = [&] {
    return said<SysStatus>({.px4 = &px4, .energy_wh = 12.0, .battery_wh = 48.0});
  };
  EXPECT_EQ(status().sensors_present, status().sensors_health);
  EXPECT_NE(status().sensors_health & 0x10000000, 0U);  // PREARM_CHECK
  EXPECT_EQ(status().battery_remaining_percent, 75);

  ASSERT_TRUE(session.fly_until({0, 0, 3}, 2.0, [&] { return session.now_s() > 1.0; }));
  session.command(kDoSetMode, 1, 6);  // OFFBOARD
  session.command(kArmDisarm, 1);
  ASSERT_TRUE(session.fly_until({0, 0, 3}, 15.0, [&] {
    return session.vehicle().state().T_world_body.translation().z() > 2.0;
  }));
  for (int tick = 0; tick < 5 * kTicksPerSecond && !px4.is_in_failsafe(); ++tick) session.step();
  ASSERT_TRUE(px4.is_in_failsafe()) << "its client fell silent";
  EXPECT_EQ(status().sensors_health & 0x10000000, 0U);
}

}  // namespace
}  // namespace gnbv::mavlink
