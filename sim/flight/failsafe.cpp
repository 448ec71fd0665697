#include "sim/flight/failsafe.hpp"

#include <optional>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// Nothing for `disarm`, which is not a mode.
std::optional<NavState> mode_of(OffboardLossAction action) {
  switch (action) {
    case OffboardLossAction::position:
      return NavState::position;
    case OffboardLossAction::altitude:
      return NavState::altitude;
    case OffboardLossAction::stabilized:
      return NavState::stabilized;
    case OffboardLossAction::rtl:
      return NavState::rtl;
    case OffboardLossAction::land:
      return NavState::land;
    case OffboardLossAction::hold:
      return NavState::hold;
    case OffboardLossAction::terminate:
      return NavState::terminate;
    case OffboardLossAction::disarm:
      return std::nullopt;
  }
  throw BrokenInvariant("offboard loss action outside its enumeration");
}

}  // namespace

bool can_run(NavState mode, bool has_offboard_stream) {
  switch (mode) {
    case NavState::manual:
    case NavState::stabilized:
    case NavState::altitude:
    case NavState::position:
    case NavState::mission:
      return false;
    case NavState::hold:
    case NavState::rtl:
    case NavState::takeoff:
    case NavState::land:
    case NavState::descend:
    case NavState::terminate:
      return true;
    case NavState::offboard:
      return has_offboard_stream;
  }
  throw BrokenInvariant("navigation state outside its enumeration");
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
