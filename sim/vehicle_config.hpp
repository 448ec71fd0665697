// The vehicle by name and the parameters of its rigid body, rotors and autopilot.
#pragma once

#include "sim/core/pose.hpp"

namespace gnbv {

enum class VehicleKind { quadrotor, ideal };

struct VehicleConfig {
  VehicleKind kind = VehicleKind::quadrotor;
};

}  // namespace gnbv
