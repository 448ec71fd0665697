// What the vehicle says of itself, message by message: on its own at rates that the client may
// change, or once when asked.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "sim/flight/px4.hpp"
#include "sim/mavlink/aboard.hpp"
#include "sim/mavlink/messages.hpp"

namespace gnbv::mavlink {

/// What the messages are made of.
struct VehicleReport {
  VehicleState estimate = {};
  std::uint32_t time_boot_ms = 0;
  // only of Heartbeat, ExtendedSysState, SysStatus, GlobalPositionInt, VfrHud, HomePosition and
  // MissionCurrent
  const Px4* px4 = nullptr;
  double energy_wh = 0.0;   // used
  double battery_wh = 0.0;  // as PowerParameters has it
  double power_w = 0.0;
  Vec3 origin_world_m = Vec3::Zero();                       // of local NED
  Vec3 specific_force_body_m_s2 = Vec3(0.0, 0.0, 9.80665);  // what an accelerometer feels
  const VideoStream* video = nullptr;                       // only of the camera's messages
};

/// Message `id` about the vehicle as it is, from the component whose message it is; nothing for one
/// that it does not say.
std::optional<Frame> said_of(std::uint32_t id, const VehicleReport& report);
/// Whether it is the camera's.
bool is_cameras(std::uint32_t id);
/// Of the component kCamera.
Frame camera_heartbeat();

/// One message for up to 50 characters, and chunks with the same `id` (not 0) for more.
std::vector<StatusText> status_texts_of(const gnbv::StatusText& said, std::uint16_t id);

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
