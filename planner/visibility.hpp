// What a candidate view would see: one ray walk, one ViewStats, scored by every utility.
#pragma once

#include <span>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/map/surface_cloud.hpp"
#include "sensors/camera_model.hpp"

namespace gnbv {

/// Counts and sums over the voxels that the rays of all cameras cross, up to and with the first
/// occupied voxel of each ray; voxels outside the workspace end a ray.
struct ViewStats {
  // each voxel once
  std::uint32_t free_voxels = 0;
  std::uint32_t unknown_voxels = 0;
  std::uint32_t occupied_voxels = 0;
  double entropy_nat = 0.0;          // sum of Eq. (1), clamped voxels 0
  double density_sum = 0.0;          // over the visible occupied voxels
  // a voxel once per ray that crosses it
  double entropy_per_ray_nat = 0.0;
  // filled by the planner
  std::uint32_t predicted_voxels = 0;
  double density_max = 0.0;          // SurfaceCloud::density_max()
  double path_m = 0.0;               // straight distance from the current position
};

/// The rays of all cameras in the body frame, one per voxel of the plane at maximum range
/// (released code: 47 x 34 for 60 x 45 degrees, 8 m and 0.2 m). Each ends on that plane.
struct ViewRays {
  std::vector<Vec3> origin_body_m;   // (n), the camera the ray belongs to
  std::vector<Vec3> end_body_m;      // (n)
};
ViewRays make_view_rays(std::span<const CameraModel> cameras, double resolution_m);

/// Reusable memory of one thread: which voxels this view has already counted.
class VisitMarks {
 public:
  explicit VisitMarks(std::size_t voxels) : stamp_(voxels, 0) {}
  void next_view();
  /// True the first time a voxel is seen in this view.
  bool mark(VoxelIndex v) {
    const bool first = stamp_[v] != current_;
    stamp_[v] = current_;
    return first;
  }

 private:
  std::vector<std::uint16_t> stamp_;
  std::uint16_t current_ = 0;
};

/// Does not fill the three last fields of ViewStats.
ViewStats evaluate_view(const OccupancyGrid& grid, const SurfaceCloud& cloud, const ViewRays& rays,
                        const ViewPose& candidate, VisitMarks& marks);

}  // namespace gnbv
