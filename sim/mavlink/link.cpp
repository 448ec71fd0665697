#include "sim/mavlink/link.hpp"

#include <algorithm>

namespace gnbv::mavlink {

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
  const bool asks = std::ranges::any_of(frames, [this](const Frame& frame) {
    return handle_if_order(frame, system_id_, [](const auto& /*order*/) {});
  });
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

}  // namespace gnbv::mavlink
