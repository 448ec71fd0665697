// The messages of questions and state against bytes that pymavlink 2.4.50 packed, sender 255/190.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <string_view>

#include "sim/mavlink/messages.hpp"

namespace gnbv::mavlink {
namespace {

std::string hex_of(const std::vector<std::uint8_t>& bytes) {
  std::string hex;
  for (const std::uint8_t byte : bytes) {
    for (const int digit : {byte >> 4, byte & 15}) hex += "0123456789abcdef"[digit];
  }
  return hex;
}

template <typename Message>
std::string hex_of(const Message& message, std::uint8_t sequence) {
  return hex_of(write_frame({sequence, 255, 190, Message::kInfo.id, payload_of(message)}));
}

ParameterId id_of(std::string_view name) {
  ParameterId id{};
  std::ranges::copy(name, id.begin());
  return id;
}

template <std::size_t N>
std::array<std::uint8_t, N> filled(std::uint8_t value) {
  std::array<std::uint8_t, N> all{};
  all.fill(value);
  return all;
}

TEST(MavlinkMessages, ParametersAreWrittenAsPymavlinkWritesThem) {
  EXPECT_EQ(hex_of(ParamRequestRead{-1, 1, 1, id_of("MIS_TAKEOFF_ALT")}, 2),
            "fd13000002ffbe140000ffff01014d49535f54414b454f46465f414c54a1a5");
  EXPECT_EQ(hex_of(ParamRequestList{1, 1}, 3), "fd02000003ffbe15000001018f16");
  EXPECT_EQ(hex_of(ParamValue{5.5F, 24, 17, id_of("MPC_XY_CRUISE"), 9}, 4),
            "fd19000004ffbe1600000000b040180011004d50435f58595f435255495345000000099388");
  EXPECT_EQ(hex_of(ParamSet{12.5F, 1, 1, id_of("RTL_RETURN_ALT"), 9}, 5),
            "fd17000005ffbe17000000004841010152544c5f52455455524e5f414c540000090a0c");
}

TEST(MavlinkMessages, MissionsAreWrittenAsPymavlinkWritesThem) {
  EXPECT_EQ(hex_of(MissionRequest{7, 1, 1, 2}, 6), "fd05000006ffbe2800000700010102964a");
  EXPECT_EQ(hex_of(MissionRequestInt{7, 1, 1, 2}, 7), "fd05000007ffbe33000007000101028a9b");
  EXPECT_EQ(hex_of(MissionRequestList{1, 1, 1}, 8), "fd03000008ffbe2b00000101010e75");
  EXPECT_EQ(hex_of(MissionCount{300, 1, 1, 1}, 9), "fd05000009ffbe2c00002c010101013efb");
  EXPECT_EQ(hex_of(MissionClearAll{1, 1, 2}, 10), "fd0300000affbe2d00000101028ff6");
  EXPECT_EQ(hex_of(MissionAck{255, 190, 13, 1}, 11), "fd0400000bffbe2f0000ffbe0d010502");
}

TEST(MavlinkMessages, CommandsTimeAndVersionsAreWrittenAsPymavlinkWritesThem) {
  EXPECT_EQ(hex_of(Ping{0x0102030405060708, 9, 1, 2}, 1),
            "fd0e000001ffbe0400000807060504030201090000000102536a");
  EXPECT_EQ(
      hex_of(CommandInt{{1.5F, 2.5F, 3.5F, 4.5F}, -5, 6, 7.5F, 192, 1, 1, 6, 2, 3}, 12),
      "fd2300000cffbe4b00000000c03f000020400000604000009040fbffffff060000000000f040c00001010602038b"
      "3d");
  EXPECT_EQ(hex_of(Timesync{5'000'000'000, -7, 0, 0}, 13),
            "fd1000000dffbe6f000000f2052a01000000f9ffffffffffffff1a21");
  EXPECT_EQ(
      hex_of(AutopilotVersion{.capabilities = 8344,
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
             14),
      "fd3c00000effbe94000098200000000000008877665544332211ff000f010200000003000000040000000500"
      "0600676e62760000000101010101010101010202020202020202391d");
  EXPECT_EQ(hex_of(MessageInterval{20000, 30}, 15), "fd0500000fffbef40000204e00001e1733");
}

TEST(MavlinkMessages, StateIsWrittenAsPymavlinkWritesIt) {
  EXPECT_EQ(
      hex_of(SysStatus{1, 2, 3, 4, 5, -6, 8, 9, {10, 11, 12, 13}, 77}, 16),
      "fd1f000010ffbe01000001000000020000000300000004000500faff080009000a000b000c000d004dfb13");
  EXPECT_EQ(
      hex_of(GpsRawInt{1000, {473977420, 85455940, -1234}, 70, 71, 72, 73, 3, 12, -5}, 17),
      "fd22000011ffbe180000e8030000000000004c52401c44f417052efbffff4600470048004900030cfbffffff"
      "94b4");
  EXPECT_EQ(
      hex_of(AttitudeQuaternion{1000, {1.0F, 0.5F, -0.5F, 0.25F}, {1.5F, 2.5F, 3.5F}}, 18),
      "fd20000012ffbe1f0000e80300000000803f0000003f000000bf0000803e0000c03f0000204000006040e5c9");
  EXPECT_EQ(
      hex_of(GlobalPositionInt{1000, {473977420, 85455940, 1500}, 1400, {-10, 20, -30}, 35999}, 19),
      "fd1c000013ffbe210000e80300004c52401c44f41705dc05000078050000f6ff1400e2ff9f8c9775");
  EXPECT_EQ(hex_of(GpsGlobalOrigin{{473977420, 85455940, -7}}, 20),
            "fd0c000014ffbe3100004c52401c44f41705f9ffffffca0a");
  EXPECT_EQ(hex_of(VfrHud{1.5F, 2.5F, 3.5F, -4.5F, 359, 50}, 21),
            "fd13000015ffbe4a00000000c03f0000204000006040000090c0670132e44f");
  EXPECT_EQ(
      hex_of(HomePosition{{473977420, 85455940, -7},
                          {1.0F, 2.0F, 3.0F},
                          {1.0F, 0.5F, 0.25F, 0.125F},
                          {4.0F, 5.0F, 6.0F}},
             22),
      "fd34000016ffbef200004c52401c44f41705f9ffffff0000803f00000040000040400000803f0000003f0000"
      "803e0000003e000080400000a0400000c0403c5e");
}

std::vector<std::uint8_t> from_hex(std::string_view hex) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(
        static_cast<std::uint8_t>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16)));
  }
  return bytes;
}

TEST(MavlinkMessages, WhomARefusedSetpointIsForIsRead) {
  ReadCounts counts;
  const auto attitude = read_frames(
      from_hex(
          "fd27000017ffbe520000e80300000000803f0000003f0000803e0000003e0000c03f000020400000604000"
          "00403f010207c551"),
      counts);
  ASSERT_EQ(attitude.size(), 1U);
  EXPECT_EQ(message_of<SetAttitudeTarget>(attitude[0].payload).target_system, 1);
  EXPECT_EQ(message_of<SetAttitudeTarget>(attitude[0].payload).target_component, 2);
  const auto global = read_frames(
      from_hex(
          "fd35000018ffbe560000e80300004c52401c44f417050000803f0000004000004040000080400000a04000"
          "00c0400000e0400000004100001041f8090102068309"),
      counts);
  ASSERT_EQ(global.size(), 1U);
  EXPECT_EQ(message_of<SetPositionTargetGlobalInt>(global[0].payload).target_system, 1);
  EXPECT_EQ(message_of<SetPositionTargetGlobalInt>(global[0].payload).target_component, 2);
}

}  // namespace
}  // namespace gnbv::mavlink
