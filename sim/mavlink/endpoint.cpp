#include "sim/mavlink/endpoint.hpp"

#include <utility>

#include "sim/mavlink/answers.hpp"
#include "sim/mavlink/border.hpp"
#include "sim/mavlink/query_messages.hpp"
#include "sim/mavlink/telemetry.hpp"

namespace gnbv::mavlink {
namespace {

/// The same refusal is not told more often: a stream of bad setpoints would drown the rest.
constexpr double kRefusalRepeat_s = 1.0;

/// What obey_about_messages() knows.
enum AboutMessages : std::uint16_t {  // MAV_CMD
  kGetMessageInterval = 510,
  kSetMessageInterval = 511,
  kRequestMessage = 512,
  kRequestProtocolVersion = 519,
  kRequestAutopilotCapabilities = 520
};

/// A message's id as a parameter carries it; one that no message has when it is none.
std::uint32_t message_id_of(float param) {
  constexpr float kIdMax = 0xffffff;
  return param >= 0.0F && param <= kIdMax ? static_cast<std::uint32_t>(param) : 0xffffffff;
}

}  // namespace

void Endpoint::send(Packed message) {
  if (outgoing_.size() >= kOutgoingMax) {
    ++counts_.unsaid;
    return;
  }
  outgoing_.push_back(
      write_frame({sequence_++, kSystem, kComponent, message.id, std::move(message.payload)}));
}

void Endpoint::receive(std::span<const std::uint8_t> datagram, const Address& from, double now_s,
                       Quadrotor& vehicle) {
  const std::optional<Address> client_before = client();
  const bool is_armed = vehicle.px4().is_armed();
  const std::vector<Frame> frames = link_.receive(datagram, from, now_s, is_armed);
  if (client() != client_before) streams_ = {};  // another client, other wishes
  for (const Frame& frame : frames) obey(frame, now_s, vehicle);
}

void Endpoint::obey(const Frame& frame, double now_s, Quadrotor& vehicle) {
  if (frame.message_id == Heartbeat::kInfo.id) return;  // the link has taken note of it
  if (!asks_for_something(frame)) {
    answer(frame, vehicle);
  } else if (frame.message_id == CommandLong::kInfo.id) {
    obey(command_of(message_of<CommandLong>(frame.payload)), frame, vehicle);
  } else if (frame.message_id == CommandInt::kInfo.id) {
    obey(command_of(message_of<CommandInt>(frame.payload)), frame, vehicle);
  } else if (frame.message_id == SetMode::kInfo.id) {
    obey(command_of(message_of<SetMode>(frame.payload)), frame, vehicle);
  } else if (frame.message_id == SetPositionTargetLocalNed::kInfo.id) {
    obey(message_of<SetPositionTargetLocalNed>(frame.payload), now_s, vehicle);
  } else if (frame.message_id == SetAttitudeTarget::kInfo.id) {
    refuse_setpoint("setpoint of attitude not supported", now_s);
  } else {
    refuse_setpoint("global setpoint not supported", now_s);
  }
}

void Endpoint::answer(const Frame& frame, Quadrotor& vehicle) {
  std::optional<std::vector<Packed>> answers = answers_to(frame, vehicle);
  if (!answers) {
    ++counts_.ignored;
    return;
  }
  ++counts_.questions;
  for (Packed& message : *answers) send(std::move(message));
}

void Endpoint::obey(const Px4Command& command, const Frame& frame, Quadrotor& vehicle) {
  ++counts_.commands;
  const std::optional<Ack> about_messages = obey_about_messages(command, vehicle);
  const Ack ack = about_messages ? *about_messages : vehicle.px4().command(command);
  send(packed(CommandAck{.command = command.id,
                         .result = static_cast<std::uint8_t>(ack),
                         .target_system = frame.system_id,
                         .target_component = frame.component_id}));
}

std::optional<Ack> Endpoint::obey_about_messages(const Px4Command& command,
                                                 const Quadrotor& vehicle) {
  const std::uint32_t asked = message_id_of(command.param[0]);
  const auto say_once = [&](std::uint32_t id) {
    std::optional<Packed> message = said_of(id, vehicle, battery_wh_);
    if (!message) return Ack::unsupported;
    send(std::move(*message));
    return Ack::accepted;
  };
  switch (command.id) {
    case kRequestMessage:
      return say_once(asked);
    case kRequestProtocolVersion:
      return say_once(ProtocolVersion::kInfo.id);
    case kRequestAutopilotCapabilities:
      return say_once(AutopilotVersion::kInfo.id);
    case kSetMessageInterval:
      return streams_.set_interval_us(asked, command.param[1]) ? Ack::accepted : Ack::unsupported;
    case kGetMessageInterval: {
      const std::optional<std::int32_t> interval_us = streams_.interval_us(asked);
      send(packed(MessageInterval{interval_us.value_or(0), static_cast<std::uint16_t>(asked)}));
      return interval_us ? Ack::accepted : Ack::unsupported;
    }
    default:
      return std::nullopt;
  }
}

void Endpoint::obey(const SetPositionTargetLocalNed& message, double now_s, Quadrotor& vehicle) {
  const auto read = setpoint_of(message, yaw_of(vehicle.estimate().T_world_body));
  if (const auto* const setpoint = std::get_if<Setpoint>(&read)) {
    ++counts_.setpoints;
    vehicle.command(*setpoint);
  } else {
    refuse_setpoint(std::get<Refusal>(read).reason, now_s);
  }
}

void Endpoint::refuse_setpoint(const std::string& reason, double now_s) {
  ++counts_.refused_setpoints;
  if (reason == refusal_told_ && now_s - refusal_told_s_ < kRefusalRepeat_s) return;
  refusal_told_ = reason;
  refusal_told_s_ = now_s;
  say({.severity = kSeverityCritical, .text = reason});
}

void Endpoint::say(const gnbv::StatusText& text) {
  if (++text_id_ == 0) ++text_id_;
  for (const StatusText& chunk : status_texts_of(text, text_id_)) send(packed(chunk));
}

std::vector<std::vector<std::uint8_t>> Endpoint::take_outgoing(double now_s, Quadrotor& vehicle) {
  const std::vector<gnbv::StatusText> said = vehicle.px4().take_messages();
  if (!client().has_value()) return {};
  for (const gnbv::StatusText& text : said) say(text);
  for (const std::uint32_t id : streams_.take_due(now_s)) {
    send(*said_of(id, vehicle, battery_wh_));
  }
  return std::exchange(outgoing_, {});
}

}  // namespace gnbv::mavlink
