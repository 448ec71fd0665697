#include "sim/mavlink/messages.hpp"

#include <algorithm>

namespace gnbv::mavlink {
namespace {

constexpr std::array kMessages = {Heartbeat::kInfo,
                                  SetMode::kInfo,
                                  Attitude::kInfo,
                                  LocalPositionNed::kInfo,
                                  CommandLong::kInfo,
                                  CommandAck::kInfo,
                                  SetPositionTargetLocalNed::kInfo,
                                  BatteryStatus::kInfo,
                                  ExtendedSysState::kInfo,
                                  StatusText::kInfo};

}  // namespace

const MessageInfo* find_message(std::uint32_t id) {
  const auto* const found = std::ranges::find(kMessages, id, &MessageInfo::id);
  return found == kMessages.end() ? nullptr : found;
}

}  // namespace gnbv::mavlink
