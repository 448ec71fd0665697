// `--bounds auto`: a workspace and a start for a structure that nobody wrote a scenario for.
#pragma once

#include <memory>
#include <vector>

#include "scenarios/scenario.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// Room to fly between structure and workspace: five eighths of the cameras' longest range, 5 m for
/// the paper's 8 m (its aircraft has 5 m at the wing tips, its plant 8 to 13 m), but at least the
/// collision radius and 2 m more, so that the vehicle can pass on every side.
double flight_margin_m(const Scenario& scenario);

/// Where a structure is, for whom no more needs to be known.
struct StructureExtent {
  Box3 box_m;
  std::vector<Vec3f> surface_world_m = {};      // points spread over it
  std::shared_ptr<const RayScene> around = {};  // obstacles and terrain; none where there are none
};
StructureExtent extent_of(const TriangleMesh& structure);

/// What the user said, which is left alone.
struct GivenBounds {
  bool workspace = false;
  bool object_bounds = false;
  bool position = false;
  bool yaw = false;
};

/// The scenario with its workspace laid around the structure, wherever that is, its start moved
/// there and all of the workspace counted (PlannerConfig::object_bounds_m). The workspace is the
/// structure's box, and a start that is given, grown by the margin to the sides and above (the
/// start only as far as it needs), its faces on multiples of the map's resolution. Its floor is the
/// ground, z = 0; the structure's lowest point where it sinks below; and the margin below its
/// lowest point where it floats higher than that, or where there is no ground. The top is high
/// enough to fly at z_min_m, whatever the structure's height. The start is on the workspace's south
/// face, looking north, where most of the surface is in front of a camera and within its range,
/// near the middle of equals, and no obstacle and no no_fly box is within the collision radius, as
/// far as such a place is found; its jitter stays. What comes of it may not be flyable: ask
/// problems().
Scenario with_bounds_around(const Scenario& scenario, const StructureExtent& structure,
                            const GivenBounds& given = {});

}  // namespace gnbv
