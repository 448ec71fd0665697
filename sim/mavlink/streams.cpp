#include "sim/mavlink/streams.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/mavlink/border.hpp"
#include "sim/mavlink/query_messages.hpp"
#include "sim/mavlink/telemetry.hpp"

namespace gnbv::mavlink {
namespace {

struct Said {
  std::uint32_t id;
  double default_hz;  // of PX4's onboard link (mavlink_main.cpp), or slower; 0: only when asked
  Packed (*pack)(const Quadrotor& vehicle, double battery_wh);
};

std::uint32_t time_boot_ms_of(const Quadrotor& vehicle) {
  return static_cast<std::uint32_t>(vehicle.tick() * (1000 / kTicksPerSecond));
}

constexpr std::array kSaid = {
    Said{Heartbeat::kInfo.id, 1.0,
         [](const Quadrotor& v, double) { return packed(heartbeat_of(v.px4())); }},
    Said{ExtendedSysState::kInfo.id, 5.0,
         [](const Quadrotor& v, double) { return packed(extended_sys_state_of(v.px4())); }},
    Said{Attitude::kInfo.id, 50.0,
         [](const Quadrotor& v, double) {
           return packed(attitude_of(v.estimate(), time_boot_ms_of(v)));
         }},
    Said{LocalPositionNed::kInfo.id, 30.0,
         [](const Quadrotor& v, double) {
           return packed(local_position_of(v.estimate(), time_boot_ms_of(v)));
         }},
    Said{BatteryStatus::kInfo.id, 0.5,
         [](const Quadrotor& v, double battery_wh) {
           return packed(battery_status_of(v.energy_wh(), battery_wh));
         }},
    Said{SysStatus::kInfo.id, 1.0,
         [](const Quadrotor& v, double battery_wh) {
           return packed(sys_status_of(v.px4(), v.energy_wh(), battery_wh));
         }},
    Said{AttitudeQuaternion::kInfo.id, 50.0,
         [](const Quadrotor& v, double) {
           return packed(attitude_quaternion_of(v.estimate(), time_boot_ms_of(v)));
         }},
    Said{GlobalPositionInt::kInfo.id, 30.0,
         [](const Quadrotor& v, double) {
           return packed(global_position_of(v.estimate(), time_boot_ms_of(v)));
         }},
    Said{GpsRawInt::kInfo.id, 1.0,
         [](const Quadrotor& v, double) {
           return packed(gps_raw_of(v.estimate(), time_boot_ms_of(v)));
         }},
    Said{VfrHud::kInfo.id, 10.0,
         [](const Quadrotor& v, double) {
           return packed(vfr_hud_of(v.estimate(), v.px4().attitude_setpoint().thrust));
         }},
    Said{HomePosition::kInfo.id, 0.5,
         [](const Quadrotor& v, double) {
           return packed(home_position_of(v.px4().home_world_m()));
         }},
    Said{GpsGlobalOrigin::kInfo.id, 0.0,
         [](const Quadrotor&, double) { return packed(global_origin()); }},
    Said{AutopilotVersion::kInfo.id, 0.0,
         [](const Quadrotor&, double) { return packed(autopilot_version()); }},
    Said{ProtocolVersion::kInfo.id, 0.0,
         [](const Quadrotor&, double) { return packed(ProtocolVersion{}); }}};

const Said* find(std::uint32_t id) {
  const auto* const found = std::ranges::find(kSaid, id, &Said::id);
  return found == kSaid.end() ? nullptr : found;
}

double default_interval_s(const Said& said) {
  return said.default_hz > 0.0 ? 1.0 / said.default_hz : 0.0;
}

}  // namespace

std::optional<Packed> said_of(std::uint32_t id, const Quadrotor& vehicle, double battery_wh) {
  const Said* const said = find(id);
  if (said == nullptr) return std::nullopt;
  return said->pack(vehicle, battery_wh);
}

Streams::Streams() {
  for (const Said& said : kSaid) streams_[said.id].interval_s = default_interval_s(said);
}

bool Streams::set_interval_us(std::uint32_t id, float interval_us) {
  const Said* const said = find(id);
  if (said == nullptr || !std::isfinite(interval_us)) return false;
  // due at once: the client sees its wish come true, and a slow stream does not hold up a fast one
  streams_[id] = {interval_us == 0.0F  ? default_interval_s(*said)
                  : interval_us < 0.0F ? 0.0
                                       : 1e-6 * static_cast<double>(interval_us),
                  0.0};
  return true;
}

std::optional<std::int32_t> Streams::interval_us(std::uint32_t id) const {
  const auto found = streams_.find(id);
  if (found == streams_.end()) return std::nullopt;
  if (found->second.interval_s == 0.0) return -1;
  return static_cast<std::int32_t>(std::min(std::round(1e6 * found->second.interval_s), 2e9));
}

std::vector<std::uint32_t> Streams::take_due(double now_s) {
  std::vector<std::uint32_t> due;
  for (const Said& said : kSaid) {
    Stream& stream = streams_[said.id];
    if (stream.interval_s == 0.0 || now_s < stream.due_s) continue;
    const bool is_late = now_s - stream.due_s >= stream.interval_s;
    stream.due_s = (is_late ? now_s : stream.due_s) + stream.interval_s;
    due.push_back(said.id);
  }
  return due;
}

}  // namespace gnbv::mavlink
