#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "sim/mavlink/aboard.hpp"

namespace gnbv::mavlink {
namespace {

struct InertParameter {
  std::string_view name;
  double value;  // PX4's default, or that of its simulations
  double min;
  double max;
  bool is_whole = true;
};

constexpr double kAny = 2e9;
constexpr auto kInert = std::to_array<InertParameter>({
    {"CAL_ACC0_ID", 1310988, 0, kAny},
    {"CAL_GYRO0_ID", 1310988, 0, kAny},
    {"CAL_MAG0_ID", 197388, 0, kAny},
    {"CBRK_SUPPLY_CHK", 894281, 0, 894281},
    {"COM_ARM_WO_GPS", 1, 0, 2},
    {"COM_DL_LOSS_T", 10, 5, 300},
    {"COM_FLTMODE1", -1, -1, 20},
    {"COM_LOW_BAT_ACT", 0, 0, 3},
    {"COM_RCL_EXCEPT", 0, 0, 31},
    {"COM_RC_IN_MODE", 1, 0, 4},
    {"COM_RC_LOSS_T", 0.5, 0, 35, false},
    {"COM_RC_OVERRIDE", 1, 0, 3},
    {"COM_RC_STICK_OV", 30, 5, 80, false},
    {"GF_ACTION", 2, 0, 5},
    {"GF_MAX_HOR_DIST", 0, 0, 10000, false},
    {"GF_MAX_VER_DIST", 0, 0, 10000, false},
    {"MAV_TYPE", 2, 2, 2},
    {"NAV_DLL_ACT", 0, 0, 6},
    {"NAV_RCL_ACT", 2, 1, 6},
    {"RC_CHAN_CNT", 0, 0, 18},
    {"SYS_AUTOCONFIG", 0, 0, 2},
    {"SYS_AUTOSTART", 10016, 10016, 10016},
    {"SYS_HITL", 0, 0, 0},
});

constexpr std::string_view kSystemId = "MAV_SYS_ID";  // the last; the scenario says it
constexpr std::size_t kFollowed = kPx4Parameters.size();
constexpr std::size_t kCount = kFollowed + kInert.size() + 1;

struct Known {
  std::string_view name;
  double value = 0.0;
  bool is_whole = false;
};

Known known(const Aboard& aboard, const CommanderParameters& commander, std::size_t number) {
  if (number < kFollowed) {
    const Px4Parameter& p = kPx4Parameters[number];
    return {p.name, px4_value(commander, p), p.value == nullptr};
  }
  if (number == kCount - 1) return {kSystemId, static_cast<double>(aboard.system_id), true};
  const InertParameter& p = kInert[number - kFollowed];
  const auto kept = aboard.kept.find(number);
  return {p.name, kept == aboard.kept.end() ? p.value : kept->second, p.is_whole};
}

/// MAV_PARAM_TYPE: INT32 or REAL32.
std::uint8_t type_of(bool is_whole) { return is_whole ? 6 : 9; }

}  // namespace

std::size_t parameter_count() { return kCount; }

std::optional<std::size_t> find_parameter(std::string_view name) {
  if (const Px4Parameter* const found = find_px4_parameter(name))
    return static_cast<std::size_t>(found - kPx4Parameters.data());
  if (name == kSystemId) return kCount - 1;
  const auto* const inert = std::ranges::find(kInert, name, &InertParameter::name);
  if (inert == kInert.end()) return std::nullopt;
  return kFollowed + static_cast<std::size_t>(inert - kInert.begin());
}

ParamValue value_of(const Aboard& aboard, const CommanderParameters& commander,
                    std::size_t number) {
  const Known p = known(aboard, commander, number);
  ParamValue message{.param_value = p.is_whole
                                        ? std::bit_cast<float>(static_cast<std::int32_t>(p.value))
                                        : static_cast<float>(p.value),
                     .param_count = static_cast<std::uint16_t>(kCount),
                     .param_index = static_cast<std::uint16_t>(number),
                     .param_type = type_of(p.is_whole)};
  std::ranges::copy(p.name, message.param_id.begin());
  return message;
}

bool set_parameter(Aboard& aboard, CommanderParameters& commander, std::size_t number,
                   const ParamSet& asked) {
  const Known p = known(aboard, commander, number);
  if (asked.param_type != type_of(p.is_whole)) return false;
  const double value = p.is_whole ? std::bit_cast<std::int32_t>(asked.param_value)
                                  : static_cast<double>(asked.param_value);
  if (number < kFollowed) return set_px4_value(commander, kPx4Parameters[number], value);
  if (number == kCount - 1) return value == p.value;
  const InertParameter& inert = kInert[number - kFollowed];
  if (!(value >= inert.min && value <= inert.max)) return false;
  aboard.kept[number] = value;
  return true;
}

}  // namespace gnbv::mavlink
