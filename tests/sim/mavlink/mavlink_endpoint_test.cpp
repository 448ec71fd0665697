// The vehicle as a client meets it: frames in, frames out, no network and no wall clock.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <ostream>

#include "sim/core/rng.hpp"
#include "tests/sim/mavlink/mavlink_session.hpp"

namespace gnbv::mavlink {
namespace {

constexpr std::uint16_t kDoReposition = 192;  // MAV_CMD
constexpr std::uint8_t kArmedFlag = 128;

TEST(MavlinkEndpoint, NothingIsSentBeforeAClientSpeaksUnlessItSpeaksFirst) {
  Session session;
  session.step_for(2);
  EXPECT_EQ(session.frames_heard(), 0U);
  session.send(Heartbeat{});
  session.listen();
  EXPECT_GE(session.frames_heard(), 5U);
  EXPECT_EQ(session.endpoint().counts().sent, 0U) << "taken, and then lost by the sender";
  session.endpoint().count_sent();
  EXPECT_EQ(session.endpoint().counts().sent, 1U);
  Session first({}, kClient);
  first.step();
  EXPECT_EQ(first.count<Heartbeat>(), 1U);
  EXPECT_EQ(first.count<LocalPositionNed>(), 1U);
}

TEST(MavlinkEndpoint, TelemetryComesAtItsRates) {
  Session session;
  session.send(Heartbeat{});
  session.step_for(10);
  // both ends count, and a message waits for the next tick
  EXPECT_NEAR(static_cast<double>(session.count<Heartbeat>()), 10, 1);
  EXPECT_NEAR(static_cast<double>(session.count<Attitude>()), 500, 2);
  EXPECT_NEAR(static_cast<double>(session.count<LocalPositionNed>()), 300, 2);
  EXPECT_NEAR(static_cast<double>(session.count<BatteryStatus>()), 5, 1);
  EXPECT_NEAR(static_cast<double>(session.count<ExtendedSysState>()), 50, 1);
  EXPECT_NEAR(session.last<LocalPositionNed>().time_boot_ms, 10000.0, 40.0);
}

TEST(MavlinkEndpoint, EveryCommandForUsIsAcknowledgedOnce) {
  Session session;
  EXPECT_EQ(session.result_of(kArmDisarm, 1), 0);
  EXPECT_EQ(session.last<CommandAck>().target_system, 255);
  EXPECT_EQ(session.last<CommandAck>().target_component, 190);
  EXPECT_EQ(session.last<Heartbeat>().base_mode & kArmedFlag, kArmedFlag);
  EXPECT_EQ(session.result_of(kDoReposition), static_cast<int>(Ack::unsupported));
  EXPECT_EQ(session.count<CommandAck>(), 2U);
}

TEST(MavlinkEndpoint, WhatIsForOthersIsIgnored) {
  Session session;
  session.send(CommandLong{.param = {1}, .command = kArmDisarm, .target_system = 2});
  session.send(CommandLong{
      .param = {1}, .command = kArmDisarm, .target_system = 1, .target_component = 100});
  session.send(SetMode{.custom_mode = 6U << 16, .target_system = 7, .base_mode = 1});
  session.send(Attitude{});
  session.send(ParamRequestList{2, 1});
  session.send(ParamSet{4.0F, 2, 1, id_of("MIS_TAKEOFF_ALT"), 9});
  session.send(MissionRequestList{1, 100, 0});
  session.listen();
  EXPECT_EQ(session.count<CommandAck>(), 0U);
  EXPECT_FALSE(session.vehicle().px4().is_armed());
  EXPECT_EQ(session.vehicle().px4().commander().takeoff_altitude_m, 2.5);
  EXPECT_EQ(session.endpoint().counts().ignored, 7U);
  session.send(CommandLong{.param = {1}, .command = kArmDisarm});  // 0, 0: everybody
  EXPECT_TRUE(session.vehicle().px4().is_armed());
}

TEST(MavlinkEndpoint, EveryModeThatIsToldCanBeAskedFor) {
  for (const NavState state : {NavState::manual, NavState::altitude, NavState::position,
                               NavState::takeoff, NavState::hold, NavState::mission, NavState::rtl,
                               NavState::land, NavState::offboard, NavState::stabilized}) {
    Session session;
    session.send_position({0, 0, 1});  // OFFBOARD wants its stream
    session.send(SetMode{.custom_mode = custom_mode_of(state), .target_system = 1, .base_mode = 1});
    session.listen();
    EXPECT_EQ(session.last<CommandAck>().command, kDoSetMode);
    EXPECT_EQ(session.last<CommandAck>().result, 0);
    EXPECT_EQ(session.vehicle().px4().intention(), state) << name_of(state);
  }
}

TEST(MavlinkEndpoint, ARefusedSetpointIsToldOnceASecond) {
  Session session;
  SetPositionTargetLocalNed message{.coordinate_frame = 7};
  for (int i = 0; i < 3 * kTicksPerSecond; ++i) {
    if (i % 5 == 0) session.send(message);
    session.step();
  }
  EXPECT_EQ(session.endpoint().counts().refused_setpoints, 150U);
  EXPECT_EQ(session.endpoint().counts().setpoints, 0U);
  EXPECT_NEAR(static_cast<double>(session.count<gnbv::mavlink::StatusText>()), 3, 1);
  EXPECT_EQ(std::string(session.last<gnbv::mavlink::StatusText>().text.data()),
            "setpoint frame 7 unsupported");
}

TEST(MavlinkEndpoint, ALongTextArrivesInChunks) {
  for (const std::size_t size : {0U, 1U, 49U, 50U, 51U, 99U, 100U, 101U, 150U}) {
    std::string said;
    for (std::size_t i = 0; i < size; ++i) said += static_cast<char>('a' + i % 26);
    const auto chunks = status_texts_of({.severity = 4, .text = said}, 9);
    std::string heard;
    for (std::size_t i = 0; i < chunks.size(); ++i) {
      EXPECT_EQ(chunks[i].severity, 4);
      EXPECT_EQ(chunks[i].id, size > 50 ? 9 : 0);
      EXPECT_EQ(chunks[i].chunk_seq, i);
      const auto end = std::ranges::find(chunks[i].text, '\0');
      EXPECT_EQ(end == chunks[i].text.end(), size >= 50 && i + 1 < chunks.size() + (size == 50))
          << "the last chunk of several, and only it, has a NUL";
      heard.append(chunks[i].text.begin(), end);
    }
    EXPECT_EQ(heard, said);
  }
}

TEST(MavlinkEndpoint, TheBatteryIsKnownOnlyWhereItIsConfigured) {
  const auto status = [](double energy_wh, double battery_wh) {
    return said<BatteryStatus>({.energy_wh = energy_wh, .battery_wh = battery_wh});
  };
  EXPECT_EQ(status(12.0, 0.0).remaining_percent, -1);
  EXPECT_EQ(status(12.0, 48.0).remaining_percent, 75);
  EXPECT_EQ(status(60.0, 48.0).remaining_percent, 0);
  EXPECT_EQ(status(1.0, 0.0).energy_consumed_hj, 36);  // 1 Wh = 3600 J
}

/// Any number a float can be, extremes more often than chance has them.
float wild_float(std::uint64_t trial, std::uint64_t index) {
  const std::uint64_t bits = random_bits({7, Stream::bench, trial, index});
  constexpr std::array kExtremes = {0.0F, 1.0F, -1.0F, 3e38F, -3e38F, 1e-40F, 21196.0F};
  if (bits % 3 == 0) return kExtremes[(bits >> 8) % kExtremes.size()];
  if (bits % 3 == 1) return static_cast<float>(static_cast<double>(bits >> 40) * 1e-5 - 80.0);
  return std::bit_cast<float>(static_cast<std::uint32_t>(bits >> 32));
}

TEST(MavlinkEndpoint, NothingAClientSaysBreaksTheVehicle) {
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    Session session;
    std::uint64_t index = 0;
    const auto wild = [&] { return wild_float(trial, ++index); };
    for (int i = 0; i < 1000; ++i) {
      CommandLong command{.command = std::array<std::uint16_t, 5>{400, 176, 22, 21, 20}[index % 5]};
      SetPositionTargetLocalNed setpoint{
          .p_m = {wild(), wild(), wild()},
          .v_m_s = {wild(), wild(), wild()},
          .a_m_s2 = {wild(), wild(), wild()},
          .yaw_rad = wild(),
          .yaw_rate_rad_s = wild(),
          .type_mask =
              static_cast<std::uint16_t>(random_bits({8, Stream::bench, trial, index}) & 0xdff),
          .coordinate_frame = i % 2 == 0 ? std::uint8_t{1} : std::uint8_t{8}};
      for (float& param : command.param) param = wild();
      if (i % 20 == 10) session.send(command);
      if (i % 50 == 0) session.command(kDoSetMode, 1, 6);  // mostly in OFFBOARD, armed
      if (i % 50 == 1) session.command(kArmDisarm, 1);
      session.send(setpoint);
      for (int tick = 0; tick < 5; ++tick) session.step();  // throws when the state becomes NaN
    }
    EXPECT_TRUE(session.vehicle().state().T_world_body.matrix().allFinite());
    EXPECT_GT(session.endpoint().counts().setpoints, 100U);
  }
}

}  // namespace
}  // namespace gnbv::mavlink
