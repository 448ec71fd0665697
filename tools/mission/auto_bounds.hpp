// `--bounds auto`: a workspace and a start for a structure that nobody wrote a scenario for.
#pragma once

#include "scenarios/scenario.hpp"

namespace gnbv {

/// Room to fly between structure and workspace: five eighths of the cameras' longest range, 5 m for
/// the paper's 8 m (its aircraft has 5 m at the wing tips, its plant 8 to 13 m), but at least the
/// collision radius and 2 m more, so that the vehicle can pass on every side.
double flight_margin_m(const Scenario& scenario);

/// The scenario with its workspace laid around the structure, wherever that is, and its start
/// moved there. The workspace is the structure's box grown by the margin to the sides and above,
/// its faces on multiples of the map's resolution. Its floor is the ground, z = 0; the structure's
/// lowest point where it sinks below; and the margin below its lowest point where it floats higher
/// than that, or where there is no ground. The top is high enough to fly at z_min_m, whatever the
/// structure's height. The start is the middle of the workspace's south face, looking north at the
/// structure, as high above the floor as the scenario's own, within the navigation box; its jitter
/// stays. Throws BadInput with all faults of the resulting scenario (problems()): a map too large,
/// or too far from the origin for OctoMap's keys.
Scenario with_bounds_around(const Scenario& scenario, const Box3& structure_m);

}  // namespace gnbv
