#include "sim/mavlink/endpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/mavlink/border.hpp"

namespace gnbv::mavlink {
namespace {

/// The same refusal is not told more often: a stream of bad setpoints would drown the rest.
constexpr double kRefusalRepeat_s = 1.0;

enum MavCommand : std::uint16_t {
  kDoSetMode = 176,
  kDoReposition = 192,
  // about messages, not about flight
  kGetMessageInterval = 510,
  kSetMessageInterval = 511,
  kRequestMessage = 512,
  kRequestProtocolVersion = 519,
  kRequestAutopilotCapabilities = 520,
  kRequestCameraInformation = 521,
  kRequestVideoStreamInformation = 2504
};

/// A message's id as a parameter carries it; one that no message has when it is none.
std::uint32_t message_id_of(float param) {
  constexpr float kIdMax = 0xffffff;
  return param >= 0.0F && param <= kIdMax ? static_cast<std::uint32_t>(param) : 0xffffffff;
}

std::string text_of(const ParameterId& id) { return {id.begin(), std::ranges::find(id, '\0')}; }

}  // namespace

/// One overload for each message.
struct Endpoint::Handler {
  Endpoint& endpoint;
  const Frame& frame;
  double now_s;
  Quadrotor& vehicle;

  double home_z_m() const { return vehicle.px4().home_world_m().z(); }
  void reply(const auto& message) const { endpoint.send(packed(message)); }
  /// Short enough for one STATUSTEXT.
  void tell(int severity, const std::string& text) const {
    reply(status_texts_of({.severity = severity, .text = text}, 1).front());
  }

  void operator()(const CommandLong& asked) const {
    if (asked.command != kDoReposition) return obey({asked.command, asked.param});
    acknowledge(asked.command,
                reposition({asked.param[0], asked.param[1], asked.param[3]},
                           world_of_place(asked.param[4], asked.param[5], asked.param[6])));
  }

  void operator()(const CommandInt& asked) const {
    const auto& p = asked.param;
    if (asked.command == kDoReposition) {
      const auto place = place_in(asked);
      return acknowledge(asked.command,
                         place ? reposition({p[0], p[1], p[3]}, *place) : Ack::denied);
    }
    const float none = std::nanf("");
    const auto z_m = static_cast<float>(world_z_of(asked.frame, asked.z, home_z_m()));
    obey({asked.command, {p[0], p[1], p[2], p[3], none, none, z_m}});
  }

  void operator()(const SetMode& asked) const {
    obey({kDoSetMode,
          {static_cast<float>(asked.base_mode), static_cast<float>(asked.custom_mode >> 16 & 0xff),
           static_cast<float>(asked.custom_mode >> 24)}});
  }

  /// World ENU; nothing in other frames than those of border.hpp and LOCAL_NED.
  std::optional<Vec3> place_in(const CommandInt& asked) const {
    const auto number = [](std::int32_t value, double unit) {
      return value == kNoCoordinate ? kNotControlled : unit * value;
    };
    if (is_global(asked.frame)) {
      return world_of_place(number(asked.x, 1e-7), number(asked.y, 1e-7),
                            world_z_of(asked.frame, asked.z, home_z_m()));
    }
    if (asked.frame != 1) return std::nullopt;
    return world_of_local({number(asked.x, 1e-4), number(asked.y, 1e-4), asked.z},
                          endpoint.aboard_.origin_world_m);
  }

  struct Manner {
    float speed_m_s, flags, yaw_ned_rad;
  };
  /// As PX4, only with the flag that changes the mode.
  Ack reposition(const Manner& manner, const Vec3& goal_world_m) const {
    if (manner.flags != 1.0F) return Ack::unsupported;
    if (!is_in_bounds(goal_world_m) || std::isinf(manner.yaw_ned_rad)) return Ack::denied;
    return vehicle.px4().reposition(
        goal_world_m, swap_yaw_enu_ned(static_cast<double>(manner.yaw_ned_rad)), manner.speed_m_s);
  }

  void obey(const Px4Command& command) const { acknowledge(command.id, result_of(command)); }

