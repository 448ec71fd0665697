#include "sim/mavlink/frame.hpp"

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <iterator>

#include "sim/core/error.hpp"
#include "sim/mavlink/messages.hpp"

namespace gnbv::mavlink {
namespace {

template <typename... Messages>
constexpr std::array<MessageInfo, sizeof...(Messages)> infos_of() {
  return {Messages::kInfo...};
}

constexpr auto kMessages =
    infos_of<Heartbeat, SysStatus, Ping, SetMode, ParamRequestRead, ParamRequestList, ParamValue,
             ParamSet, GpsRawInt, Attitude, AttitudeQuaternion, LocalPositionNed, GlobalPositionInt,
             MissionItem, MissionRequest, MissionSetCurrent, MissionCurrent, MissionRequestList,
             MissionCount, MissionClearAll, MissionItemReached, MissionAck, GpsGlobalOrigin,
             MissionRequestInt, MissionItemInt, VfrHud, CommandInt, CommandLong, CommandAck,
             SetAttitudeTarget, SetPositionTargetLocalNed, SetPositionTargetGlobalInt, HighresImu,
             Timesync, BatteryStatus, AutopilotVersion, HomePosition, MessageInterval,
             ExtendedSysState, StatusText, CameraInformation, VideoStreamInformation,
             ProtocolVersion, Odometry>();

/// nullptr for a message that is not one of ours.
const MessageInfo* find_message(std::uint32_t id) {
  const auto* const found = std::ranges::find(kMessages, id, &MessageInfo::id);
  return found == kMessages.end() ? nullptr : found;
}

constexpr std::uint8_t kStart1 = 0xfe;
constexpr std::uint8_t kStart2 = 0xfd;
constexpr std::size_t kHeaderSize1 = 6;
constexpr std::size_t kHeaderSize2 = 10;
constexpr std::size_t kCrcSize = 2;
constexpr std::size_t kSignatureSize = 13;
constexpr std::uint8_t kSignedFlag = 0x01;

bool is_start(std::uint8_t byte) { return byte == kStart1 || byte == kStart2; }

/// Counts the frame that begins at `bytes`, appends it when it is good, and returns how many bytes
/// to pass over.
std::size_t read_frame(std::span<const std::uint8_t> bytes, ReadCounts& counts,
                       std::vector<Frame>& frames) {
  const bool is_version_1 = bytes[0] == kStart1;
  const std::size_t header_size = is_version_1 ? kHeaderSize1 : kHeaderSize2;
  if (bytes.size() < header_size) {
    ++counts.truncated;
    return 1;
  }
  const std::size_t payload_size = bytes[1];
  const std::uint8_t flags = is_version_1 ? 0 : bytes[2];  // of incompatibility
  const auto ids = bytes.subspan(is_version_1 ? 2 : 4);
  Frame frame{ids[0], ids[1], ids[2], ids[3], {}};
  if (!is_version_1) frame.message_id |= std::uint32_t{ids[4]} << 8 | std::uint32_t{ids[5]} << 16;
  const std::size_t crc_at = header_size + payload_size;
  const std::size_t frame_size =
      crc_at + kCrcSize + ((flags & kSignedFlag) != 0 ? kSignatureSize : 0);
  if (bytes.size() < frame_size) {
    ++counts.truncated;
    return 1;
  }
  const MessageInfo* const info = find_message(frame.message_id);
  // what costs least is asked first: no CRC of what is unknown or, in MAVLink 1, of a wrong length
  if (info == nullptr || (flags & ~kSignedFlag) != 0) {
    ++counts.unknown;
  } else if (is_version_1 && payload_size > info->base_size) {
    ++counts.oversized;
  } else if (is_version_1 && payload_size < info->base_size) {
    ++counts.truncated;
  } else if ((bytes[crc_at] | bytes[crc_at + 1] << 8) !=
             frame_crc(bytes.subspan(1, crc_at - 1), info->crc_extra)) {
    ++counts.bad_crc;
  } else {
    ++counts.read;
    const auto payload = bytes.subspan(header_size, payload_size);
    frame.payload.assign(payload.begin(), payload.end());
    frame.payload.resize(info->size, 0);
    frames.push_back(std::move(frame));
    return frame_size;
  }
  const bool ends_where_frames_do = frame_size == bytes.size() || is_start(bytes[frame_size]);
  return ends_where_frames_do ? frame_size : 1;
}

}  // namespace

std::uint16_t frame_crc(std::span<const std::uint8_t> bytes_after_start, std::uint8_t crc_extra) {
  boost::crc_optimal<16, 0x1021, 0xffff, 0, true, true> crc;
  crc.process_bytes(bytes_after_start.data(), bytes_after_start.size());
  crc.process_byte(crc_extra);
  return crc.checksum();
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
  std::vector<std::uint8_t> bytes = {kStart2, static_cast<std::uint8_t>(size), 0, 0};
  for (const std::uint8_t id : {frame.sequence, frame.system_id, frame.component_id}) {
    bytes.push_back(id);
  }
  const auto append = [&](std::uint32_t value, int count) {  // low byte first
    for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> 8 * i));
  };
  append(frame.message_id, 3);
  std::copy_n(frame.payload.begin(), size, std::back_inserter(bytes));
  append(frame_crc(std::span(bytes).subspan(1), info->crc_extra), 2);
  return bytes;
}

}  // namespace gnbv::mavlink
