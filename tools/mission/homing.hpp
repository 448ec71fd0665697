// The battery, and the way home while it still reaches there. For tools/mission/ only. All by what
// is believed: the energy meter, the estimate and the map.
#pragma once

#include "tools/mission/mission_state.hpp"

namespace gnbv {

/// Asked after each tick: whether more is left than has to be kept. With PowerParameters::
/// return_home that is the energy of the shortest known way home, of landing there, and the
/// reserve; otherwise, and on the way home itself, that of landing where it is.
bool has_energy_to_go_on(const Mission& m);

/// The way home from the view just taken, through space known to be free when there is such a way,
/// else as it came. None for a mission that does not end at home.
std::vector<Exit> exits_here(const Mission& m);

/// Whether the view can be flown to and the vehicle come home from there; if so, the exits at all
/// corners of the way are kept. Always, when there is no battery or no way home to think of.
bool can_afford(Mission& m, const Decision& next);

/// Whether a mission that is over for this reason is still to come home: not one that has collided
/// or lost its course, and not one that is to be resumed.
bool ends_at_home(const Mission& m, Termination reason);

/// Flies home by the shortest way known and lands there; lands where it is when no more than that
/// is left. Notes how it went, and a collision as the mission's end. The energy of a landing is
/// that down to z = 0, which over a terrain below is too little.
void fly_home(Mission& m);

}  // namespace gnbv
