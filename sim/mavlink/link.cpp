#include "sim/mavlink/link.hpp"

#include <algorithm>

namespace gnbv::mavlink {

ReplayFilter::Sender& ReplayFilter::sender_of(const Frame& frame, double now_s) {
  const auto known = std::ranges::find_if(senders_, [&](const Sender& s) {
    return s.system_id == frame.system_id && s.component_id == frame.component_id;
  });
  if (known != senders_.end() && now_s - known->accepted_last_s <= kRestart_s) return *known;
  const Sender fresh{.system_id = frame.system_id, .component_id = frame.component_id};
  if (known != senders_.end()) return *known = fresh;
  if (senders_.size() < kSendersMax) return senders_.emplace_back(fresh);
  return *std::ranges::min_element(senders_, {}, &Sender::accepted_last_s) = fresh;
}

bool ReplayFilter::accept(const Frame& frame, double now_s) {
  Sender& sender = sender_of(frame, now_s);
  std::uint64_t& accepted_as = sender.accepted_as[frame.sequence];
  if (accepted_as != 0 && sender.accepted_count - accepted_as < kWindow) return false;
  accepted_as = ++sender.accepted_count;
  sender.accepted_last_s = now_s;
  return true;
}

std::vector<Frame> Link::receive(std::span<const std::uint8_t> datagram, const Address& from,
                                 double now_s) {
  ++counts_.datagrams;
  const bool is_taken = client_.has_value() && now_s - client_heard_s_ <= kClientSilence_s;
  if (is_taken && *client_ != from) {
    ++counts_.foreign_datagrams;
    return {};
  }
  std::vector<Frame> frames = read_frames(datagram, counts_.frames);
  if (!frames.empty() && client_ != from) {
    client_ = from;
    replays_ = {};
  }
  const std::size_t read = frames.size();
  std::erase_if(frames, [&](const Frame& frame) { return !replays_.accept(frame, now_s); });
  counts_.replayed += read - frames.size();
  counts_.accepted += frames.size();
  if (!frames.empty()) client_heard_s_ = now_s;
  return frames;
}

void Link::count_oversized_datagram() {
  ++counts_.datagrams;
  ++counts_.oversized_datagrams;
}

}  // namespace gnbv::mavlink
