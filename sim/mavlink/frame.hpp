// MAVLink on the wire: frames out of a datagram's bytes and back. Pure functions; whatever the
// bytes hold, they are either a frame or counted. Format: mavlink.io/en/guide/serialization.html.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/mavlink/messages.hpp"

namespace gnbv::mavlink {

/// A frame whose CRC was right. `payload` has all the message's fields and no more: what the sender
/// left off (MAVLink 2 drops trailing zeros) is zero again, and what a newer sender's message has
/// behind them (extension fields) is left off.
struct Frame {
  std::uint8_t sequence = 0;
  std::uint8_t system_id = 0;
  std::uint8_t component_id = 0;
  std::uint32_t message_id = 0;
  std::vector<std::uint8_t> payload;
};

/// What became of the bytes. Everything but `read` was dropped.
struct ReadCounts {
  std::uint64_t read = 0;
  std::uint64_t bad_crc = 0;
  std::uint64_t truncated =
      0;  // the datagram ends before the frame, or MAVLink 1 with fields missing
  std::uint64_t oversized = 0;  // MAVLink 1 with a payload longer than its message
  std::uint64_t unknown = 0;  // a message or an incompatibility flag that is not ours to understand
};

/// CRC-16/MCRF4XX over the frame without its start byte, then over `crc_extra`.
std::uint16_t frame_crc(std::span<const std::uint8_t> bytes_after_start, std::uint8_t crc_extra);

/// Every frame of a datagram, MAVLink 1 and 2. A dropped frame is passed over when the datagram or
/// another frame's start follows it; otherwise its length is not believed, and the search goes on
/// at its second byte. Signatures are passed over too: there is no key to check them with.
std::vector<Frame> read_frames(std::span<const std::uint8_t> datagram, ReadCounts& counts);

/// A MAVLink 2 frame, trailing zeros of the payload left off. The message has to be one of ours.
std::vector<std::uint8_t> write_frame(const Frame& frame);

}  // namespace gnbv::mavlink
