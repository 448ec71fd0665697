// Frames against bytes that independent implementations wrote: node-mavlink 2.3.0 and pymavlink
// 2.4.50, sender 255/190.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <string_view>

#include "tests/sim/mavlink/mavlink_session.hpp"

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

std::uint64_t dropped(const ReadCounts& c) {
  return c.bad_crc + c.truncated + c.oversized + c.unknown;
}

/// The message is written as these bytes, and read back from them.
template <typename Message>
void expect_bytes(std::uint8_t sequence, const Message& message, std::string_view hex) {
  const Bytes bytes = from_hex(hex);
  const Frame frame{sequence, 255, 190, Message::kInfo.id, payload_of(message)};
  EXPECT_EQ(write_frame(frame), bytes) << Message::kInfo.id;
  ReadCounts counts;
  const std::vector<Frame> frames = read_frames(bytes, counts);
  ASSERT_EQ(frames.size(), 1U) << Message::kInfo.id;
  EXPECT_EQ(dropped(counts), 0U);
  EXPECT_EQ(frames[0].sequence, sequence);
  EXPECT_EQ(frames[0].system_id, 255);
  EXPECT_EQ(frames[0].component_id, 190);
  EXPECT_EQ(frames[0].message_id, Message::kInfo.id);
  EXPECT_EQ(payload_of(message_of<Message>(frames[0].payload)), payload_of(message));
}

template <std::size_t N>
std::array<std::uint8_t, N> filled(std::uint8_t value) {
  std::array<std::uint8_t, N> all{};
  all.fill(value);
  return all;
}

const std::string_view kHeartbeat = "fd09000007ffbe0000000000060006088104031ad6";
const std::string_view kSetpoint =
    "fd350000ffffbe540000e80300000000803f00000040000040c00000003f000000bf0000803e000080400000a04000"
    "00c0400000a03f000040bff809010101d872";

TEST(MavlinkFrame, EveryMessageIsWrittenAsNodeMavlinkWritesIt) {
  expect_bytes(
      7,
      Heartbeat{
          .custom_mode = 6U << 16, .type = 6, .autopilot = 8, .base_mode = 129, .system_status = 4},
      kHeartbeat);
  expect_bytes(8, SetMode{.custom_mode = 6U << 16, .target_system = 1, .base_mode = 1},
               "fd06000008ffbe0b000000000600010140ec");
  expect_bytes(9, Attitude{123456, {0.25F, -0.5F, 1.5F}, {0.125F, -2.0F, 3.0F}},
               "fd1c000009ffbe1e000040e201000000803e000000bf0000c03f0000003e000000c00000404003d6");
  expect_bytes(10, LocalPositionNed{123456, {1.5F, -2.25F, -3.0F}, {0.5F, 0.0F, 0.0F}},
               "fd1400000affbe20000040e201000000c03f000010c0000040c00000003f0b51");
  expect_bytes(
      11,
      CommandLong{.param = {1, 21196, 0, 0, 0, 0, std::nanf("")},
                  .command = 400,
                  .target_system = 1,
                  .target_component = 1},
      "fd2000000bffbe4c00000000803f0098a546000000000000000000000000000000000000c07f90010101"
      "5893");
  expect_bytes(12,
               CommandAck{.command = 400,
                          .result = 1,
                          .result_param2 = -5,
                          .target_system = 255,
                          .target_component = 190},
               "fd0a00000cffbe4d000090010100fbffffffffbe56b7");
  expect_bytes(255,
               SetPositionTargetLocalNed{.time_boot_ms = 1000,
                                         .p_m = {1.0F, 2.0F, -3.0F},
                                         .v_m_s = {0.5F, -0.5F, 0.25F},
                                         .a_m_s2 = {4.0F, 5.0F, 6.0F},
                                         .yaw_rad = 1.25F,
                                         .yaw_rate_rad_s = -0.75F,
                                         .type_mask = 2552,
                                         .target_system = 1,
                                         .target_component = 1,
                                         .coordinate_frame = 1},
               kSetpoint);
  expect_bytes(
      13, BatteryStatus{.energy_consumed_hj = 321, .type = 1, .remaining_percent = 84},
      "fd2400000dffbe930000ffffffff41010000ff7fffffffffffffffffffffffffffffffffffffffffffff"
      "00000154a20f");
  expect_bytes(14, ExtendedSysState{.landed_state = 2}, "fd0200000effbef5000000029e22");
  expect_bytes(15, StatusText{.severity = 4, .text = {'a', 'r', 'm', 'e', 'd'}},
               "fd0600000fffbefd00000461726d65644485");
}

