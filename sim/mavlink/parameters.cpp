#include "sim/mavlink/parameters.hpp"

#include <algorithm>
#include <bit>

namespace gnbv::mavlink {
namespace {

constexpr std::uint8_t kInt32 = 6;  // MAV_PARAM_TYPE
constexpr std::uint8_t kReal32 = 9;

std::uint8_t type_of(const Px4Parameter& parameter) {
  return parameter.value == nullptr ? kInt32 : kReal32;
}

}  // namespace

std::optional<ParamValue> parameter_at(const CommanderParameters& commander, int index) {
  if (index < 0 || index >= static_cast<int>(kPx4Parameters.size())) return std::nullopt;
  const Px4Parameter& parameter = kPx4Parameters[static_cast<std::size_t>(index)];
  const double value = px4_value(commander, parameter);
  ParamValue message{.param_value = parameter.value == nullptr
                                        ? std::bit_cast<float>(static_cast<std::int32_t>(value))
                                        : static_cast<float>(value),
                     .param_count = static_cast<std::uint16_t>(kPx4Parameters.size()),
                     .param_index = static_cast<std::uint16_t>(index),
                     .param_type = type_of(parameter)};
  std::ranges::copy(parameter.name, message.param_id.begin());
  return message;
}

std::optional<int> find_parameter(const ParameterId& id) {
  const auto* const found = find_px4_parameter(
      {id.begin(), static_cast<std::size_t>(std::ranges::find(id, '\0') - id.begin())});
  if (found == nullptr) return std::nullopt;
  return static_cast<int>(found - kPx4Parameters.data());
}

bool set_parameter(CommanderParameters& commander, int index, const ParamSet& message) {
  const Px4Parameter& parameter = kPx4Parameters[static_cast<std::size_t>(index)];
  if (message.param_type != type_of(parameter)) return false;
  const double value = parameter.value == nullptr ? std::bit_cast<std::int32_t>(message.param_value)
                                                  : static_cast<double>(message.param_value);
  return set_px4_value(commander, parameter, value);
}

}  // namespace gnbv::mavlink