  void acknowledge(std::uint16_t command, Ack result) const {
    ++endpoint.counts_.commands;
    reply(CommandAck{.command = command,
                     .result = static_cast<std::uint8_t>(result),
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
    fly(setpoint_of(asked, yaw_of(vehicle.estimate().T_world_body),
                    endpoint.aboard_.origin_world_m));
  }

  void operator()(const SetPositionTargetGlobalInt& asked) const {
    fly(setpoint_of(asked, home_z_m()));
  }

  void fly(const std::variant<Setpoint, Refusal>& read) const {
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

  ParamValue value_of(std::size_t number) const {
    return mavlink::value_of(endpoint.aboard_, vehicle.px4().commander(), number);
  }

  void operator()(const ParamRequestList&) const {
    for (std::size_t i = 0; i < parameter_count(); ++i) reply(value_of(i));
  }

  /// PX4 only tells of an unknown name, as clients look for those of other versions.
  void tell_of_unknown(const std::string& name) const {
    tell(kSeverityInfo, fmt::format("no parameter {}", name));
  }

  void operator()(const ParamRequestRead& asked) const {
    const auto index = static_cast<std::size_t>(asked.param_index);
    std::optional<std::size_t> number = index;
    if (asked.param_index < 0) number = find_parameter(text_of(asked.param_id));
    if (number && *number < parameter_count()) return reply(value_of(*number));
    tell_of_unknown(asked.param_index >= 0 ? std::to_string(index) : text_of(asked.param_id));
  }

  void operator()(const ParamSet& asked) const {
    const std::string name = text_of(asked.param_id);
    const std::optional<std::size_t> number = find_parameter(name);
    if (!number) return tell_of_unknown(name);
    CommanderParameters commander = vehicle.px4().commander();
    if (set_parameter(endpoint.aboard_, commander, *number, asked)) {
      vehicle.px4().set_commander(commander);
      endpoint.aboard_.were_set.push_back(*number);  // news for all
    } else {
      tell(kSeverityCritical, fmt::format("parameter {} not set", name));
      reply(value_of(*number));
    }
  }

  template <typename Message>
  requires requires(MissionExchange exchange, const Message& message,
                    const MissionExchange::Context& context) {
    exchange.receive(message, context);
  }
  void operator()(const Message& message) const {
    const MissionExchange::Context context{endpoint.aboard_, vehicle.px4(), frame.system_id,
                                           frame.component_id, now_s};
    for (Frame& answer : endpoint.missions_.receive(message, context)) {
      endpoint.send(std::move(answer));
    }
  }

  void operator()(const MissionSetCurrent& asked) const {
    if (vehicle.px4().set_current_step(asked.seq)) {
      endpoint.send(*said_of(MissionCurrent::kInfo.id, endpoint.report_of(vehicle)));
    } else {
      tell(kSeverityWarning, fmt::format("no mission item {}", asked.seq));
    }
  }

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
    if (answers_as_camera(frame, vehicle)) continue;
    const Handler handler{*this, frame, now_s, vehicle};
    if (handle_if_order(frame, aboard_.system_id, handler)) continue;
    const bool is_question =
        handle_if_one_of<ParamRequestList, ParamRequestRead, ParamSet, MissionRequestList,
                         MissionCount, MissionClearAll, MissionRequest, MissionRequestInt,
                         MissionItemInt, MissionItem, MissionSetCurrent, MissionAck, Timesync,
                         Ping>(frame, aboard_.system_id, handler);
    ++(is_question ? counts_.questions : counts_.ignored);
  }
}

/// A command for the camera, which says what it is when asked and does nothing else.
bool Endpoint::answers_as_camera(const Frame& frame, const Quadrotor& vehicle) {
  if (!aboard_.video || frame.message_id != CommandLong::kInfo.id) return false;
  const auto asked = message_of<CommandLong>(frame.payload);
  if (asked.target_component != kCamera || asked.target_system != aboard_.system_id) return false;
  ++counts_.commands;
  const std::uint32_t id = asked.command == kRequestCameraInformation ? CameraInformation::kInfo.id
                           : asked.command == kRequestVideoStreamInformation
                               ? VideoStreamInformation::kInfo.id
                           : asked.command == kRequestMessage ? message_id_of(asked.param[0])
                                                              : 0;
  const Ack result = is_cameras(id) ? Ack::accepted : Ack::unsupported;
  Frame ack = packed(CommandAck{.command = asked.command,
                                .result = static_cast<std::uint8_t>(result),
                                .target_system = frame.system_id,
                                .target_component = frame.component_id});
  ack.component_id = kCamera;
  send(std::move(ack));
  if (is_cameras(id)) send(*said_of(id, report_of(vehicle)));
  return true;
}

VehicleReport Endpoint::report_of(const Quadrotor& vehicle) const {
  return {.estimate = vehicle.estimate(),
          .time_boot_ms = static_cast<std::uint32_t>(vehicle.tick() * (1000 / kTicksPerSecond)),
          .px4 = &vehicle.px4(),
          .energy_wh = vehicle.energy_wh(),
          .battery_wh = aboard_.battery_wh,
          .power_w = vehicle.power_w(),
          .origin_world_m = aboard_.origin_world_m,
          .specific_force_body_m_s2 = vehicle.specific_force_body_m_s2(),
          .video = aboard_.video ? &*aboard_.video : nullptr};
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
  frame.system_id = aboard_.system_id;
  if (frame.component_id == 0) frame.component_id = kComponent;
  outgoing_.push_back(write_frame(frame));
}

News take_news(Aboard& aboard, Quadrotor& vehicle) {
  Px4& px4 = vehicle.px4();
  News news{px4.take_messages(), px4.take_reached(), std::exchange(aboard.were_set, {})};
  if (px4.is_armed() && !aboard.was_armed) {
    const Vec3& origin_m = aboard.origin_world_m;
    news.texts.push_back({.severity = kSeverityInfo,
                          .text = fmt::format("Local NED counts from world x {:.2f} y {:.2f}",
                                              origin_m.x(), origin_m.y())});
  }
  aboard.was_armed = px4.is_armed();
  return news;
}

std::vector<std::vector<std::uint8_t>> Endpoint::take_outgoing(double now_s,
                                                               const Quadrotor& vehicle,
                                                               const News& news) {
  if (!client().has_value()) return {};
  for (const gnbv::StatusText& text : news.texts) say(text);
  for (const std::uint16_t item : news.reached) send(packed(MissionItemReached{item}));
  for (const std::size_t number : news.were_set) {
    send(packed(value_of(aboard_, vehicle.px4().commander(), number)));
  }
  for (Frame& frame : missions_.remind(now_s)) send(std::move(frame));
  const VehicleReport report = report_of(vehicle);
  for (const std::uint32_t id : streams_.take_due(now_s)) {
    if (std::optional<Frame> frame = said_of(id, report)) send(*std::move(frame));
    if (id == Heartbeat::kInfo.id && aboard_.video) send(camera_heartbeat());
  }
  return std::exchange(outgoing_, {});
}

}  // namespace gnbv::mavlink
