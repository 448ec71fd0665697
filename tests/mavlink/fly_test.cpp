// `gnbv fly` as its users meet it: what it refuses, how it ends, what it prints.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "sim/mavlink/udp.hpp"

namespace gnbv {
namespace {

struct Outcome {
  int exit_code = -1;
  std::string output;
};

/// `prefix` goes before the program, `redirection` behind its arguments.
Outcome fly(const std::string& arguments, const std::string& redirection = "2>&1",
            const std::string& prefix = "") {
  const std::string command =
      prefix + std::string(GNBV_PROGRAM) + " fly " + arguments + " " + redirection;
  Outcome outcome;
  FILE* const pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) {
    outcome.output += buffer.data();
  }
  const int status = pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

const std::string kFreePort = "smoke --mavlink udp://127.0.0.1:0 ";

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

TEST(Fly, CtrlCIsAnOrdinaryEnd) {
  const Outcome outcome = fly(kFreePort, "2>&1", "timeout --preserve-status -s INT 3 ");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("end: stopped"), std::string::npos) << outcome.output;
}

TEST(Fly, TouchingTheStructureIsAFailureThatSaysWhere) {
  // the tower's wall stands at x = 0.04: the start is above it, the ground below is in it
  const Outcome outcome = fly(
      kFreePort + "--duration 5 --set start='{position_m: [0.04, 0.12, 4], jitter_m: [0, 0, 0]}'");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_NE(outcome.output.find("hit the structure at [0.0"), std::string::npos) << outcome.output;
}

TEST(Fly, WhatCannotBeServedIsBadInput) {
  const mavlink::UdpSocket taken({0x7f000001, 0});
  for (const std::string& arguments :
       {"smoke --mavlink " + mavlink::url_of(taken.address()),
        std::string("smoke --mavlink tcp://127.0.0.1:14540"),
        std::string("smoke --mavlink udp://127.0.0.1"),
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
