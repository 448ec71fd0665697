// The mission protocol (mavlink.io/en/services/mission.html), vehicle's side of one link, and what
// items mean.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "sim/mavlink/aboard.hpp"

namespace gnbv::mavlink {

/// MAV_MISSION_RESULT.
enum class MissionResult : std::uint8_t {
  accepted = 0,
  error = 1,
  unsupported_frame = 2,
  unsupported = 3,
  no_space = 4,
  invalid_param1 = 6,  // and so on up to 7
  invalid_sequence = 13,
  cancelled = 15
};

/// More are refused (NO_SPACE).
constexpr std::size_t kMissionItemsMax = 10'000;

/// What an item asks for, or why it is not taken. Known are NAV_WAYPOINT, LOITER_UNLIM,
/// LOITER_TIME, RETURN_TO_LAUNCH, LAND, TAKEOFF, DELAY and DO_CHANGE_SPEED; orders to cameras and
/// gimbals, of which there are none, do nothing. Places are on the globe, as border.hpp has it.
std::variant<MissionStep, MissionResult> step_of(const MissionItemInt& item);

class MissionExchange {
 public:
  /// Who is answered, and what about.
  struct Context {
    Aboard& aboard;
    Px4& px4;
    std::uint8_t system_id = 0, component_id = 0;
    double now_s = 0.0;
  };
  using Answer = std::vector<Frame>;

  /// An upload of so many items begins. The mission changes when all of them have come and been
  /// found good, and not before. Meanwhile nobody else of this link uploads.
  Answer receive(const MissionCount& asked, const Context& context);
  /// The last item again is accepted again: the client did not hear that it was.
  Answer receive(const MissionItemInt& item, const Context& context);
  Answer receive(const MissionItem& item, const Context& context);
  Answer receive(const MissionRequestList& asked, const Context& context) const;
  Answer receive(const MissionRequestInt& asked, const Context& context) const;
  /// As PX4, who asks in floats is answered by MISSION_ITEM.
  Answer receive(const MissionRequest& asked, const Context& context) const;
  Answer receive(const MissionClearAll& asked, const Context& context);
  Answer receive(const MissionAck& told, const Context& context);
  /// The item that is waited for is asked for again after a while, by turns in integers and in
  /// floats, and the upload given up after 5 s without one.
  Answer remind(double now_s);

 private:
  struct Upload {
    std::uint8_t system_id, component_id;
    std::size_t count;
    std::vector<MissionItemInt> items = {};
    std::vector<MissionStep> steps = {};
    double heard_s, asked_s;
    bool asks_in_floats = false;
  };
  bool is_anothers_turn(const Context& context) const;
  Answer request_next(double now_s);

  std::optional<Upload> upload_;
};

}  // namespace gnbv::mavlink
