#include "sim/flight/failsafe.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr std::array<NavState, 8> kFallbacks = {
    NavState::position, NavState::altitude, NavState::stabilized, NavState::hold,
    NavState::rtl,      NavState::land,     NavState::descend,    NavState::terminate};

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

bool can_run(NavState mode, const Health& health) {
  switch (mode) {
    case NavState::manual:
      return health.has_remote_control;
    case NavState::stabilized:
      return health.has_remote_control && health.has_attitude;
    case NavState::altitude:
      return health.has_remote_control && health.has_attitude && health.has_altitude;
    case NavState::position:
      return health.has_remote_control && health.has_attitude && health.has_position;
    case NavState::mission:
      return health.has_mission && health.has_attitude && health.has_position;
    case NavState::hold:
    case NavState::rtl:
    case NavState::takeoff:
    case NavState::land:
      return health.has_attitude && health.has_position;
    case NavState::offboard:
      return health.has_offboard_stream && health.has_attitude && health.has_position;
    case NavState::descend:
      return health.has_attitude;
    case NavState::terminate:
      return true;
  }
  throw BrokenInvariant("navigation state outside its enumeration");
}

bool prevents_arming(NavState mode) {
  return mode == NavState::rtl || mode == NavState::land || mode == NavState::descend ||
         mode == NavState::terminate;
}

NavState feasible(NavState mode, const Health& health) {
  auto candidate = std::find(kFallbacks.begin(), kFallbacks.end(), mode);
  if (candidate == kFallbacks.end()) {
    candidate = std::find(kFallbacks.begin(), kFallbacks.end(), NavState::hold);
  }
  return *std::find_if(candidate, kFallbacks.end(),
                       [&](NavState next) { return can_run(next, health); });  // terminate can
}

ModeChoice choose_mode(NavState intention, const Health& health, double offboard_silence_s,
                       const CommanderParameters& parameters) {
  if (can_run(intention, health)) return {intention, false, false};
  if (intention != NavState::offboard) return {feasible(intention, health), true, false};
  const bool is_waiting =
      offboard_silence_s < parameters.offboard_loss_s + parameters.offboard_loss_hold_s;
  const std::optional<NavState> fallback =
      is_waiting ? NavState::hold : mode_of(parameters.offboard_loss_action);
  if (!fallback) return {NavState::hold, true, true};
  return {feasible(*fallback, health), true, false};
}

}  // namespace gnbv
