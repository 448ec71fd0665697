#include "sim/mavlink/frame.hpp"

#include <array>

#include "sim/core/error.hpp"

namespace gnbv::mavlink {
namespace {

constexpr std::uint8_t kStart1 = 0xfe;
constexpr std::uint8_t kStart2 = 0xfd;
constexpr std::size_t kHeaderSize1 = 6;
constexpr std::size_t kHeaderSize2 = 10;
constexpr std::size_t kCrcSize = 2;
constexpr std::size_t kSignatureSize = 13;
constexpr std::uint8_t kSignedFlag = 0x01;

/// What eight bits of the reversed polynomial 0x8408 make of each byte.
constexpr std::array<std::uint16_t, 256> crc_table() {
  std::array<std::uint16_t, 256> table{};
  for (std::size_t byte = 0; byte < table.size(); ++byte) {
    auto crc = static_cast<std::uint16_t>(byte);
    for (int bit = 0; bit < 8; ++bit) {
      crc = static_cast<std::uint16_t>((crc >> 1) ^ ((crc & 1) != 0 ? 0x8408 : 0));
    }
    table[byte] = crc;
  }
  return table;
}
constexpr std::array<std::uint16_t, 256> kCrcTable = crc_table();

bool is_start(std::uint8_t byte) { return byte == kStart1 || byte == kStart2; }

/// A header as read, before anything about it is believed.
struct Header {
  bool is_version_1 = false;
  std::size_t header_size = 0;
  std::size_t payload_size = 0;
  std::size_t frame_size = 0;
  std::uint8_t incompatibility_flags = 0;
  Frame frame;
};

Header read_header(std::span<const std::uint8_t> bytes) {
  Header h;
  h.payload_size = bytes[1];
  h.is_version_1 = bytes[0] == kStart1;
  if (h.is_version_1) {
    h.header_size = kHeaderSize1;
    h.frame = {bytes[2], bytes[3], bytes[4], bytes[5], {}};
  } else {
    h.header_size = kHeaderSize2;
    h.incompatibility_flags = bytes[2];
    const std::uint32_t message_id =
        bytes[7] | std::uint32_t{bytes[8]} << 8 | std::uint32_t{bytes[9]} << 16;
    h.frame = {bytes[4], bytes[5], bytes[6], message_id, {}};
  }
  const bool is_signed = (h.incompatibility_flags & kSignedFlag) != 0;
  h.frame_size = h.header_size + h.payload_size + kCrcSize + (is_signed ? kSignatureSize : 0);
  return h;
}

/// Counts the frame that begins at `bytes`, appends it when it is good, and returns how many bytes
/// to pass over.
std::size_t read_frame(std::span<const std::uint8_t> bytes, ReadCounts& counts,
                       std::vector<Frame>& frames) {
  if (bytes.size() < (bytes[0] == kStart1 ? kHeaderSize1 : kHeaderSize2)) {
    ++counts.truncated;
    return 1;
  }
  Header h = read_header(bytes);
  if (bytes.size() < h.frame_size) {
    ++counts.truncated;
    return 1;
  }
  const MessageInfo* const info = find_message(h.frame.message_id);
  const std::size_t crc_at = h.header_size + h.payload_size;
  // what costs least is asked first: no CRC of what is unknown or, in MAVLink 1, of a wrong length
  if (info == nullptr || (h.incompatibility_flags & ~kSignedFlag) != 0) {
    ++counts.unknown;
  } else if (h.is_version_1 && h.payload_size > info->base_size) {
    ++counts.oversized;
  } else if (h.is_version_1 && h.payload_size < info->base_size) {
    ++counts.truncated;
  } else if ((bytes[crc_at] | bytes[crc_at + 1] << 8) !=
             frame_crc(bytes.subspan(1, crc_at - 1), info->crc_extra)) {
    ++counts.bad_crc;
  } else {
    ++counts.read;
    const auto payload = bytes.subspan(h.header_size, h.payload_size);
    h.frame.payload.assign(payload.begin(), payload.end());
    h.frame.payload.resize(info->size, 0);  // fields left off are 0, those of a later day unknown
    frames.push_back(std::move(h.frame));
    return h.frame_size;
  }
  const bool ends_where_frames_do = h.frame_size == bytes.size() || is_start(bytes[h.frame_size]);
  return ends_where_frames_do ? h.frame_size : 1;
}

}  // namespace

std::uint16_t frame_crc(std::span<const std::uint8_t> bytes_after_start, std::uint8_t crc_extra) {
  std::uint16_t crc = 0xffff;
  const auto accumulate = [&crc](std::uint8_t byte) {
    crc = static_cast<std::uint16_t>(crc >> 8 ^ kCrcTable[(crc ^ byte) & 0xff]);
  };
  for (const std::uint8_t byte : bytes_after_start) accumulate(byte);
  accumulate(crc_extra);
  return crc;
}

std::vector<Frame> read_frames(std::span<const std::uint8_t> datagram, ReadCounts& counts) {
  std::vector<Frame> frames;
  while (!datagram.empty()) {
    datagram =
        datagram.subspan(is_start(datagram.front()) ? read_frame(datagram, counts, frames) : 1);
  }
  return frames;
}

std::vector<std::uint8_t> write_frame(const Frame& frame) {
  const MessageInfo* const info = find_message(frame.message_id);
  GNBV_CHECK(info != nullptr && frame.payload.size() == info->size, "message {} with {} bytes",
             frame.message_id, frame.payload.size());
  std::size_t size = frame.payload.size();
  while (size > 1 && frame.payload[size - 1] == 0) --size;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(kHeaderSize2 + size + kCrcSize);
  detail::write(
      bytes, std::array{kStart2, static_cast<std::uint8_t>(size), std::uint8_t{0}, std::uint8_t{0},
                        frame.sequence, frame.system_id, frame.component_id});
  for (const int shift : {0, 8, 16}) {
    bytes.push_back(static_cast<std::uint8_t>(frame.message_id >> shift));
  }
  for (const std::uint8_t byte : std::span(frame.payload).first(size)) bytes.push_back(byte);
  detail::write(bytes, frame_crc(std::span(bytes).subspan(1), info->crc_extra));
  return bytes;
}

}  // namespace gnbv::mavlink
