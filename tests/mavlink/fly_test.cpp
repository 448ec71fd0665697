// `gnbv fly` as its users meet it: what it refuses, how it ends, what it prints.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "sim/mavlink/messages.hpp"
#include "sim/mavlink/udp.hpp"

namespace gnbv {
namespace {

struct Outcome {
  int exit_code = -1;
  std::string output;
};

/// `prefix` goes before the program, `redirection` behind its arguments; `on_line` gets each line
/// of the output as it comes.
Outcome fly(
    const std::string& arguments, const std::string& redirection = "2>&1",
    const std::string& prefix = "",
    const std::function<void(const std::string&)>& on_line = [](const std::string&) {}) {
  const std::string command =
      prefix + std::string(GNBV_PROGRAM) + " fly " + arguments + " " + redirection;
  Outcome outcome;
  FILE* const pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) {
    outcome.output += buffer.data();
    on_line(buffer.data());
  }
  const int status = pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

const std::string kFreePort = "smoke --mavlink udp://127.0.0.1:0 ";
const std::string kListening = "gnbv: listening on ";

/// Asks for OFFBOARD, for arming and for the middle of the structure, until it is stopped.
void fly_into_structure(const std::stop_token& stop, const mavlink::Address& vehicle) {
  const mavlink::UdpSocket socket({0x7f000001, 0});
  std::uint8_t sequence = 0;
  const auto send = [&]<typename Message>(const Message& message) {
    socket.send(mavlink::write_frame(
                    {sequence++, 255, 190, Message::kInfo.id, mavlink::payload_of(message)}),
                vehicle);
  };
  while (!stop.stop_requested()) {
    send(mavlink::SetPositionTargetLocalNed{.p_m = {0.0F, 0.0F, -0.7F},
                                            .type_mask = 2552,  // position and yaw
                                            .target_system = 1,
                                            .target_component = 1,
                                            .coordinate_frame = 1});
    send(mavlink::SetMode{.custom_mode = 6U << 16, .target_system = 1, .base_mode = 1});
    send(mavlink::CommandLong{
        .param = {1}, .command = 400, .target_system = 1, .target_component = 1});
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

TEST(Fly, EndsAfterItsDurationWithASummary) {
  const Outcome outcome = fly(kFreePort + "--speed 20 --duration 2 --json", "2>/dev/null");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const auto summary = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(summary.at("end"), "duration");
  EXPECT_EQ(summary.at("flight_time_s"), 2.0);
  EXPECT_GE(summary.at("wall_s"), 0.09) << "not faster than asked for";
  EXPECT_EQ(summary.at("accepted"), 0);
  EXPECT_EQ(summary.at("dropped").at("bad_crc"), 0);
}

TEST(Fly, SaysWhereItListens) {
  const Outcome outcome = fly(kFreePort + "--speed 20 --duration 0.1");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.output.find("gnbv: listening on udp://127.0.0.1:"), 0U) << outcome.output;
  EXPECT_NE(outcome.output.find("end: duration"), std::string::npos) << outcome.output;
}

TEST(Fly, SpeaksFirstToWhereItsClientWaits) {
  mavlink::UdpSocket client({0x7f000001, 0});
  const std::string url = mavlink::url_of(client.address());
  const Outcome outcome = fly("smoke --speed 5 --duration 5 --mavlink udpout" + url.substr(3));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(
      outcome.output.find("gnbv: speaking to udpout" + url.substr(3) + " from udp://127.0.0.1:"),
      0U)
      << outcome.output;
  const auto datagram = client.receive();  // the first of those that wait in the socket
  ASSERT_TRUE(datagram.has_value());
  mavlink::ReadCounts counts;
  const auto frames = mavlink::read_frames(datagram->bytes, counts);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].message_id, mavlink::Heartbeat::kInfo.id);
}

TEST(Fly, CtrlCIsAnOrdinaryEnd) {
  // the shell says its process id and becomes the program
  pid_t process = 0;
  const auto interrupt = [&](const std::string& line) {
    if (process == 0) process = std::stoi(line);
    if (line.starts_with(kListening)) kill(process, SIGINT);
  };
  const Outcome outcome = fly(kFreePort, "2>&1", "echo $$; exec ", interrupt);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("end: stopped"), std::string::npos) << outcome.output;
}

