// What is true. Only sim, sensors, bench and tools may see it; the planner never does.
#pragma once

#include <vector>

#include "sim/mesh/body_motion.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// A body that moves: seen and solid where it is at the time, and neither scored nor in the way of
/// what is asked of a world at rest.
struct MovingBody {
  TriangleMesh mesh;  // where it stands at time 0
  BodyMotion motion;
};

/// Everything here is seen by the sensors and solid for the vehicle; the structure alone is scored.
struct World {
  TriangleMesh structure;
  bool has_ground = true;       // the plane z = 0
  TriangleMesh obstacles = {};  // that stand around the structure
  TriangleMesh terrain = {};    // the ground as a mesh, in the place of the plane
  // What of the terrain is no higher is ground, near which the vehicle may fly as near the plane;
  // what rises above is in its way as an obstacle is (planner.floor_z_m).
  double terrain_floor_z_m = 0.0;
  std::vector<MovingBody> movers = {};
  bool is_portable = false;  // rays meet the same face at the same place on every processor
};

}  // namespace gnbv
