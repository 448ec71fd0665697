// What a candidate view would see: one walk of its rays.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/map/surface_cloud.hpp"
#include "planner/view/shadow_band.hpp"
#include "planner/view/view_kernels.hpp"
#include "planner/view/view_stats.hpp"

namespace gnbv {

/// The rays along which a view is looked at, in the body frame, in columns: one per voxel of each
/// camera's plane (of a fisheye's sphere) at maximum range (released code: 47 x 34 for 60 x 45
/// degrees, 8 m and 0.2 m), or along the beams of a LIDAR's sector, in tiles of 4 x 4 neighbours,
/// which end close to each other and fill a vector. Each camera's rays are padded to full vectors.
struct ViewRays {
  struct Camera {
    Vec3 origin_body_m = Vec3::Zero();
    std::array<Vec3, 4> corners_body_m;  // ends of the outermost rays
    double pyramid_m3 = 0.0;             // volume that one ray stands for
    std::size_t first = 0;               // into the columns
    std::size_t count = 0;               // rays, without the padding
  };
  double resolution_m = 0.0;
  std::vector<Camera> cameras;
  std::array<std::vector<double>, 3> end_body_m;  // x, y, z

  /// Rays of all cameras, without the padding.
  std::size_t count() const;
};

/// The rays of all cameras through a map of this resolution.
ViewRays make_view_rays(std::span<const CameraModel> cameras, double resolution_m);

/// Memory of one thread, about a byte a voxel, for one view after the other. No result depends on
/// what it holds.
struct VisitMarks {
  explicit VisitMarks(std::size_t voxels) : marks(voxels + kMarkPadding) {}

  ZeroedArray<std::uint8_t> marks;           // voxels the view at hand has seen; zero between views
  std::vector<std::int32_t> predicted_ends;  // first predicted voxel of each ray
  std::vector<std::int32_t> occupied;        // seen
};

/// Slips of the released code, kept behind switches so that their effect on the paper's tables
/// can be measured. With one of the first two, the voxels of a ray that hits something are listed
/// towards the centre of the voxel it hit, and occupied ones count where the list clips them.
struct ReleasedSlips {
  /// The voxel that a ray hits never counts. A flat wall seen head-on shows none.
  bool excludes_hit_voxel = false;
  /// It counts only when a ray cast among the predicted voxels hits one too, at any distance within
  /// range.
  bool prediction_hides_hits = false;
  /// What a ray crosses adds no entropy per ray when the ray ends outside the object bounds.
  bool drops_leaving_rays = false;

  bool any() const { return excludes_hit_voxel || prediction_hides_hits || drops_leaving_rays; }
};

/// What is counted of a view, and how.
struct ViewOptions {
  ViewDetail detail = ViewDetail::voxels;
  bool legacy_visibility = false;      // P_v multiplies P_j: released code of Delmerico et al.
  double sparse_below = 0.0;           // density below which a voxel counts as sparse
  const ShadowBand* shadow = nullptr;  // without one, proximity_sum is 0
  ReleasedSlips slips = {};            // with one, the detail is voxels
};

/// Walks all rays of a view from the candidate pose; density_max and path_m stay 0. `rays` must
/// have been made for the grid's resolution, `marks` for its number of voxels. Every SimdLevel
/// gives the same bits. The voxels are those of walk_ray_inside(), but for near ties: at 40 steps a
/// ray, 2 in a million.
ViewStats evaluate_view(const OccupancyGrid& grid, const SurfaceCloud& cloud, const ViewRays& rays,
                        const ViewPose& candidate, VisitMarks& marks,
                        const ViewOptions& options = {});

/// The same with the slips, ray by ray, scalar and slow.
ViewStats evaluate_view_with_slips(const OccupancyGrid& grid, const SurfaceCloud& cloud,
                                   const ViewRays& rays, const ViewPose& candidate,
                                   const ReleasedSlips& slips, double sparse_below);

/// Ascending, each once.
struct VoxelsInSight {
  std::vector<VoxelIndex> unknown;    // that the rays cross before they meet an occupied one
  std::vector<VoxelIndex> predicted;  // the first predicted one of each ray: Eq. (3)'s N_pred
};

/// Those that ViewStats::unknown_voxels and predicted_voxels count of a view from that pose
/// (without the released slips), but for near ties. `rays` must have been made for the grid's
/// resolution.
VoxelsInSight voxels_in_sight(const OccupancyGrid& grid, const ViewRays& rays,
                              const ViewPose& view);

}  // namespace gnbv
