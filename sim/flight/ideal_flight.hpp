// A vehicle that is where it is told to be, like the floating sensor of the released simulation.
#pragma once

#include <memory>

#include "sim/flight/flight.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

/// Level; takes position and yaw from the setpoint at once, integrates velocity and yaw rate where
/// these are not given, keeps what is not commanded. It has no body: it never collides. It knows
/// where it is. Its energy is the quadrotor's hover power times the time. It lands on the highest
/// terrain at its x and y, else on the plane ground, whatever else is in between.
std::unique_ptr<Flight> make_ideal_flight(const VehicleConfig& config, const World& world,
                                          const ViewPose& start);

}  // namespace gnbv
