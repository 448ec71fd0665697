// Frames against bytes that an independent implementation wrote: node-mavlink 2.3.0, sender
// 255/190.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <string_view>

#include "sim/mavlink/messages.hpp"

namespace gnbv::mavlink {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes from_hex(std::string_view hex) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(
        static_cast<std::uint8_t>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16)));
  }
  return bytes;
}

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

template <typename Message>
Bytes bytes_of(const Message& message, std::uint8_t sequence) {
  return write_frame({sequence, 255, 190, Message::kInfo.id, payload_of(message)});
}

const std::string_view kHeartbeat = "fd09000007ffbe0000000000060006088104031ad6";
const std::string_view kSetpoint =
    "fd350000ffffbe540000e80300000000803f00000040000040c00000003f000000bf0000803e000080400000a04000"
    "00"
    "c0400000a03f000040bff809010101d872";
const std::string_view kCommandVersion1 =
    "fe210bffbe4c0000803f0098a546000000000000000000000000000000000000c07f90010101001c43";

const SetPositionTargetLocalNed kSetpointMessage = {.time_boot_ms = 1000,
                                                    .p_m = {1.0F, 2.0F, -3.0F},
                                                    .v_m_s = {0.5F, -0.5F, 0.25F},
                                                    .a_m_s2 = {4.0F, 5.0F, 6.0F},
                                                    .yaw_rad = 1.25F,
                                                    .yaw_rate_rad_s = -0.75F,
                                                    .type_mask = 2552,
                                                    .target_system = 1,
                                                    .target_component = 1,
                                                    .coordinate_frame = 1};

std::uint64_t dropped(const ReadCounts& c) {
  return c.bad_crc + c.truncated + c.oversized + c.unknown;
}

TEST(MavlinkFrame, EveryMessageIsWrittenAsTheIndependentImplementationWritesIt) {
  const Heartbeat heartbeat = {
      .custom_mode = 6U << 16, .type = 6, .autopilot = 8, .base_mode = 129, .system_status = 4};
  EXPECT_EQ(bytes_of(heartbeat, 7), from_hex(kHeartbeat));
  EXPECT_EQ(bytes_of(SetMode{.custom_mode = 6U << 16, .target_system = 1, .base_mode = 1}, 8),
            from_hex("fd06000008ffbe0b000000000600010140ec"));
  EXPECT_EQ(
      bytes_of(Attitude{.time_boot_ms = 123456,
                        .roll_pitch_yaw_rad = {0.25F, -0.5F, 1.5F},
                        .omega_frd_rad_s = {0.125F, -2.0F, 3.0F}},
               9),
      from_hex("fd1c000009ffbe1e000040e201000000803e000000bf0000c03f0000003e000000c00000404003"
               "d6"));
  EXPECT_EQ(bytes_of(LocalPositionNed{.time_boot_ms = 123456,
                                      .p_ned_m = {1.5F, -2.25F, -3.0F},
                                      .v_ned_m_s = {0.5F, 0.0F, 0.0F}},
                     10),
            from_hex("fd1400000affbe20000040e201000000c03f000010c0000040c00000003f0b51"));
  EXPECT_EQ(bytes_of(CommandLong{.param = {1, 21196, 0, 0, 0, 0, std::nanf("")},
                                 .command = 400,
                                 .target_system = 1,
                                 .target_component = 1},
                     11),
            from_hex("fd2000000bffbe4c00000000803f0098a5460000000000000000000000000000000000"
                     "00c07f900101015893"));
  EXPECT_EQ(bytes_of(CommandAck{.command = 400,
                                .result = 1,
                                .result_param2 = -5,
                                .target_system = 255,
                                .target_component = 190},
                     12),
            from_hex("fd0a00000cffbe4d000090010100fbffffffffbe56b7"));
  EXPECT_EQ(bytes_of(kSetpointMessage, 255), from_hex(kSetpoint));
  EXPECT_EQ(
      bytes_of(BatteryStatus{.energy_consumed_hj = 321, .type = 1, .remaining_percent = 84}, 13),
      from_hex(
          "fd2400000dffbe930000ffffffff41010000ff7fffffffffffffffffffffffffffffffffffffffffffff0000"
          "0154a20f"));
  EXPECT_EQ(bytes_of(ExtendedSysState{.landed_state = 2}, 14),
            from_hex("fd0200000effbef5000000029e22"));
  EXPECT_EQ(bytes_of(StatusText{.severity = 4, .text = {'a', 'r', 'm', 'e', 'd'}}, 15),
            from_hex("fd0600000fffbefd00000461726d65644485"));
}

