// Who is heard, and that nothing is heard twice.
#include <gtest/gtest.h>

#include <ostream>

#include "sim/mavlink/link.hpp"

namespace gnbv::mavlink {
namespace {

constexpr Address kClient = {0x7f000001, 40001};
constexpr Address kOther = {0x7f000001, 40002};

std::vector<std::uint8_t> heartbeat(unsigned sequence, std::uint8_t component_id = 190) {
  return write_frame({static_cast<std::uint8_t>(sequence), 255, component_id, Heartbeat::kInfo.id,
                      payload_of(Heartbeat{})});
}

bool is_heard(Link& link, unsigned sequence, double now_s, const Address& from = kClient) {
  return !link.receive(heartbeat(sequence), from, now_s).empty();
}

TEST(MavlinkLink, ASteadyStreamPassesThroughEveryWrapAround) {
  Link link;
  for (unsigned i = 0; i < 2000; ++i) ASSERT_TRUE(is_heard(link, i, 0.01 * i));
  EXPECT_EQ(link.counts().accepted, 2000U);
  EXPECT_EQ(link.counts().replayed, 0U);
}

TEST(MavlinkLink, EveryFrameOfTheWindowIsRefusedASecondTime) {
  Link link;
  for (unsigned i = 0; i < 500; ++i) is_heard(link, i, 0.0);
  for (unsigned back = 1; back <= ReplayFilter::kWindow; ++back) {
    EXPECT_FALSE(is_heard(link, 500 - back, 0.0)) << back;
  }
  EXPECT_EQ(link.counts().replayed, ReplayFilter::kWindow);
  EXPECT_TRUE(is_heard(link, 500, 0.0)) << "the stream itself goes on";
}

TEST(MavlinkLink, EverySecondFrameMayBeLost) {
  Link link;
  for (unsigned i = 0; i < 4000; i += 2) ASSERT_TRUE(is_heard(link, i, 0.0)) << i;
}

TEST(MavlinkLink, ReorderedFramesAreHeardOnce) {
  Link link;
  for (const unsigned sequence : {10U, 12U, 11U}) EXPECT_TRUE(is_heard(link, sequence, 0.0));
  EXPECT_FALSE(is_heard(link, 11, 0.0));
}

TEST(MavlinkLink, ARestartedClientIsHeardAfterASecond) {
  Link link;
  for (unsigned i = 0; i < 20; ++i) is_heard(link, i, 0.0);
  EXPECT_FALSE(is_heard(link, 0, 0.5));
  EXPECT_FALSE(is_heard(link, 1, 1.0)) << "what is dropped does not prolong the silence";
  EXPECT_TRUE(is_heard(link, 2, 1.01));
}

TEST(MavlinkLink, ComponentsCountTheirFramesApart) {
  Link link;
  for (unsigned component = 0; component < 200; ++component) {
    const auto id = static_cast<std::uint8_t>(component);
    EXPECT_EQ(link.receive(heartbeat(5, id), kClient, 0.0).size(), 1U);
    EXPECT_EQ(link.receive(heartbeat(5, id), kClient, 0.0).size(), 0U);
  }
}

TEST(MavlinkLink, OnlyTheClientIsHeardUntilItFallsSilent) {
  Link link;
  EXPECT_EQ(link.client(), std::nullopt);
  const std::vector<std::uint8_t> garbage = {0xfd, 1, 2, 3};
  EXPECT_TRUE(link.receive(garbage, kOther, 0.0).empty());
  EXPECT_EQ(link.client(), std::nullopt) << "garbage makes no client";
  EXPECT_TRUE(is_heard(link, 0, 0.0));
  EXPECT_EQ(link.client(), kClient);
  EXPECT_FALSE(is_heard(link, 0, 4.0, kOther));
  EXPECT_EQ(link.counts().foreign_datagrams, 1U);
  EXPECT_TRUE(is_heard(link, 1, 4.0));
  EXPECT_FALSE(is_heard(link, 1, 8.9, kOther));
  EXPECT_TRUE(link.receive(garbage, kClient, 8.9).empty()) << "garbage is no sign of life";
  EXPECT_TRUE(is_heard(link, 1, 9.1, kOther));
  EXPECT_EQ(link.client(), kOther);
  EXPECT_FALSE(is_heard(link, 2, 9.2));
}

TEST(MavlinkLink, TheNextClientStartsWithACleanSheet) {
  Link link;
  is_heard(link, 7, 0.0);
  EXPECT_TRUE(is_heard(link, 7, 6.0, kOther));
}

TEST(MavlinkLink, EveryDatagramIsAccountedFor) {
  Link link;
  is_heard(link, 0, 0.0);
  is_heard(link, 0, 0.0);
  is_heard(link, 0, 0.0, kOther);
  link.count_oversized_datagram();
  EXPECT_EQ(link.counts().datagrams, 4U);
  EXPECT_EQ(link.counts().accepted, 1U);
  EXPECT_EQ(link.counts().replayed, 1U);
  EXPECT_EQ(link.counts().foreign_datagrams, 1U);
  EXPECT_EQ(link.counts().oversized_datagrams, 1U);
}

}  // namespace
}  // namespace gnbv::mavlink
