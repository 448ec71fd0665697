// The rigid vehicle without an autopilot, or with the bare cascade of one.
#pragma once

#include "sim/flight/cascade.hpp"
#include "sim/flight/vehicle.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

inline World empty_world() {
  World world;
  world.has_ground = false;
  return world;
}

inline RotorSpeeds all(double speed_rad_s) {
  RotorSpeeds speeds{};
  speeds.fill(speed_rad_s);
  return speeds;
}

/// Advances so many ticks with references that hold.
inline void step(RigidVehicle& vehicle, const RotorSpeeds& reference_rad_s,
                 std::int64_t ticks = 1) {
  for (std::int64_t i = 0; i < ticks; ++i)
    vehicle.step([&](const Vec3&) { return reference_rad_s; });
}

inline bool has_collided(const RigidVehicle& vehicle) {
  return vehicle.has_touched_structure() || vehicle.has_touched_ground();
}

}  // namespace gnbv