TEST(MavlinkFrame, WhatWasWrittenIsReadBack) {
  ReadCounts counts;
  const std::vector<Frame> frames = read_frames(from_hex(kSetpoint), counts);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].sequence, 255);
  EXPECT_EQ(frames[0].system_id, 255);
  EXPECT_EQ(frames[0].component_id, 190);
  ASSERT_EQ(frames[0].message_id, SetPositionTargetLocalNed::kInfo.id);
  const auto message = message_of<SetPositionTargetLocalNed>(frames[0].payload);
  EXPECT_EQ(payload_of(message), payload_of(kSetpointMessage));
}

TEST(MavlinkFrame, TrailingZerosComeBack) {
  for (const SetMode& sent : {SetMode{}, SetMode{.custom_mode = 3}, SetMode{.target_system = 9}}) {
    const Bytes bytes = bytes_of(sent, 1);
    EXPECT_LT(bytes.size(), 10U + SetMode::kInfo.size + 2U);
    ReadCounts counts;
    const std::vector<Frame> frames = read_frames(bytes, counts);
    ASSERT_EQ(frames.size(), 1U);
    const auto read = message_of<SetMode>(frames[0].payload);
    EXPECT_EQ(payload_of(read), payload_of(sent));
  }
}

TEST(MavlinkFrame, Version1AndSignedFramesAreRead) {
  const std::string_view signed_setpoint =
      "fd350100ffffbe540000e80300000000803f00000040000040c00000003f000000bf0000803e000080400000a040"
      "0000"
      "c0400000a03f000040bff809010101480d0100e06f9e7519273f6f5f32fd";
  ReadCounts counts;
  const auto frames = read_frames(
      from_hex(kCommandVersion1) + from_hex(signed_setpoint) + from_hex(kHeartbeat), counts);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(message_of<CommandLong>(frames[0].payload).command, 400);
  EXPECT_EQ(message_of<CommandLong>(frames[0].payload).param[1], 21196.0F);
  EXPECT_EQ(message_of<SetPositionTargetLocalNed>(frames[1].payload).type_mask, 2552);
  EXPECT_EQ(message_of<Heartbeat>(frames[2].payload).base_mode, 129);
  EXPECT_EQ(dropped(counts), 0U);
}

TEST(MavlinkFrame, EveryFlippedBitIsNoticed) {
  const Bytes good = from_hex(kHeartbeat);
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    Bytes bad = good;
    bad[bit / 8] = static_cast<std::uint8_t>(bad[bit / 8] ^ (1U << (bit % 8)));
    ReadCounts counts;
    // the signed flag (bit 0 of byte 2) only announces a signature, which then is missing
    EXPECT_TRUE(read_frames(bad, counts).empty()) << "bit " << bit;
    // a start byte that is none leaves nothing to count
    EXPECT_TRUE(dropped(counts) > 0U || bit < 8) << "bit " << bit;
  }
}

TEST(MavlinkFrame, EveryPrefixIsTruncated) {
  const Bytes good = from_hex(kHeartbeat);
  for (std::size_t size = 1; size < good.size(); ++size) {
    ReadCounts counts;
    EXPECT_TRUE(read_frames(std::span(good).first(size), counts).empty());
    EXPECT_EQ(counts.truncated, 1U) << size;
    EXPECT_EQ(dropped(counts), 1U) << size;
  }
}

/// A heartbeat whose payload has another size than it should, with the CRC that makes it good.
Bytes heartbeat_of_size(bool version_1, std::size_t payload_size) {
  const auto size = static_cast<std::uint8_t>(payload_size);
  Bytes bytes =
      version_1 ? Bytes{0xfe, size, 1, 255, 190, 0} : Bytes{0xfd, size, 0, 0, 1, 255, 190, 0, 0, 0};
  bytes.resize(bytes.size() + payload_size, 1);
  const std::uint16_t crc = frame_crc(std::span(bytes).subspan(1), Heartbeat::kInfo.crc_extra);
  return bytes + Bytes{static_cast<std::uint8_t>(crc), static_cast<std::uint8_t>(crc >> 8)};
}

