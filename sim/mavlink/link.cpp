#include "sim/mavlink/link.hpp"

#include <algorithm>

#include "sim/mavlink/query_messages.hpp"

namespace gnbv::mavlink {
namespace {

constexpr std::uint8_t kEverybody = 0;

}  // namespace

bool is_for_us(std::uint8_t system, std::uint8_t component) {
  return (system == kSystem || system == kEverybody) &&
         (component == kComponent || component == kEverybody);
}

bool asks_for_something(const Frame& frame) {
  const auto is_ours = [&]<typename Message>() {
    if (frame.message_id != Message::kInfo.id) return false;
    const auto message = message_of<Message>(frame.payload);
    return is_for_us(message.target_system, message.target_component);
  };
  if (frame.message_id == SetMode::kInfo.id) {
    return is_for_us(message_of<SetMode>(frame.payload).target_system, kComponent);
  }
  return is_ours.operator()<CommandLong>() || is_ours.operator()<CommandInt>() ||
         is_ours.operator()<SetPositionTargetLocalNed>() ||
         is_ours.operator()<SetPositionTargetGlobalInt>() ||
         is_ours.operator()<SetAttitudeTarget>();
}

std::vector<Frame> Link::receive(std::span<const std::uint8_t> datagram, const Address& from,
                                 double now_s, bool is_armed) {
  ++counts_.datagrams;
  const bool is_foreign = client_.has_value() && *client_ != from;
  const bool is_held = is_for_good_ || is_armed || now_s - asked_s_ <= kClientSilence_s;
  if (is_foreign && is_held) {  // not even read: a flood from elsewhere costs little
    ++counts_.foreign_datagrams;
    return {};
  }
  std::vector<Frame> frames = read_frames(datagram, counts_.frames);
  if (frames.empty()) return {};
  const bool asks = std::ranges::any_of(frames, asks_for_something);
  if (is_foreign && !asks && now_s - heard_s_ <= kClientSilence_s) {
    ++counts_.foreign_datagrams;
    return {};
  }
  if (asks || client_ != from) asked_s_ = now_s;
  client_ = from;
  heard_s_ = now_s;
  counts_.accepted += frames.size();
  return frames;
}

void Link::count_oversized_datagram() {
  ++counts_.datagrams;
  ++counts_.oversized_datagrams;
}

}  // namespace gnbv::mavlink
