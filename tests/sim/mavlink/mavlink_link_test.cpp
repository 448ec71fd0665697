// Who is heard.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/mavlink/link.hpp"
#include "sim/mavlink/udp.hpp"
#include "tests/support/fault.hpp"

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
  ears.link.count_oversized_datagram();
  EXPECT_EQ(ears.link.counts().datagrams, 8U) << "every one is accounted for";
  EXPECT_EQ(ears.link.counts().accepted, 3U);
  EXPECT_EQ(ears.link.counts().foreign_datagrams, 3U);
  EXPECT_EQ(ears.link.counts().oversized_datagrams, 1U);
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
  EXPECT_FALSE(ears.hears_command(86.9, kOther)) << "a new client has five seconds to ask";
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

// The socket: where it binds, what it refuses, and what it says about a datagram.

constexpr std::uint32_t kLoopback = 0x7f000001;

TEST(MavlinkUdp, AUrlNamesAnAddressAndWhoSpeaksFirst) {
  struct Case {
    const char* url;
    Address address, bound;
  };
  constexpr Address kHere = {kLoopback, 14540};
  for (const auto& [url, address, bound] :
       std::vector<Case>{{"udp://127.0.0.1:14540", kHere, kHere},
                         {"udpin://127.0.0.1:14540", kHere, kHere},
                         {"udp://0.0.0.0:0", {0, 0}, {0, 0}},
                         {"udp://localhost:65535", {kLoopback, 65535}, {kLoopback, 65535}},
                         {"udp://:14540", kHere, kHere},  // never all interfaces
                         {"udpout://127.0.0.1:14540", kHere, {kLoopback, 0}},
                         {"udpout://192.168.0.7:1", {0xc0a80007, 1}, {0, 0}}}) {
    const Meeting meeting = resolve_meeting(url);
    EXPECT_EQ(meeting.address, address) << url;
    EXPECT_EQ(meeting.speaks_first, std::string_view(url).starts_with("udpout")) << url;
    EXPECT_EQ(bound_for(meeting), bound) << url;
  }
  EXPECT_EQ(url_of({0xc0a80102, 14540}), "udp://192.168.1.2:14540");
  EXPECT_TRUE(is_loopback({0x7f030201, 1}));
  EXPECT_FALSE(is_loopback({0, 1}));
  EXPECT_FALSE(is_loopback({0xc0a80007, 1}));
}

TEST(MavlinkUdp, EveryOtherUrlIsBadInputThatNamesIt) {
  for (const std::string url :
       {"", "udp", "udp://", "udp://127.0.0.1", "tcp://127.0.0.1:1", "127.0.0.1:14540",
        "udp://127.0.0.1:", "udp://127.0.0.1:65536", "udp://127.0.0.1:-1", "udp://127.0.0.1:14 540",
        "udp://127.0.0.1:14540/", "udp://256.0.0.1:14540", "udp://[::1]:14540",
        "udpout://127.0.0.1:99999", "udpout://127.0.0.1:0", "udpout://0.0.0.0:14540", "udpout://",
        "udpin://127.0.0.1", "udpboth://127.0.0.1:7"}) {
    EXPECT_TRUE(test::says(test::fault_of([&] { resolve_meeting(url); }), {url, ": "})) << url;
  }
  EXPECT_TRUE(test::says(test::fault_of([] { resolve_meeting("udpin://nowhere"); }),
                         {"udpin://HOST:PORT"}));
}

TEST(MavlinkUdp, APortInUseIsBadInput) {
  const UdpSocket first({kLoopback, 0});
  EXPECT_NE(first.address().port, 0);
  EXPECT_EQ(first.address().host, kLoopback);
  EXPECT_THROW(UdpSocket{first.address()}, BadInput);
  EXPECT_THROW((UdpSocket{{0x08080808, 14540}}), BadInput) << "an address of another machine";
}

TEST(MavlinkUdp, DatagramsArriveWholeWithTheirSender) {
  UdpSocket here({kLoopback, 0});
  const UdpSocket there({kLoopback, 0});
  EXPECT_FALSE(here.receive().has_value());
  for (const std::size_t size : {0U, 1U, 280U, 2048U, 2049U, 60000U}) {
    const std::vector<std::uint8_t> sent(size, 7);
    ASSERT_TRUE(there.send(sent, here.address()));
    here.wait(5.0);
    const auto datagram = here.receive();
    ASSERT_TRUE(datagram.has_value()) << size;
    EXPECT_EQ(datagram->from, there.address());
    EXPECT_EQ(datagram->is_oversized, size > 2048) << size;
    EXPECT_EQ(datagram->bytes.size(), std::min<std::size_t>(size, 2048));
    EXPECT_TRUE(std::ranges::all_of(datagram->bytes, [](std::uint8_t b) { return b == 7; }));
  }
  EXPECT_FALSE(here.receive().has_value());
}

}  // namespace
}  // namespace gnbv::mavlink
