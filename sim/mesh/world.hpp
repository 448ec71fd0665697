// What is true. Only sim, sensors, bench and tools may see it; the planner never does.
#pragma once

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

struct World {
  TriangleMesh structure;
  bool has_ground = true;  // the plane z = 0, seen by the sensors and solid for the vehicle
};

}  // namespace gnbv
