// The socket: where it binds, what it refuses, and what it says about a datagram.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/mavlink/udp.hpp"

namespace gnbv::mavlink {
namespace {

constexpr std::uint32_t kLoopback = 0x7f000001;

TEST(MavlinkUdp, AUrlNamesAnAddress) {
  EXPECT_EQ(resolve_meeting("udp://127.0.0.1:14540").address, (Address{kLoopback, 14540}));
  EXPECT_EQ(resolve_meeting("udp://0.0.0.0:0").address, (Address{0, 0}));
  EXPECT_EQ(resolve_meeting("udp://localhost:65535").address, (Address{kLoopback, 65535}));
  EXPECT_EQ(resolve_meeting("udp://:14540").address, (Address{kLoopback, 14540}))
      << "never all interfaces";
  EXPECT_EQ(url_of({0xc0a80102, 14540}), "udp://192.168.1.2:14540");
}

TEST(MavlinkUdp, EveryOtherUrlIsBadInputThatNamesIt) {
  for (const std::string url :
       {"", "udp", "udp://", "udp://127.0.0.1", "tcp://127.0.0.1:1", "127.0.0.1:14540",
        "udp://127.0.0.1:", "udp://127.0.0.1:65536", "udp://127.0.0.1:-1", "udp://127.0.0.1:14 540",
        "udp://127.0.0.1:14540/", "udp://256.0.0.1:14540", "udp://[::1]:14540"}) {
    try {
      resolve_meeting(url);
      ADD_FAILURE() << url;
    } catch (const BadInput& error) {
      EXPECT_NE(std::string(error.what()).find(url), std::string::npos) << error.what();
    }
  }
}

TEST(MavlinkUdp, AMeetingsErrorNamesTheUrlAsItWasWritten) {
  for (const auto& [url, words] :
       {std::pair{"udpout://127.0.0.1:99999", "udpout://127.0.0.1:99999"},
        std::pair{"udpin://nowhere", "udpin://HOST:PORT"},
        std::pair{"tcp://127.0.0.1:1", "udpout://HOST:PORT"}}) {
    try {
      resolve_meeting(url);
      ADD_FAILURE() << url;
    } catch (const BadInput& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(url), std::string::npos) << error.what();
    }
  }
}

TEST(MavlinkUdp, TheSchemeSaysWhoSpeaksFirst) {
  const Meeting out = resolve_meeting("udpout://127.0.0.1:14540");
  EXPECT_TRUE(out.speaks_first);
  EXPECT_EQ(out.address, (Address{kLoopback, 14540}));
  EXPECT_EQ(bound_for(out), (Address{kLoopback, 0})) << "never all interfaces";
  EXPECT_EQ(bound_for(resolve_meeting("udpout://192.168.0.7:1")), (Address{0, 0}));
  for (const std::string url : {"udp://127.0.0.1:7", "udpin://127.0.0.1:7"}) {
    const Meeting in = resolve_meeting(url);
    EXPECT_FALSE(in.speaks_first);
    EXPECT_EQ(bound_for(in), (Address{kLoopback, 7}));
  }
  for (const std::string url : {"udpout://127.0.0.1:0", "udpout://0.0.0.0:14540", "udpout://",
                                "udpin://127.0.0.1", "udpboth://127.0.0.1:7"}) {
    EXPECT_THROW(resolve_meeting(url), BadInput) << url;
  }
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

TEST(MavlinkUdp, AClientThatIsGoneDoesNoHarm) {
  UdpSocket here({kLoopback, 0});
  const Address gone = UdpSocket({kLoopback, 0}).address();
  for (int i = 0; i < 3; ++i) {
    here.send(std::vector<std::uint8_t>(3, 1), gone);
    here.wait(0.001);
    EXPECT_FALSE(here.receive().has_value());
  }
}

TEST(MavlinkUdp, TheLoopbackIsThisMachineAlone) {
  EXPECT_TRUE(is_loopback(resolve_meeting("udp://127.0.0.1:1").address));
  EXPECT_TRUE(is_loopback(resolve_meeting("udp://127.3.2.1:1").address));
  EXPECT_FALSE(is_loopback(resolve_meeting("udp://0.0.0.0:1").address));
  EXPECT_FALSE(is_loopback(resolve_meeting("udp://192.168.0.7:1").address));
}

}  // namespace
}  // namespace gnbv::mavlink
