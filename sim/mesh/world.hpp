// What is true. Only sim, sensors, bench and tools may see it; the planner never does.
#pragma once

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// Everything here is seen by the sensors and solid for the vehicle; the structure alone is scored.
struct World {
  TriangleMesh structure;
  bool has_ground = true;       // the plane z = 0
  TriangleMesh obstacles = {};  // that stand around the structure
  TriangleMesh terrain = {};    // the ground as a mesh, in the place of the plane
  // What of the terrain is no higher is ground, near which the vehicle may fly as near the plane;
  // what rises above is in its way as an obstacle is (planner.floor_z_m).
  double terrain_floor_z_m = 0.0;
};

}  // namespace gnbv
