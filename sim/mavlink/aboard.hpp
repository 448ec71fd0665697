// What all links of one vehicle share, and the parameters that they read and set.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/flight/px4.hpp"
#include "sim/mavlink/messages.hpp"

namespace gnbv::mavlink {

/// What a camera sends as RTP with H.264.
struct VideoStream {
  std::string camera;
  int width_px = 0, height_px = 0;
  double rate_hz = 0.0, fov_x_deg = 0.0;
  std::uint16_t port = 0;  // where the client waits for it
};

struct Aboard {
  std::uint8_t system_id = 1;                // MAV_SYS_ID
  double battery_wh = 0.0;                   // as PowerParameters has it
  Vec3 origin_world_m = Vec3::Zero();        // of local NED
  std::vector<MissionItemInt> mission = {};  // as it was uploaded
  std::map<std::size_t, double> kept = {};   // values of inert parameters, by their number
  std::vector<std::size_t> were_set = {};    // parameters, since news were taken
  bool was_armed = false;                    // when news were taken last
  std::optional<VideoStream> video = {};     // with it there is a camera, component kCamera
};

/// By number: PX4's that the vehicle follows (kPx4Parameters), then inert ones: of remote control,
/// data link, fence and sensors, which clients read or set before they fly. Those keep what they
/// are set to, and nothing follows them.
std::size_t parameter_count();
/// Nothing for another name.
std::optional<std::size_t> find_parameter(std::string_view name);
ParamValue value_of(const Aboard& aboard, const CommanderParameters& commander, std::size_t number);
/// Whether type and value fit; if so, it has it.
bool set_parameter(Aboard& aboard, CommanderParameters& commander, std::size_t number,
                   const ParamSet& asked);

}  // namespace gnbv::mavlink
