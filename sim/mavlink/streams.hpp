// What the vehicle says of itself, message by message: on its own at rates that the client may
// change, or once when asked.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "sim/flight/quadrotor.hpp"
#include "sim/mavlink/messages.hpp"

namespace gnbv::mavlink {

/// A message without a frame around it yet.
struct Packed {
  std::uint32_t id = 0;
  std::vector<std::uint8_t> payload;
};

template <typename Message>
Packed packed(const Message& message) {
  return {Message::kInfo.id, payload_of(message)};
}

/// Message `id` about the vehicle as it is; nothing for one that it does not say. `battery_wh` as
/// PowerParameters has it.
std::optional<Packed> said_of(std::uint32_t id, const Quadrotor& vehicle, double battery_wh);

/// When each message is due, by wall time.
class Streams {
 public:
  Streams();
  /// MAV_CMD_SET_MESSAGE_INTERVAL: 0 is the default of PX4's onboard link, below 0 never. False for
  /// a message that the vehicle does not say, or no number.
  bool set_interval_us(std::uint32_t id, float interval_us);
  /// As MESSAGE_INTERVAL has it; nothing for a message that the vehicle does not say.
  std::optional<std::int32_t> interval_us(std::uint32_t id) const;
  /// Those due now. Times that were missed are not made up for: each comes once at most.
  std::vector<std::uint32_t> take_due(double now_s);

 private:
  struct Stream {
    double interval_s = 0.0;  // 0: never
    double due_s = 0.0;
  };
  std::map<std::uint32_t, Stream> streams_;
};

}  // namespace gnbv::mavlink
