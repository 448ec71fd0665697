// Who is heard.
#include <gtest/gtest.h>

#include <ostream>

#include "sim/mavlink/link.hpp"

namespace gnbv::mavlink {
namespace {

constexpr Address kClient = {0x7f000001, 40001};
constexpr Address kOther = {0x7f000001, 40002};

template <typename Message>
std::vector<std::uint8_t> bytes_of(const Message& message, unsigned sequence = 0) {
  return write_frame(
      {static_cast<std::uint8_t>(sequence), 255, 190, Message::kInfo.id, payload_of(message)});
}

const std::vector<std::uint8_t> kGarbage = {0xfd, 1, 2, 3};

/// A link on the ground unless it is armed.
struct Ears {
  bool hears(const std::vector<std::uint8_t>& datagram, double now_s,
             const Address& from = kClient) {
    return !link.receive(datagram, from, now_s, is_armed).empty();
  }
  bool hears_heartbeat(double now_s, const Address& from = kClient) {
    return hears(bytes_of(Heartbeat{}), now_s, from);
  }
  bool hears_command(double now_s, const Address& from = kClient) {
    return hears(bytes_of(CommandLong{.command = 400, .target_system = 1}), now_s, from);
  }
  Link link;
  bool is_armed = false;
};

TEST(MavlinkLink, AStreamIsHeardWhateverItsSequenceNumbers) {
  for (const unsigned stride : {0U, 1U, 2U, 255U}) {
    Ears ears;
    for (unsigned i = 0; i < 2000; ++i) {
      ASSERT_TRUE(ears.hears(bytes_of(Heartbeat{}, stride * i), 0.01 * i)) << stride;
    }
    EXPECT_EQ(ears.link.counts().accepted, 2000U);
  }
}

TEST(MavlinkLink, GarbageMakesNoClient) {
  Ears ears;
  EXPECT_FALSE(ears.hears(kGarbage, 0.0, kOther));
  EXPECT_EQ(ears.link.client(), std::nullopt);
  EXPECT_TRUE(ears.hears_heartbeat(0.0));
  EXPECT_EQ(ears.link.client(), kClient);
}

TEST(MavlinkLink, OnlyTheClientIsHeardUntilItFallsSilent) {
  Ears ears;
  EXPECT_TRUE(ears.hears_heartbeat(0.0));
  EXPECT_FALSE(ears.hears_heartbeat(4.0, kOther));
  EXPECT_EQ(ears.link.counts().foreign_datagrams, 1U);
  EXPECT_TRUE(ears.hears_heartbeat(4.0));
  EXPECT_FALSE(ears.hears_heartbeat(8.9, kOther));
  EXPECT_FALSE(ears.hears(kGarbage, 8.9)) << "garbage is no sign of life";
  EXPECT_TRUE(ears.hears_heartbeat(9.1, kOther));
  EXPECT_EQ(ears.link.client(), kOther);
  EXPECT_FALSE(ears.hears_heartbeat(9.2));
}

TEST(MavlinkLink, AnIdleClientKeepsItsPlaceUntilAnotherAsksForSomething) {
  Ears ears;
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(ears.hears_heartbeat(4.0 * i));
  EXPECT_FALSE(ears.hears_heartbeat(77.0, kOther)) << "another idler is no better";
  EXPECT_FALSE(ears.hears(bytes_of(CommandLong{.command = 400, .target_system = 9}), 77.0, kOther))
      << "nor one that asks somebody else";
  EXPECT_TRUE(ears.hears_command(77.0, kOther));
  EXPECT_EQ(ears.link.client(), kOther);
  EXPECT_FALSE(ears.hears_command(78.0)) << "who asks keeps it";
  EXPECT_FALSE(ears.hears_command(81.9));
  EXPECT_FALSE(ears.hears_heartbeat(81.9));
  EXPECT_TRUE(ears.hears_command(82.1)) << "as long as it goes on asking";
}

TEST(MavlinkLink, ANewClientHasFiveSecondsToAsk) {
  Ears ears;
  EXPECT_TRUE(ears.hears_heartbeat(0.0));
  EXPECT_FALSE(ears.hears_command(4.9, kOther));
  EXPECT_TRUE(ears.hears_command(4.9));
  EXPECT_FALSE(ears.hears_command(9.8, kOther));
}

TEST(MavlinkLink, NobodyTakesOverAVehicleInFlight) {
  Ears ears;
  EXPECT_TRUE(ears.hears_command(0.0));
  ears.is_armed = true;
  EXPECT_FALSE(ears.hears_command(1000.0, kOther));
  EXPECT_TRUE(ears.hears_command(1000.0));
  ears.is_armed = false;
  EXPECT_FALSE(ears.hears_command(1004.0, kOther));
  EXPECT_TRUE(ears.hears_command(1006.0, kOther));
}

TEST(MavlinkLink, WhoIsSpokenToFirstKeepsThePlaceForGood) {
  Ears ears{.link = Link(kClient)};
  EXPECT_EQ(ears.link.client(), kClient);
  for (const double now_s : {0.0, 100.0}) {
    EXPECT_FALSE(ears.hears_command(now_s, kOther)) << "however long the partner is silent";
    EXPECT_TRUE(ears.hears_heartbeat(now_s));
  }
  EXPECT_EQ(ears.link.client(), kClient);
  EXPECT_EQ(ears.link.counts().foreign_datagrams, 2U);
}

TEST(MavlinkLink, EveryDatagramIsAccountedFor) {
  Ears ears;
  ears.hears_heartbeat(0.0);
  ears.hears_heartbeat(0.0);
  ears.hears_heartbeat(0.0, kOther);
  ears.link.count_oversized_datagram();
  EXPECT_EQ(ears.link.counts().datagrams, 4U);
  EXPECT_EQ(ears.link.counts().accepted, 2U);
  EXPECT_EQ(ears.link.counts().foreign_datagrams, 1U);
  EXPECT_EQ(ears.link.counts().oversized_datagrams, 1U);
}

}  // namespace
}  // namespace gnbv::mavlink