TEST(Fly, TouchingTheStructureIsAFailureThatSaysWhere) {
  std::jthread client;
  const auto connect = [&](const std::string& line) {
    if (!line.starts_with(kListening)) return;
    const std::size_t begin = kListening.size();
    client =
        std::jthread(fly_into_structure,
                     mavlink::resolve_meeting(line.substr(begin, line.find(',') - begin)).address);
  };
  const Outcome outcome = fly(kFreePort + "--speed 2 --duration 60", "2>&1", "", connect);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_NE(outcome.output.find("hit the structure at ["), std::string::npos) << outcome.output;
}

/// Commands in MAVLink 1 that are too long, and positions in MAVLink 2 that are as long as a frame
/// can be, which a newer sender may mean so: a CRC of 265 bytes at every tenth.
const std::vector<std::vector<int>> kLongestToRefuse = {{0xfe, 0xff, 0x4c},
                                                        {0xfd, 0xff, 0, 0, 0, 0, 0, 0x1e, 0, 0}};

/// As many datagrams as one thread can send, each of the bytes that take longest to refuse.
void flood(const std::stop_token& stop, const mavlink::Address& vehicle,
           const std::vector<int>& pattern) {
  const mavlink::UdpSocket socket({0x7f000001, 0});
  std::vector<std::uint8_t> datagram;
  while (datagram.size() < 2038) {
    for (const int byte : pattern) datagram.push_back(static_cast<std::uint8_t>(byte));
  }
  while (!stop.stop_requested()) {
    for (int i = 0; i < 100; ++i) socket.send(datagram, vehicle);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));  // 20 MB/s
  }
}

TEST(Fly, AFloodDoesNotStopTime) {
  for (const std::vector<int>& pattern : kLongestToRefuse) {
    std::jthread attacker;
    const auto attack = [&](const std::string& line) {
      if (!line.starts_with(kListening)) return;
      const std::size_t begin = kListening.size();
      attacker = std::jthread(
          flood, mavlink::resolve_meeting(line.substr(begin, line.find(',') - begin)).address,
          pattern);
    };
    // a vehicle that refuses byte by byte flies a tenth of real time
    const Outcome outcome = fly(kFreePort + "--duration 3 --json", "2>&1", "timeout 30 ", attack);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const auto summary = nlohmann::json::parse(outcome.output.substr(outcome.output.find('{')));
    EXPECT_GT(summary.at("datagrams"), 1000);
  }
}

TEST(Fly, WhoCanBeReachedByOtherMachinesIsTold) {
  const std::string warning = "can be reached from other machines";
  const Outcome open = fly("smoke --mavlink udp://0.0.0.0:0 --speed 20 --duration 0.1");
  EXPECT_EQ(open.exit_code, 0) << open.output;
  EXPECT_NE(open.output.find(warning), std::string::npos) << open.output;
  const Outcome closed = fly(kFreePort + "--speed 20 --duration 0.1");
  EXPECT_EQ(closed.output.find(warning), std::string::npos) << closed.output;
}

TEST(Fly, AStartAboveTheStructureIsBadInput) {
  // the tower's wall stands at x = 0.04: the start is above it, the ground below is in it
  const Outcome outcome = fly(
      kFreePort + "--duration 5 --set start='{position_m: [0.04, 0.12, 4], jitter_m: [0, 0, 0]}'");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_NE(outcome.output.find("start.position_m"), std::string::npos) << outcome.output;
  EXPECT_EQ(outcome.output.find("listening"), std::string::npos) << outcome.output;
}

TEST(Fly, WhatCannotBeServedIsBadInput) {
  const mavlink::UdpSocket taken({0x7f000001, 0});
  for (const std::string& arguments :
       {"smoke --mavlink " + mavlink::url_of(taken.address()),
        std::string("smoke --mavlink tcp://127.0.0.1:14540"),
        std::string("smoke --mavlink udp://127.0.0.1"),
        std::string("smoke --mavlink udpout://127.0.0.1:0"),
        std::string("smoke --mavlink udpout://0.0.0.0:14540"),
        std::string("smoke --mavlink udp://8.8.8.8:14540"),
        std::string("smoke --mavlink udp://no-such-host.invalid:14540"), kFreePort + "--speed 0",
        kFreePort + "--duration 0", kFreePort + "--set vehicle.kind=ideal",
        kFreePort + "--set structure.ground=false", std::string("no-such-scenario")}) {
    const Outcome outcome = fly(arguments, "2>&1", "timeout 60 ");
    EXPECT_EQ(outcome.exit_code, 2) << arguments << ": " << outcome.output;
    EXPECT_EQ(outcome.output.find("listening"), std::string::npos) << arguments;
  }
}

}  // namespace
}  // namespace gnbv
