// Who is heard: one client, by its address.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/mavlink/messages.hpp"

namespace gnbv::mavlink {

/// IPv4, host byte order.
struct Address {
  std::uint32_t host = 0;
  std::uint16_t port = 0;
  bool operator==(const Address&) const = default;
};

/// Every byte that arrived ends in one of these; only `accepted` went on.
struct LinkCounts {
  ReadCounts frames;
  std::uint64_t datagrams = 0;
  std::uint64_t oversized_datagrams = 0;  // longer than the receiver's buffer
  std::uint64_t foreign_datagrams = 0;    // from another address than the client's
  std::uint64_t accepted = 0;
};

/// Whom commands and setpoints are for. 0 is everybody.
constexpr std::uint8_t kComponent = 1;  // MAV_COMP_ID_AUTOPILOT1
constexpr std::uint8_t kCamera = 100;   // MAV_COMP_ID_CAMERA

template <typename Message>
bool is_for_us(const Message& message, std::uint8_t system_id) {
  if constexpr (requires { message.target_component; }) {
    if (message.target_component != kComponent && message.target_component != 0) return false;
  }
  return message.target_system == system_id || message.target_system == 0;
}

/// Calls `handle` with the frame's message if it is one of these and for us; whether it did.
template <typename... Messages>
bool handle_if_one_of(const Frame& frame, std::uint8_t system_id, const auto& handle) {
  const auto is_it = [&]<typename Message>() {
    if (frame.message_id != Message::kInfo.id) return false;
    const auto message = message_of<Message>(frame.payload);
    if (!is_for_us(message, system_id)) return false;
    handle(message);
    return true;
  };
  return (is_it.template operator()<Messages>() || ...);
}

/// The same of an order: a command, a mode or a setpoint.
bool handle_if_order(const Frame& frame, std::uint8_t system_id, const auto& handle) {
  return handle_if_one_of<SetMode, CommandLong, CommandInt, SetPositionTargetLocalNed,
                          SetPositionTargetGlobalInt, SetAttitudeTarget>(frame, system_id, handle);
}

/// The first address from which a good frame comes is the client's. While the vehicle is armed it
/// stays so: nobody takes over in flight. While it is disarmed another address takes the place, by
/// a good frame when the client was silent for kClientSilence_s, or by an order when the client
/// gave none that long. A partner, whom the vehicle speaks to first, has the place for good.
/// MAVLink 2 signatures are not checked: whoever can send from the client's address is the client.
class Link {
 public:
  static constexpr double kClientSilence_s = 5.0;

  explicit Link(std::optional<Address> partner = std::nullopt, std::uint8_t system_id = 1)
      : client_(partner), is_for_good_(partner.has_value()), system_id_(system_id) {}

  /// The datagram's frames that are good and the client's. `now_s` is any clock that never goes
  /// back.
  std::vector<Frame> receive(std::span<const std::uint8_t> datagram, const Address& from,
                             double now_s, bool is_armed);
  /// A datagram that did not fit the receiver's buffer.
  void count_oversized_datagram() {
    ++counts_.datagrams;
    ++counts_.oversized_datagrams;
  }

  const std::optional<Address>& client() const { return client_; }
  const LinkCounts& counts() const { return counts_; }

 private:
  std::optional<Address> client_;
  bool is_for_good_ = false;
  std::uint8_t system_id_ = 1;
  double heard_s_ = 0.0;  // the client's last good frame
  double asked_s_ = 0.0;  // its last order
  LinkCounts counts_;
};

}  // namespace gnbv::mavlink
