#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scenarios/reader.hpp"
#include "scenarios/values.hpp"

namespace gnbv {
namespace {

struct RemovedKey {
  std::string_view path;
  std::string_view was;  // its default, or the PX4 parameter whose value in the preset it was
};
constexpr std::array kRemoved = std::to_array<RemovedKey>({
    {"planner.tour.visibility", "splats"},
    {"planner.tour.search", "neighbourhood"},
    {"planner.tour.success", "learned"},
    {"planner.tour.recasts", "80"},
    {"planner.tour.items_max", "12000"},
    {"planner.tour.end_share", "0.003"},
    {"vehicle.autopilot.commander.offboard_loss_hold_s", "COM_FAIL_ACT_T"},
    {"vehicle.autopilot.commander.offboard_loss_action", "COM_OBL_RC_ACT"},
    {"vehicle.autopilot.commander.disarm_after_landing_s", "COM_DISARM_LAND"},
    {"vehicle.autopilot.commander.disarm_never_flown_s", "COM_DISARM_PRFLT"},
    {"vehicle.autopilot.commander.spool_up_s", "COM_SPOOLUP_TIME"},
    {"vehicle.autopilot.commander.takeoff_ramp_s", "MPC_TKO_RAMP_T"},
    {"vehicle.autopilot.commander.takeoff_altitude_m", "MIS_TAKEOFF_ALT"},
    {"vehicle.autopilot.commander.takeoff_speed_m_s", "MPC_TKO_SPEED"},
    {"vehicle.autopilot.commander.tilt_max_on_ground_deg", "MPC_TILTMAX_LND"},
    {"vehicle.autopilot.commander.land_detection_s", "LNDMC_TRIG_TIME"},
    {"vehicle.autopilot.commander.land_speed_vertical_max_m_s", "LNDMC_Z_VEL_MAX"},
    {"vehicle.autopilot.commander.land_speed_horizontal_max_m_s", "LNDMC_XY_VEL_MAX"},
    {"vehicle.autopilot.commander.land_rotation_max_deg_s", "LNDMC_ROT_MAX"},
    {"vehicle.autopilot.commander.cruise_speed_m_s", "MPC_XY_CRUISE"},
    {"vehicle.autopilot.commander.climb_speed_m_s", "MPC_Z_V_AUTO_UP"},
    {"vehicle.autopilot.commander.descent_speed_m_s", "MPC_Z_V_AUTO_DN"},
    {"vehicle.autopilot.commander.acceleration_m_s2", "MPC_ACC_HOR"},
    {"vehicle.autopilot.commander.acceleration_up_m_s2", "MPC_ACC_UP_MAX"},
    {"vehicle.autopilot.commander.acceleration_down_m_s2", "MPC_ACC_DOWN_MAX"},
    {"vehicle.autopilot.commander.jerk_m_s3", "MPC_JERK_AUTO"},
    {"vehicle.autopilot.commander.path_error_max_m", "MPC_XY_ERR_MAX"},
    {"vehicle.autopilot.commander.land_speed_m_s", "MPC_LAND_SPEED"},
    {"vehicle.autopilot.commander.land_slow_from_m", "MPC_LAND_ALT1"},
    {"vehicle.autopilot.commander.land_slow_below_m", "MPC_LAND_ALT2"},
    {"vehicle.autopilot.commander.return_altitude_m", "RTL_RETURN_ALT"},
    {"vehicle.autopilot.commander.return_distance_min_m", "RTL_MIN_DIST"},
});

/// As version 0.1 wrote it.
std::string text_of(const CommanderParameters& commander, const Px4Parameter& parameter) {
  constexpr std::array<std::string_view, 8> kActions = {
      "position", "altitude", "stabilized", "rtl", "land", "hold", "terminate", "disarm"};
  if (parameter.value == nullptr) {
    return std::string(kActions[static_cast<std::size_t>(commander.offboard_loss_action)]);
  }
  const double value = commander.*parameter.value;
  return fmt::format("{}", parameter.is_angle ? degrees_of(value) : value);
}

}  // namespace

bool holds_removed_keys(std::string_view path) {
  return std::ranges::any_of(kRemoved,
                             [&](const RemovedKey& key) { return is_at_or_below(key.path, path); });
}

std::optional<std::string> former_default(std::string_view path, const Scenario& scenario) {
  const auto* const removed = std::ranges::find(kRemoved, path, &RemovedKey::path);
  if (removed == kRemoved.end()) return std::nullopt;
  const Px4Parameter* const parameter = find_px4_parameter(removed->was);
  return parameter == nullptr ? std::string(removed->was)
                              : text_of(scenario.vehicle.autopilot.commander, *parameter);
}

}  // namespace gnbv