TEST(MavlinkFrame, FieldsOfALaterDayAreLeftOff) {
  for (const std::size_t size : {10U, 100U, 255U}) {
    ReadCounts counts;
    const auto frames = read_frames(heartbeat_of_size(false, size), counts);
    ASSERT_EQ(frames.size(), 1U) << size;
    EXPECT_EQ(frames[0].payload, Bytes(Heartbeat::kInfo.size, 1));
    EXPECT_EQ(dropped(counts), 0U);
  }
}

TEST(MavlinkFrame, OnlyVersion2MayHaveMore) {
  for (const std::size_t size : {10U, 100U, 255U}) {
    ReadCounts counts;
    EXPECT_TRUE(read_frames(heartbeat_of_size(true, size), counts).empty());
    EXPECT_EQ(counts.oversized, 1U);
    EXPECT_EQ(dropped(counts), 1U);
  }
}

TEST(MavlinkFrame, OnlyVersion2MayLeaveFieldsOff) {
  ReadCounts counts;
  EXPECT_EQ(read_frames(heartbeat_of_size(false, 5), counts).size(), 1U);
  EXPECT_EQ(dropped(counts), 0U);
  EXPECT_TRUE(read_frames(heartbeat_of_size(true, 5), counts).empty());
  EXPECT_EQ(counts.truncated, 1U);
}

TEST(MavlinkFrame, UnknownMessagesAndFlagsAreCountedAndPassedOver) {
  Bytes unknown_message = from_hex(kSetpoint);
  unknown_message[8] = 0xfd;  // no message of ours; its payload looks like a start as well
  unknown_message[20] = 0xfd;
  Bytes unknown_flag = from_hex(kHeartbeat);
  unknown_flag[2] = 0x02;
  ReadCounts counts;
  EXPECT_EQ(read_frames(unknown_message + unknown_flag + from_hex(kHeartbeat), counts).size(), 1U);
  EXPECT_EQ(counts.unknown, 2U);
  EXPECT_EQ(dropped(counts), 2U);
}

TEST(MavlinkFrame, AGoodFrameIsFoundBehindAnyGarbage) {
  Bytes bad_crc = from_hex(kHeartbeat);
  bad_crc.back() ^= 1;
  Bytes too_long = from_hex(kHeartbeat);
  too_long[1] = 0xff;
  for (const Bytes& garbage :
       {Bytes{}, Bytes{0}, Bytes{0xfd}, Bytes{0xfe, 0xfd, 0xff}, Bytes(300, 0xfd), Bytes(300, 7),
        bad_crc, too_long, from_hex(kSetpoint.substr(0, 60))}) {
    ReadCounts counts;
    const auto frames = read_frames(garbage + from_hex(kHeartbeat) + Bytes(40, 0), counts);
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_EQ(frames[0].sequence, 7);
  }
}

TEST(MavlinkFrame, TheTableGivesWhatBitByBitGives) {
  Bytes bytes;
  for (int i = 0; i < 300; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(i * 37 + i / 7));
    std::uint16_t crc = 0xffff;
    for (std::size_t k = 0; k <= bytes.size(); ++k) {
      const unsigned byte = k < bytes.size() ? bytes[k] : 152U;
      crc = static_cast<std::uint16_t>(crc ^ byte);
      for (int bit = 0; bit < 8; ++bit) {
        crc = static_cast<std::uint16_t>((crc >> 1) ^ ((crc & 1) != 0 ? 0x8408 : 0));
      }
    }
    ASSERT_EQ(frame_crc(bytes, 152), crc) << i;
  }
}

TEST(MavlinkFrame, OfAWrongLengthNoCrcIsComputed) {
  // every sixth byte begins a command of 255 bytes, 222 more than one has
  const Bytes pattern = from_hex("feff0101014c");
  Bytes flood;
  while (flood.size() < 2046) flood.insert(flood.end(), pattern.begin(), pattern.end());
  ReadCounts counts;
  EXPECT_TRUE(read_frames(flood, counts).empty());
  EXPECT_EQ(counts.bad_crc, 0U);
  EXPECT_GT(counts.oversized, 200U);
}

}  // namespace
}  // namespace gnbv::mavlink
