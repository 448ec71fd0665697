#include "planner/visibility.hpp"

#include <array>
#include <limits>

#include "planner/map/ray_walk.hpp"
#include "sim/core/error.hpp"

namespace gnbv {

std::vector<ViewRay> make_view_rays(std::span<const CameraModel> cameras, double resolution_m) {
  std::vector<ViewRay> rays;
  for (const CameraModel& camera : cameras) {
    const double depth_m = camera.config.range_max_m;
    const double half_width_m = depth_m * std::tan(0.5 * camera.config.fov_x_rad);
    const double half_height_m = depth_m * std::tan(0.5 * camera.config.fov_y_rad);
    const int columns = static_cast<int>(2.0 * half_width_m / resolution_m) + 1;
    const int rows = static_cast<int>(2.0 * half_height_m / resolution_m) + 1;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        // centred: the lattice rarely fits the plane exactly
        const Vec3 end_camera_m((column - 0.5 * (columns - 1)) * resolution_m,
                                (row - 0.5 * (rows - 1)) * resolution_m, depth_m);
        rays.push_back({camera.T_body_camera.translation(), camera.T_body_camera * end_camera_m});
      }
    }
  }
  return rays;
}

ViewStats evaluate_view(const OccupancyGrid& grid, const SurfaceCloud& cloud,
                        std::span<const ViewRay> rays, const ViewPose& candidate,
                        VisitMarks& marks) {
  marks.next_view();
  const GridGeometry& geometry = grid.geometry();
  const std::span<const VoxelWord> words = grid.words();
  const Isometry T = T_world_body(candidate);

  ViewStats stats;
  std::array<std::uint32_t, 3> voxels = {0, 0, 0};  // by VoxelState
  const auto see = [&](VoxelIndex v) {
    const VoxelState state = state_of(words[v]);
    const double entropy_nat = entropy_units_of(words[v]) * kEntropyUnit_nat;
    stats.entropy_per_ray_nat += entropy_nat;
    if (marks.mark(v)) {
      ++voxels[static_cast<std::size_t>(state)];
      stats.entropy_nat += entropy_nat;
      if (state == VoxelState::occupied) stats.density_sum += cloud.density(v);
    }
    return state != VoxelState::occupied;
  };
  Vec3 origin_body_m = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  RayOrigin origin;
  for (const ViewRay& ray : rays) {
    if (ray.origin_body_m != origin_body_m) {  // the rays of a camera stand together
      origin_body_m = ray.origin_body_m;
      // a camera on the workspace's face, or a hand's breadth outside, looks from that face
      origin = make_ray_origin(geometry, geometry.nearest_inside(T * origin_body_m).cast<float>());
      GNBV_CHECK(geometry.contains(origin.key), "camera at {} {} {}", origin.p_m.x(),
                 origin.p_m.y(), origin.p_m.z());
    }
    walk_ray_inside(geometry, origin, (T * ray.end_body_m).cast<float>(), see);
  }
  stats.unknown_voxels = voxels[static_cast<std::size_t>(VoxelState::unknown)];
  stats.free_voxels = voxels[static_cast<std::size_t>(VoxelState::free)];
  stats.occupied_voxels = voxels[static_cast<std::size_t>(VoxelState::occupied)];
  return stats;
}

}  // namespace gnbv
