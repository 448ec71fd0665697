// A client and the vehicle, without network and wall clock, for the tests of the endpoint.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <ostream>
#include <string_view>
#include <vector>

#include "sim/mavlink/border.hpp"
#include "sim/mavlink/endpoint.hpp"
#include "sim/mavlink/telemetry.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv::mavlink {

constexpr Address kClient = {0x7f000001, 40001};
constexpr std::uint16_t kArmDisarm = 400;  // MAV_CMD
constexpr std::uint16_t kDoSetMode = 176;

inline ParameterId id_of(std::string_view name) {
  ParameterId id{};
  std::ranges::copy(name, id.begin());
  return id;
}

/// What a vehicle says in that message.
template <typename Message>
Message said(const VehicleReport& report) {
  return message_of<Message>(said_of(Message::kInfo.id, report).value().payload);
}

/// A client and the vehicle on the ground of a world, open if none is given, in step: wall time is
/// simulation time.
class Session {
 public:
  explicit Session(const Aboard& aboard = {}, std::optional<Address> partner = std::nullopt,
                   const ViewPose& start = {}, const World& world = {})
      : vehicle_({}, world, start, 1, Px4::Start::on_ground),
        aboard_(aboard),
        endpoint_(aboard_, partner) {}

  template <typename Message>
  void send(const Message& message) {
    endpoint_.receive(
        write_frame({sequence_++, sender_, 190, Message::kInfo.id, payload_of(message)}), kClient,
        now_s(), vehicle_);
  }
  /// System of what is sent from now on.
  void set_sender(std::uint8_t system_id) { sender_ = system_id; }
  void command(std::uint16_t id, float param1 = 0, float param2 = 0) {
    send(CommandLong{
        .param = {param1, param2}, .command = id, .target_system = 1, .target_component = 1});
  }
  /// Position and heading east, as an offboard stream repeats it.
  void send_position(const Vec3& p_world_m) {
    const Vec3 p_ned_m = swap_enu_ned(p_world_m);
    send(SetPositionTargetLocalNed{
        .p_m = {static_cast<float>(p_ned_m.x()), static_cast<float>(p_ned_m.y()),
                static_cast<float>(p_ned_m.z())},
        .type_mask = 2552,
        .target_system = 1,
        .target_component = 1,
        .coordinate_frame = 1});
  }

  /// One tick, and what the vehicle says after it.
  void step() {
    vehicle_.step();
    listen();
  }
  void listen() {
    for (const auto& bytes :
         endpoint_.take_outgoing(now_s(), vehicle_, take_news(aboard_, vehicle_))) {
      ++frames_heard_;
      ReadCounts counts;
      const auto frames = read_frames(bytes, counts);
      ASSERT_EQ(frames.size(), 1U);
      heard_[frames[0].message_id].push_back(frames[0]);
    }
  }
  void step_for(int seconds) {
    for (int i = 0; i < seconds * kTicksPerSecond; ++i) step();
  }
  /// Steps with a setpoint every 40 ms until it is so, at most this long.
  bool fly_until(const Vec3& p_world_m, double limit_s, const std::function<bool()>& is_so) {
    const double begin_s = now_s();
    while (now_s() - begin_s < limit_s) {
      if (is_so()) return true;
      if (vehicle_.tick() % 10 == 0) send_position(p_world_m);
      step();
    }
    return false;
  }

  template <typename Message>
  std::size_t count() {
    return heard_[Message::kInfo.id].size();
  }
  /// Everything said so far is forgotten.
  void forget() { heard_.clear(); }
  /// What it says to that in one kind of message.
  template <typename Answer, typename Message>
  std::vector<Answer> answers(const Message& message) {
    forget();
    send(message);
    listen();
    return all<Answer>();
  }
  /// MAV_RESULT of a command.
  int result_of(std::uint16_t id, float param1 = 0, float param2 = 0) {
    command(id, param1, param2);
    listen();
    EXPECT_EQ(last<CommandAck>().command, id);
    return last<CommandAck>().result;
  }
  template <typename Message>
  std::vector<Message> all() {
    std::vector<Message> messages;
    for (const Frame& frame : heard_[Message::kInfo.id]) {
      messages.push_back(message_of<Message>(frame.payload));
    }
    return messages;
  }
  template <typename Message>
  const std::vector<Frame>& frames() {
    return heard_[Message::kInfo.id];
  }
  template <typename Message>
  Message last() {
    return message_of<Message>(heard_[Message::kInfo.id].back().payload);
  }
  std::uint64_t frames_heard() const { return frames_heard_; }
  double now_s() const { return static_cast<double>(vehicle_.tick()) * kTick_s; }
  Quadrotor& vehicle() { return vehicle_; }
  Endpoint& endpoint() { return endpoint_; }

 private:
  Quadrotor vehicle_;
  Aboard aboard_;
  Endpoint endpoint_;
  std::uint8_t sequence_ = 0;
  std::uint8_t sender_ = 255;
  std::uint64_t frames_heard_ = 0;
  std::map<std::uint32_t, std::vector<Frame>> heard_;
};

}  // namespace gnbv::mavlink
