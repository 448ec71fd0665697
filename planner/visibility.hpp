// What a candidate view would see: one ray walk, one ViewStats, scored by every utility.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/map/surface_cloud.hpp"
#include "sensors/camera_model.hpp"

namespace gnbv {

/// How much of ViewStats a utility needs; `rays` costs more.
enum class ViewDetail { voxels, rays };

/// Counts and sums over the voxels that the rays of all cameras cross, up to and with the first
/// occupied voxel of each ray. A ray that leaves the workspace ends there. Sums are exact or of
/// integers, so that neither the order of the rays nor the width of the vectors changes them.
struct ViewStats {
  // each voxel once
  std::uint32_t free_voxels = 0;
  std::uint32_t unknown_voxels = 0;
  std::uint32_t occupied_voxels = 0;
  std::uint32_t predicted_voxels = 0;  // first predicted voxel of a ray, Eq. (3)'s N_pred
  std::uint32_t sparse_voxels = 0;     // occupied, with points, less dense than the frontier bound
  double entropy_nat = 0.0;            // sum of Eq. (1), clamped voxels 0
  double density_sum = 0.0;            // over the visible occupied voxels
  // a voxel once per ray that crosses it
  double entropy_per_ray_nat = 0.0;
  // ---- ViewDetail::rays only. P_v, the chance to see voxel k of a ray, is the product of
  // (1 - P_j) over the voxels j before it (Delmerico et al. 2018; the legacy form multiplies P_j)
  std::uint32_t rays = 0;            // that take at least one step
  std::uint32_t rays_occupied = 0;   // that end at an occupied voxel
  double occlusion_aware_nat = 0.0;  // sum of P_v H
  double unobserved_nat = 0.0;       // the same over unknown voxels
  std::uint32_t rear_side_rays = 0;  // whose occupied end is entered from an unknown voxel
  double rear_side_nat = 0.0;        // of those: sum of P_v H over the unknown run and the end
  std::uint64_t crossed_by_occupied =
      0;                                 // voxels of the rays that end occupied, the ends with them
  double entropy_of_occupied_nat = 0.0;  // sum of H along the rays that end occupied
  double unknown_volume_m3 = 0.0;        // unknown part of the rays' pyramids (AEP's quadrature)
  double proximity_sum = 0.0;            // sum of delta_max - delta, each shadow voxel once
  std::uint32_t shadow_rays = 0;         // that cross a shadow voxel: "occplane"
  std::uint32_t front_rays = 0;          // that enter an occupied voxel from a free one
  // ---- filled in by the planner: what the view is measured against
  double density_max = 0.0;  // SurfaceCloud::density_max()
  double path_m = 0.0;       // length of the path from the current position
};

/// One ray of a view in the body frame: from its camera to the plane at maximum range.
struct ViewRay {
  Vec3 origin_body_m;
  Vec3 end_body_m;
};

/// The rays of all cameras, one per voxel of the plane at maximum range (released code: 47 x 34 for
/// 60 x 45 degrees, 8 m and 0.2 m).
std::vector<ViewRay> make_view_rays(std::span<const CameraModel> cameras, double resolution_m);

/// Reusable memory of one thread: which voxels the view at hand has already counted.
class VisitMarks {
 public:
  explicit VisitMarks(std::size_t voxels) : stamp_(voxels, 0) {}
  void next_view() {
    if (++current_ == 0) {  // the stamps of 65,535 views ago would look new
      std::fill(stamp_.begin(), stamp_.end(), std::uint16_t{0});
      current_ = 1;
    }
  }
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

/// Walks all rays from the candidate pose. density_max and path_m stay 0.
ViewStats evaluate_view(const OccupancyGrid& grid, const SurfaceCloud& cloud,
                        std::span<const ViewRay> rays, const ViewPose& candidate,
                        VisitMarks& marks);

}  // namespace gnbv
