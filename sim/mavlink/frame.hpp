// MAVLink on the wire: messages to payloads, payloads to frames, frames out of a datagram's bytes,
// and back. Pure functions; whatever the bytes hold, they are either a frame or counted. Format:
// mavlink.io/en/guide/serialization.html.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace gnbv::mavlink {

/// What a receiver must know before it can check a frame. `crc_extra` is the seed that common.xml's
/// definition hashes to; `base_size` counts the fields that MAVLink 1 has, `size` all of ours.
struct MessageInfo {
  std::uint32_t id = 0;
  std::uint8_t crc_extra = 0;
  std::uint8_t base_size = 0;
  std::uint8_t size = 0;
};

// MAVLink sorts a message's fields by their size, so that a struct of them has no gaps: its first
// `size` bytes are the payload. Extension fields come last unsorted; where that makes a gap the
// struct is packed.
static_assert(std::endian::native == std::endian::little, "MAVLink's byte order");

template <typename Message>
std::vector<std::uint8_t> payload_of(const Message& message) {
  constexpr std::size_t kSize = Message::kInfo.size;
  static_assert(kSize <= sizeof(Message) && sizeof(Message) < kSize + alignof(Message));
  const auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(Message)>>(message);
  return {bytes.begin(), bytes.begin() + kSize};
}

/// The reverse. `payload` holds at least Message::kInfo.size bytes.
template <typename Message>
Message message_of(std::span<const std::uint8_t> payload) {
  std::array<std::uint8_t, sizeof(Message)> bytes{};
  std::copy_n(payload.begin(), Message::kInfo.size, bytes.begin());
  return std::bit_cast<Message>(bytes);
}

/// A frame whose CRC was right. `payload` has all the message's fields and no more: what the sender
/// left off (MAVLink 2 drops trailing zeros) is zero again, and extension fields that are not ours
/// are left off.
struct Frame {
  std::uint8_t sequence = 0;
  std::uint8_t system_id = 0;
  std::uint8_t component_id = 0;
  std::uint32_t message_id = 0;
  std::vector<std::uint8_t> payload;
};

/// Without sequence and sender yet.
template <typename Message>
Frame packed(const Message& message) {
  return {.message_id = Message::kInfo.id, .payload = payload_of(message)};
}

/// What became of the bytes. Everything but `read` was dropped.
struct ReadCounts {
  std::uint64_t read = 0;
  std::uint64_t bad_crc = 0;
  std::uint64_t truncated = 0;  // the datagram ends too early, or MAVLink 1 with fields missing
  std::uint64_t oversized = 0;  // MAVLink 1 with a payload longer than its message
  std::uint64_t unknown = 0;    // not one of our messages, or an unknown incompatibility flag
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
