// A vehicle that is where it is told to be, like the floating sensor of the released simulation.
#pragma once

#include <memory>

#include "sim/flight/flight.hpp"

namespace gnbv {

/// Level; takes position and yaw from the setpoint at once, integrates velocity and yaw rate where
/// these are not given, keeps what is not commanded. It has no body: it never collides. It knows
/// where it is. Its energy is the quadrotor's hover power times the time.
std::unique_ptr<Flight> make_ideal_flight(const VehicleConfig& config, const ViewPose& start);

}  // namespace gnbv
