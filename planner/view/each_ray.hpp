// The rays of a view one by one, for what is not a kernel.
#pragma once

#include "planner/map/ray_walk.hpp"
#include "planner/view/view_rays.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

/// Calls use(origin, end_world_m) for each ray of a view from that pose, camera after camera. An
/// origin outside the map is taken to its nearest place inside. `rays` must have been made for the
/// map's resolution.
template <typename Use>
void for_each_ray(const GridGeometry& geometry, const ViewRays& rays, const ViewPose& view,
                  const Use& use) {
  const Isometry T = T_world_body(view);
  for (const ViewRays::Camera& camera : rays.cameras) {
    const Vec3f origin_m = geometry.nearest_inside(T * camera.origin_body_m).cast<float>();
    const RayOrigin origin = make_ray_origin(geometry, origin_m);
    for (std::size_t i = camera.first; i < camera.first + camera.count; ++i) {
      const Vec3 end_m =
          T * Vec3(rays.end_body_m[0][i], rays.end_body_m[1][i], rays.end_body_m[2][i]);
      use(origin, Vec3f(end_m.cast<float>()));
    }
  }
}

}  // namespace gnbv
