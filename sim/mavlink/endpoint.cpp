#include "sim/mavlink/endpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "sim/mavlink/border.hpp"

namespace gnbv::mavlink {
namespace {

/// The same refusal is not told more often: a stream of bad setpoints would drown the rest.
constexpr double kRefusalRepeat_s = 1.0;

enum MavCommand : std::uint16_t {
  kDoSetMode = 176,
  // about messages, not about flight
  kGetMessageInterval = 510,
  kSetMessageInterval = 511,
  kRequestMessage = 512,
  kRequestProtocolVersion = 519,
  kRequestAutopilotCapabilities = 520
};

// MAV_MISSION_RESULT
constexpr std::uint8_t kMissionAccepted = 0;
constexpr std::uint8_t kMissionUnsupported = 3;
constexpr std::uint8_t kMissionInvalidSequence = 13;

/// A message's id as a parameter carries it; one that no message has when it is none.
std::uint32_t message_id_of(float param) {
  constexpr float kIdMax = 0xffffff;
  return param >= 0.0F && param <= kIdMax ? static_cast<std::uint32_t>(param) : 0xffffffff;
}

std::string text_of(const ParameterId& id) { return {id.begin(), std::ranges::find(id, '\0')}; }

/// MAV_PARAM_TYPE: INT32 or REAL32.
std::uint8_t type_of(const Px4Parameter& parameter) { return parameter.value == nullptr ? 6 : 9; }

ParamValue value_of(const CommanderParameters& commander, const Px4Parameter& parameter) {
  const double value = px4_value(commander, parameter);
  ParamValue message{.param_value = parameter.value == nullptr
                                        ? std::bit_cast<float>(static_cast<std::int32_t>(value))
                                        : static_cast<float>(value),
                     .param_count = static_cast<std::uint16_t>(kPx4Parameters.size()),
                     .param_index = static_cast<std::uint16_t>(&parameter - kPx4Parameters.data()),
                     .param_type = type_of(parameter)};
  std::ranges::copy(parameter.name, message.param_id.begin());
  return message;
}

}  // namespace

/// One overload for each message.
struct Endpoint::Handler {
  Endpoint& endpoint;
  const Frame& frame;
  double now_s;
  Quadrotor& vehicle;

  void reply(const auto& message) const { endpoint.send(packed(message)); }
  /// Short enough for one STATUSTEXT.
  void refuse(const std::string& text) const {
    reply(status_texts_of({.severity = kSeverityCritical, .text = text}, 1).front());
  }

  void operator()(const CommandLong& asked) const { obey({asked.command, asked.param}); }

  void operator()(const CommandInt& asked) const {
    const auto& p = asked.param;
    const float none = std::nanf("");
    obey({asked.command, {p[0], p[1], p[2], p[3], none, none, asked.z}});
  }

  void operator()(const SetMode& asked) const {
    obey({kDoSetMode,
          {static_cast<float>(asked.base_mode), static_cast<float>(asked.custom_mode >> 16 & 0xff),
           static_cast<float>(asked.custom_mode >> 24)}});
  }

  void obey(const Px4Command& command) const {
    ++endpoint.counts_.commands;
    reply(CommandAck{.command = command.id,
                     .result = static_cast<std::uint8_t>(result_of(command)),
                     .target_system = frame.system_id,
                     .target_component = frame.component_id});
  }

  Ack result_of(const Px4Command& command) const {
    const auto ack_if = [](bool is_known) { return is_known ? Ack::accepted : Ack::unsupported; };
    const std::uint32_t asked = message_id_of(command.param[0]);
    const auto say_once = [&](std::uint32_t id) {
      const std::optional<Frame> message = said_of(id, endpoint.report_of(vehicle));
      if (message) endpoint.send(*message);
      return ack_if(message.has_value());
    };
    switch (command.id) {
      case kRequestMessage:
        return say_once(asked);
      case kRequestProtocolVersion:
        return say_once(ProtocolVersion::kInfo.id);
      case kRequestAutopilotCapabilities:
        return say_once(AutopilotVersion::kInfo.id);
      case kSetMessageInterval:
        return ack_if(endpoint.streams_.set_interval_us(asked, command.param[1]));
      case kGetMessageInterval: {
        const std::optional<std::int32_t> interval_us = endpoint.streams_.interval_us(asked);
        reply(MessageInterval{interval_us.value_or(0), static_cast<std::uint16_t>(asked)});
        return ack_if(interval_us.has_value());
      }
      default:  // about flight
        return vehicle.px4().command(command);
    }
  }

  void operator()(const SetPositionTargetLocalNed& asked) const {
    const auto read = setpoint_of(asked, yaw_of(vehicle.estimate().T_world_body));
    if (const auto* const refusal = std::get_if<Refusal>(&read)) {
      endpoint.refuse_setpoint(refusal->reason, now_s);
      return;
    }
    ++endpoint.counts_.setpoints;
    vehicle.command(std::get<Setpoint>(read));
  }

  void operator()(const SetAttitudeTarget&) const {
    endpoint.refuse_setpoint("setpoint of attitude not supported", now_s);
  }

  void operator()(const SetPositionTargetGlobalInt&) const {
    endpoint.refuse_setpoint("global setpoint not supported", now_s);
  }

