#include "sim/mavlink/parameters.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>

namespace gnbv::mavlink {
namespace {

constexpr std::uint8_t kInt32 = 6;  // MAV_PARAM_TYPE
constexpr std::uint8_t kReal32 = 9;

/// A client may set what has a range (PX4's documented one); the rest is the scenario's.
struct Parameter {
  std::string_view id;
  double CommanderParameters::*value;
  double min = 0.0;
  double max = -1.0;
};

using C = CommanderParameters;
constexpr std::array kNumbers = {
    Parameter{"COM_DISARM_LAND", &C::disarm_after_landing_s, 0.0, 20.0},
    Parameter{"COM_DISARM_PRFLT", &C::disarm_never_flown_s, 0.0, 1000.0},
    Parameter{"COM_OF_LOSS_T", &C::offboard_loss_s, 0.1, 60.0},
    Parameter{"COM_SPOOLUP_TIME", &C::spool_up_s},
    Parameter{"LNDMC_TRIG_TIME", &C::land_detection_s},
    Parameter{"LNDMC_XY_VEL_MAX", &C::land_speed_horizontal_max_m_s},
    Parameter{"LNDMC_Z_VEL_MAX", &C::land_speed_vertical_max_m_s},
    Parameter{"MIS_TAKEOFF_ALT", &C::takeoff_altitude_m, 0.0, 100.0},
    Parameter{"MPC_ACC_DOWN_MAX", &C::acceleration_down_m_s2, 2.0, 15.0},
    Parameter{"MPC_ACC_HOR", &C::acceleration_m_s2, 2.0, 15.0},
    Parameter{"MPC_ACC_UP_MAX", &C::acceleration_up_m_s2, 2.0, 15.0},
    Parameter{"MPC_JERK_AUTO", &C::jerk_m_s3, 1.0, 80.0},
    Parameter{"MPC_LAND_ALT1", &C::land_slow_from_m},
    Parameter{"MPC_LAND_ALT2", &C::land_slow_below_m},
    Parameter{"MPC_LAND_SPEED", &C::land_speed_m_s, 0.6, 10.0},
    Parameter{"MPC_TKO_RAMP_T", &C::takeoff_ramp_s},
    Parameter{"MPC_TKO_SPEED", &C::takeoff_speed_m_s, 1.0, 5.0},
    Parameter{"MPC_XY_CRUISE", &C::cruise_speed_m_s, 3.0, 20.0},
    Parameter{"MPC_XY_ERR_MAX", &C::path_error_max_m},
    Parameter{"MPC_Z_V_AUTO_DN", &C::descent_speed_m_s, 0.5, 4.0},
    Parameter{"MPC_Z_V_AUTO_UP", &C::climb_speed_m_s, 0.5, 8.0},
    Parameter{"RTL_MIN_DIST", &C::return_distance_min_m, 0.5, 100.0},
    Parameter{"RTL_RETURN_ALT", &C::return_altitude_m, 0.0, 1000.0}};
/// The one that is no number comes behind them.
constexpr std::string_view kLossAction = "COM_OBL_RC_ACT";
constexpr int kLossActionIndex = static_cast<int>(kNumbers.size());

ParameterId id_of(std::string_view name) {
  ParameterId id{};
  std::ranges::copy(name, id.begin());
  return id;
}

}  // namespace

std::uint16_t parameter_count() { return static_cast<std::uint16_t>(kNumbers.size() + 1); }

std::optional<ParamValue> parameter_at(const CommanderParameters& commander, int index) {
  if (index < 0 || index > kLossActionIndex) return std::nullopt;
  ParamValue value{.param_count = parameter_count(),
                   .param_index = static_cast<std::uint16_t>(index)};
  if (index == kLossActionIndex) {
    value.param_value =
        std::bit_cast<float>(static_cast<std::int32_t>(commander.offboard_loss_action));
    value.param_id = id_of(kLossAction);
    value.param_type = kInt32;
    return value;
  }
  const Parameter& parameter = kNumbers[static_cast<std::size_t>(index)];
  value.param_value = static_cast<float>(commander.*parameter.value);
  value.param_id = id_of(parameter.id);
  value.param_type = kReal32;
  return value;
}

std::optional<int> find_parameter(const ParameterId& id) {
  const std::string_view name(id.begin(), std::ranges::find(id, '\0'));
  if (name == kLossAction) return kLossActionIndex;
  const auto* const found = std::ranges::find(kNumbers, name, &Parameter::id);
  if (found == kNumbers.end()) return std::nullopt;
  return static_cast<int>(found - kNumbers.begin());
}

bool set_parameter(CommanderParameters& commander, int index, const ParamSet& message) {
  if (index == kLossActionIndex) {
    const auto action = std::bit_cast<std::int32_t>(message.param_value);
    const bool is_good = message.param_type == kInt32 && action >= 0 &&
                         action <= static_cast<std::int32_t>(OffboardLossAction::disarm);
    if (is_good) commander.offboard_loss_action = static_cast<OffboardLossAction>(action);
    return is_good;
  }
  const Parameter& parameter = kNumbers[static_cast<std::size_t>(index)];
  const double value = message.param_value;
  const bool is_good = message.param_type == kReal32 && value >= parameter.min &&
                       value <= parameter.max;  // no for NaN
  if (is_good) commander.*parameter.value = value;
  return is_good;
}

}  // namespace gnbv::mavlink
