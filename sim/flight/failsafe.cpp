#include "sim/flight/failsafe.hpp"

#include <array>
#include <optional>

namespace gnbv {
namespace {

/// Nothing for `disarm`, which is not a mode.
std::optional<NavState> mode_of(OffboardLossAction action) {
  constexpr std::array<std::optional<NavState>, 8> kModes = {
      NavState::position, NavState::altitude, NavState::stabilized, NavState::rtl,
      NavState::land,     NavState::hold,     NavState::terminate,  std::nullopt};
  return kModes.at(static_cast<std::size_t>(action));
}

}  // namespace

bool can_run(NavState mode, bool has_offboard_stream) {
  const bool needs_remote_control = mode < NavState::hold;
  if (mode == NavState::offboard) return has_offboard_stream;
  return !needs_remote_control && mode != NavState::mission;
}

bool prevents_arming(NavState mode) {
  return mode == NavState::rtl || mode == NavState::land || mode == NavState::descend ||
         mode == NavState::terminate;
}

bool has_offboard_stream(double offboard_silence_s, const CommanderParameters& parameters) {
  return offboard_silence_s < parameters.offboard_loss_s;
}

ModeChoice choose_mode(NavState intention, double offboard_silence_s,
                       const CommanderParameters& parameters) {
  const bool has_stream = has_offboard_stream(offboard_silence_s, parameters);
  if (can_run(intention, has_stream)) return {intention, false, false};
  if (intention != NavState::offboard) return {NavState::hold, true, false};
  const bool is_waiting =
      offboard_silence_s < parameters.offboard_loss_s + parameters.offboard_loss_hold_s;
  const std::optional<NavState> fallback =
      is_waiting ? NavState::hold : mode_of(parameters.offboard_loss_action);
  if (!fallback) return {NavState::hold, true, true};
  return {can_run(*fallback, has_stream) ? *fallback : NavState::hold, true, false};
}

}  // namespace gnbv