  void operator()(const ParamRequestList&) const {
    for (const Px4Parameter& parameter : kPx4Parameters) {
      reply(value_of(vehicle.px4().commander(), parameter));
    }
  }

  void operator()(const ParamRequestRead& asked) const {
    const auto index = static_cast<std::size_t>(asked.param_index);
    const Px4Parameter* const parameter = asked.param_index < 0
                                              ? find_px4_parameter(text_of(asked.param_id))
                                          : index < kPx4Parameters.size() ? &kPx4Parameters[index]
                                                                          : nullptr;
    if (parameter != nullptr) return reply(value_of(vehicle.px4().commander(), *parameter));
    refuse(fmt::format("no parameter {}",
                       asked.param_index >= 0 ? std::to_string(index) : text_of(asked.param_id)));
  }

  void operator()(const ParamSet& asked) const {
    const std::string name = text_of(asked.param_id);
    const Px4Parameter* const parameter = find_px4_parameter(name);
    if (parameter == nullptr) return refuse(fmt::format("no parameter {}", name));
    CommanderParameters commander = vehicle.px4().commander();
    const double value = parameter->value == nullptr
                             ? std::bit_cast<std::int32_t>(asked.param_value)
                             : static_cast<double>(asked.param_value);
    if (asked.param_type == type_of(*parameter) && set_px4_value(commander, *parameter, value)) {
      vehicle.px4().set_commander(commander);
    } else {
      refuse(fmt::format("parameter {} not set", name));
    }
    reply(value_of(vehicle.px4().commander(), *parameter));
  }

  void acknowledge_mission(std::uint8_t result, std::uint8_t mission_type) const {
    reply(MissionAck{frame.system_id, frame.component_id, result, mission_type});
  }

  void operator()(const MissionRequestList& asked) const {
    reply(MissionCount{.target_system = frame.system_id,
                       .target_component = frame.component_id,
                       .mission_type = asked.mission_type});
  }

  void operator()(const MissionCount& asked) const {
    acknowledge_mission(asked.number == 0 ? kMissionAccepted : kMissionUnsupported,
                        asked.mission_type);
  }

  void operator()(const MissionClearAll& asked) const {
    acknowledge_mission(kMissionAccepted, asked.mission_type);
  }

  template <std::uint32_t id, std::uint8_t crc_extra>
  void operator()(const MissionNumber<id, crc_extra>& requested) const {
    acknowledge_mission(kMissionInvalidSequence, requested.mission_type);
  }

  void operator()(const MissionAck&) const {}

  void operator()(const Timesync& asked) const {
    if (asked.tc1_ns != 0) return;  // an answer, and we never ask
    constexpr std::int64_t kTick_ns = 1'000'000'000 / kTicksPerSecond;
    reply(Timesync{vehicle.tick() * kTick_ns, asked.ts1_ns, frame.system_id, frame.component_id});
  }

  void operator()(const Ping& asked) const {
    if (asked.target_system != 0) return;  // an answer likewise
    reply(Ping{asked.time_us, asked.seq, frame.system_id, frame.component_id});
  }
};

void Endpoint::receive(std::span<const std::uint8_t> datagram, const Address& from, double now_s,
                       Quadrotor& vehicle) {
  const std::optional<Address> client_before = client();
  const bool is_armed = vehicle.px4().is_armed();
  const std::vector<Frame> frames = link_.receive(datagram, from, now_s, is_armed);
  if (client() != client_before) streams_ = {};  // another client, other wishes
  for (const Frame& frame : frames) {
    if (frame.message_id == Heartbeat::kInfo.id) continue;  // the link has taken note of it
    const Handler handler{*this, frame, now_s, vehicle};
    if (handle_if_order(frame, handler)) continue;
    const bool is_question =
        handle_if_one_of<ParamRequestList, ParamRequestRead, ParamSet, MissionRequestList,
                         MissionCount, MissionClearAll, MissionRequest, MissionRequestInt,
                         MissionAck, Timesync, Ping>(frame, handler);
    ++(is_question ? counts_.questions : counts_.ignored);
  }
}

VehicleReport Endpoint::report_of(const Quadrotor& vehicle) const {
  return {.estimate = vehicle.estimate(),
          .time_boot_ms = static_cast<std::uint32_t>(vehicle.tick() * (1000 / kTicksPerSecond)),
          .px4 = &vehicle.px4(),
          .energy_wh = vehicle.energy_wh(),
          .battery_wh = battery_wh_};
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

void Endpoint::send(Frame frame) {
  if (outgoing_.size() >= kOutgoingMax) {
    ++counts_.unsaid;
    return;
  }
  frame.sequence = sequence_++;
  frame.system_id = kSystem;
  frame.component_id = kComponent;
  outgoing_.push_back(write_frame(frame));
}

std::vector<std::vector<std::uint8_t>> Endpoint::take_outgoing(double now_s, Quadrotor& vehicle) {
  const std::vector<gnbv::StatusText> said = vehicle.px4().take_messages();
  if (!client().has_value()) return {};
  for (const gnbv::StatusText& text : said) say(text);
  const VehicleReport report = report_of(vehicle);
  for (const std::uint32_t id : streams_.take_due(now_s)) send(*said_of(id, report));
  return std::exchange(outgoing_, {});
}

}  // namespace gnbv::mavlink