TEST(MavlinkFrame, QuestionsAndStateAreWrittenAsPymavlinkWritesThem) {
  expect_bytes(1, Ping{0x0102030405060708, 9, 1, 2},
               "fd0e000001ffbe0400000807060504030201090000000102536a");
  expect_bytes(2, ParamRequestRead{-1, 1, 1, id_of("MIS_TAKEOFF_ALT")},
               "fd13000002ffbe140000ffff01014d49535f54414b454f46465f414c54a1a5");
  expect_bytes(3, ParamRequestList{1, 1}, "fd02000003ffbe15000001018f16");
  expect_bytes(4, ParamValue{5.5F, 24, 17, id_of("MPC_XY_CRUISE"), 9},
               "fd19000004ffbe1600000000b040180011004d50435f58595f435255495345000000099388");
  expect_bytes(5, ParamSet{12.5F, 1, 1, id_of("RTL_RETURN_ALT"), 9},
               "fd17000005ffbe17000000004841010152544c5f52455455524e5f414c540000090a0c");
  expect_bytes(6, MissionRequest{7, 1, 1, 2}, "fd05000006ffbe2800000700010102964a");
  expect_bytes(7, MissionRequestInt{7, 1, 1, 2}, "fd05000007ffbe33000007000101028a9b");
  expect_bytes(8, MissionRequestList{1, 1, 1}, "fd03000008ffbe2b00000101010e75");
  expect_bytes(9, MissionCount{300, 1, 1, 1}, "fd05000009ffbe2c00002c010101013efb");
  expect_bytes(10, MissionClearAll{1, 1, 2}, "fd0300000affbe2d00000101028ff6");
  expect_bytes(11, MissionAck{255, 190, 13, 1}, "fd0400000bffbe2f0000ffbe0d010502");
  expect_bytes(
      12, CommandInt{{1.5F, 2.5F, 3.5F, 4.5F}, -5, 6, 7.5F, 192, 1, 1, 6, 2, 3},
      "fd2300000cffbe4b00000000c03f000020400000604000009040fbffffff060000000000f040c0000101"
      "0602038b3d");
  expect_bytes(13, Timesync{5'000'000'000, -7, 0, 0},
               "fd1000000dffbe6f000000f2052a01000000f9ffffffffffffff1a21");
  expect_bytes(
      14,
      AutopilotVersion{.capabilities = 8344,
                       .uid = 0x1122334455667788,
                       .flight_sw_version = 0x010f00ff,
                       .middleware_sw_version = 2,
                       .os_sw_version = 3,
                       .board_version = 4,
                       .vendor_id = 5,
                       .product_id = 6,
                       .flight_custom_version = {'g', 'n', 'b', 'v', 0, 0, 0, 1},
                       .middleware_custom_version = filled<8>(1),
                       .os_custom_version = filled<8>(2)},
      "fd3c00000effbe94000098200000000000008877665544332211ff000f01020000000300000004000000"
      "05000600676e62760000000101010101010101010202020202020202391d");
  expect_bytes(15, MessageInterval{20000, 30}, "fd0500000fffbef40000204e00001e1733");
  expect_bytes(
      16, SysStatus{1, 2, 3, 4, 5, -6, 8, 9, {10, 11, 12, 13}, 77},
      "fd1f000010ffbe01000001000000020000000300000004000500faff080009000a000b000c000d004dfb13");
  expect_bytes(
      17, GpsRawInt{1000, {473977420, 85455940, -1234}, 70, 71, 72, 73, 3, 12, -5},
      "fd22000011ffbe180000e8030000000000004c52401c44f417052efbffff4600470048004900030cfbff"
      "ffff94b4");
  expect_bytes(
      18, AttitudeQuaternion{1000, {1.0F, 0.5F, -0.5F, 0.25F}, {1.5F, 2.5F, 3.5F}},
      "fd20000012ffbe1f0000e80300000000803f0000003f000000bf0000803e0000c03f0000204000006040e5c9");
  expect_bytes(19,
               GlobalPositionInt{1000, {473977420, 85455940, 1500}, 1400, {-10, 20, -30}, 35999},
               "fd1c000013ffbe210000e80300004c52401c44f41705dc05000078050000f6ff1400e2ff9f8c9775");
  expect_bytes(20, GpsGlobalOrigin{{473977420, 85455940, -7}},
               "fd0c000014ffbe3100004c52401c44f41705f9ffffffca0a");
  expect_bytes(21, VfrHud{1.5F, 2.5F, 3.5F, -4.5F, 359, 50},
               "fd13000015ffbe4a00000000c03f0000204000006040000090c0670132e44f");
  expect_bytes(
      22,
      HomePosition{{473977420, 85455940, -7},
                   {1.0F, 2.0F, 3.0F},
                   {1.0F, 0.5F, 0.25F, 0.125F},
                   {4.0F, 5.0F, 6.0F}},
      "fd34000016ffbef200004c52401c44f41705f9ffffff0000803f00000040000040400000803f0000003f"
      "0000803e0000003e000080400000a0400000c0403c5e");
}

/// The only frame in these bytes.
Frame only_frame(std::string_view hex) {
  ReadCounts counts;
  const std::vector<Frame> frames = read_frames(from_hex(hex), counts);
  EXPECT_EQ(frames.size(), 1U);
  EXPECT_EQ(dropped(counts), 0U);
  return frames.at(0);
}

TEST(MavlinkFrame, Version1SignedFramesAndWhomARefusedSetpointIsForAreRead) {
  const auto command = message_of<CommandLong>(
      only_frame("fe210bffbe4c0000803f0098a546000000000000000000000000000000000000c07f90010101001c"
                 "43")
          .payload);
  EXPECT_EQ(command.command, 400);
  EXPECT_EQ(command.param[1], 21196.0F);
  const Frame with_signature = only_frame(
      "fd350100ffffbe540000e80300000000803f00000040000040c00000003f000000bf0000803e000080400000a040"
      "0000c0400000a03f000040bff809010101480d0100e06f9e7519273f6f5f32fd");
  EXPECT_EQ(message_of<SetPositionTargetLocalNed>(with_signature.payload).type_mask, 2552);
  const auto attitude = message_of<SetAttitudeTarget>(
      only_frame("fd27000017ffbe520000e80300000000803f0000003f0000803e0000003e0000c03f000020400000"
                 "604000"
                 "00403f010207c551")
          .payload);
  EXPECT_EQ(attitude.target_system, 1);
  EXPECT_EQ(attitude.target_component, 2);
  const auto global = message_of<SetPositionTargetGlobalInt>(
      only_frame("fd35000018ffbe560000e80300004c52401c44f417050000803f0000004000004040000080400000"
                 "a0400000c0400000e0400000004100001041f8090102068309")
          .payload);
  EXPECT_EQ(global.target_system, 1);
  EXPECT_EQ(global.target_component, 2);
}

TEST(MavlinkFrame, EveryFlippedBitIsNoticedAndEveryPrefixIsTruncated) {
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

TEST(MavlinkFrame, OnlyVersion2MayHaveMoreFieldsOrLeaveSomeOff) {
  for (const std::size_t size : {5U, 9U, 10U, 100U, 255U}) {
    ReadCounts counts;
    const auto frames = read_frames(heartbeat_of_size(false, size), counts);
    ASSERT_EQ(frames.size(), 1U) << size;
    EXPECT_EQ(frames[0].payload, Bytes(std::min(size, 9UL), 1) + Bytes(9 - std::min(size, 9UL), 0));
    EXPECT_EQ(dropped(counts), 0U);
    EXPECT_EQ(read_frames(heartbeat_of_size(true, size), counts).size(), size == 9 ? 1U : 0U);
    EXPECT_EQ(counts.truncated, size < 9 ? 1U : 0U);
    EXPECT_EQ(counts.oversized, size > 9 ? 1U : 0U);
  }
  // every sixth byte begins a command of 255 bytes, 222 more than one has: no CRC is computed
  Bytes flood;
  while (flood.size() < 2046) flood = flood + from_hex("feff0101014c");
  ReadCounts counts;
  EXPECT_TRUE(read_frames(flood, counts).empty());
  EXPECT_EQ(counts.bad_crc, 0U);
  EXPECT_GT(counts.oversized, 200U);
}

TEST(MavlinkFrame, AGoodFrameIsFoundBehindAnyGarbageUnknownMessagesAndFlags) {
  Bytes unknown_message = from_hex(kSetpoint);
  unknown_message[8] = 0xfd;  // no message of ours; its payload looks like a start as well
  unknown_message[20] = 0xfd;
  Bytes unknown_flag = from_hex(kHeartbeat);
  unknown_flag[2] = 0x02;
  Bytes bad_crc = from_hex(kHeartbeat);
  bad_crc.back() ^= 1;
  Bytes too_long = from_hex(kHeartbeat);
  too_long[1] = 0xff;
  for (const Bytes& garbage :
       {Bytes{}, Bytes{0}, Bytes{0xfd}, Bytes{0xfe, 0xfd, 0xff}, Bytes(300, 0xfd), Bytes(300, 7),
        bad_crc, too_long, from_hex(kSetpoint.substr(0, 60)), unknown_message, unknown_flag}) {
    ReadCounts counts;
    const auto frames = read_frames(garbage + from_hex(kHeartbeat) + Bytes(40, 0), counts);
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_EQ(frames[0].sequence, 7);
    EXPECT_TRUE(counts.unknown == 1 || (garbage != unknown_message && garbage != unknown_flag));
  }
}

}  // namespace
}  // namespace gnbv::mavlink
