#include "sim/mavlink/endpoint.hpp"

#include <utility>

#include "sim/mavlink/border.hpp"
#include "sim/mavlink/telemetry.hpp"

namespace gnbv::mavlink {
namespace {

constexpr int kSeverityCritical = 2;  // MAV_SEVERITY

// messages a second of PX4's onboard link (mavlink_main.cpp)
constexpr double kHeartbeat_hz = 1.0;
constexpr double kAttitude_hz = 50.0;
constexpr double kLocalPosition_hz = 30.0;
constexpr double kBattery_hz = 0.5;
constexpr double kExtendedState_hz = 5.0;
/// The same refusal is not told more often: a stream of bad setpoints would drown the rest.
constexpr double kRefusalRepeat_s = 1.0;

/// Whether a stream is due, and if so when next. Intervals that were missed are not made up for.
bool take_due(double& due_s, double rate_hz, double now_s) {
  if (now_s < due_s) return false;
  const double interval_s = 1.0 / rate_hz;
  due_s = now_s - due_s < interval_s ? due_s + interval_s : now_s + interval_s;
  return true;
}

std::uint32_t time_boot_ms_of(const Quadrotor& vehicle) {
  return static_cast<std::uint32_t>(vehicle.tick() * (1000 / kTicksPerSecond));
}

}  // namespace

template <typename Message>
void Endpoint::send(const Message& message) {
  outgoing_.push_back(
      write_frame({sequence_++, kSystem, kComponent, Message::kInfo.id, payload_of(message)}));
}

void Endpoint::receive(std::span<const std::uint8_t> datagram, const Address& from, double now_s,
                       Quadrotor& vehicle) {
  const std::optional<Address> client_before = client();
  const bool is_armed = vehicle.px4().is_armed();
  for (const Frame& frame : link_.receive(datagram, from, now_s, is_armed)) {
    obey(frame, now_s, vehicle);
  }
  if (client() != client_before) due_ = {};
}

void Endpoint::obey(const Frame& frame, double now_s, Quadrotor& vehicle) {
  if (frame.message_id == Heartbeat::kInfo.id) return;  // the link has taken note of it
  if (!asks_for_something(frame)) {
    ++counts_.ignored;
  } else if (frame.message_id == CommandLong::kInfo.id) {
    obey(command_of(message_of<CommandLong>(frame.payload)), frame, vehicle);
  } else if (frame.message_id == SetMode::kInfo.id) {
    obey(command_of(message_of<SetMode>(frame.payload)), frame, vehicle);
  } else {
    obey(message_of<SetPositionTargetLocalNed>(frame.payload), now_s, vehicle);
  }
}

void Endpoint::obey(const Px4Command& command, const Frame& frame, Quadrotor& vehicle) {
  ++counts_.commands;
  const Ack ack = vehicle.px4().command(command);
  send(CommandAck{.command = command.id,
                  .result = static_cast<std::uint8_t>(ack),
                  .target_system = frame.system_id,
                  .target_component = frame.component_id});
}

void Endpoint::obey(const SetPositionTargetLocalNed& message, double now_s, Quadrotor& vehicle) {
  const auto read = setpoint_of(message, yaw_of(vehicle.estimate().T_world_body));
  if (const auto* const setpoint = std::get_if<Setpoint>(&read)) {
    ++counts_.setpoints;
    vehicle.command(*setpoint);
    return;
  }
  ++counts_.refused_setpoints;
  const std::string& reason = std::get<Refusal>(read).reason;
  if (reason == refusal_told_ && now_s - refusal_told_s_ < kRefusalRepeat_s) return;
  refusal_told_ = reason;
  refusal_told_s_ = now_s;
  say({.severity = kSeverityCritical, .text = reason});
}

void Endpoint::say(const gnbv::StatusText& text) {
  if (++text_id_ == 0) ++text_id_;
  for (const StatusText& chunk : status_texts_of(text, text_id_)) send(chunk);
}

void Endpoint::send_telemetry(double now_s, const Quadrotor& vehicle) {
  const std::uint32_t time_boot_ms = time_boot_ms_of(vehicle);
  if (take_due(due_.heartbeat_s, kHeartbeat_hz, now_s)) send(heartbeat_of(vehicle.px4()));
  if (take_due(due_.extended_state_s, kExtendedState_hz, now_s)) {
    send(extended_sys_state_of(vehicle.px4()));
  }
  if (take_due(due_.attitude_s, kAttitude_hz, now_s)) {
    send(attitude_of(vehicle.estimate(), time_boot_ms));
  }
  if (take_due(due_.local_position_s, kLocalPosition_hz, now_s)) {
    send(local_position_of(vehicle.estimate(), time_boot_ms));
  }
  if (take_due(due_.battery_s, kBattery_hz, now_s)) {
    send(battery_status_of(vehicle.energy_wh(), battery_wh_));
  }
}

std::vector<std::vector<std::uint8_t>> Endpoint::take_outgoing(double now_s, Quadrotor& vehicle) {
  const std::vector<gnbv::StatusText> said = vehicle.px4().take_messages();
  if (!client().has_value()) return {};
  for (const gnbv::StatusText& text : said) say(text);
  send_telemetry(now_s, vehicle);
  return std::exchange(outgoing_, {});
}

}  // namespace gnbv::mavlink
