#include "planner/view/visibility.hpp"

#include <cmath>

#include "planner/map/ray_walk.hpp"
#include "planner/view/view_kernels.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr float kLog2e = 1.44269504F;
constexpr double kShareUnit = 0x1p-30;    // of RaySums::unknown_share
constexpr double kDensityUnit = 0x1p-32;  // densities are summed as integers

RayFanFrame make_frame(const GridGeometry& grid, const Isometry& T_world_body,
                       const Vec3& origin_body_m) {
  // a camera on the workspace's face, or a hand's breadth outside, looks from that face
  const Vec3f origin_m = grid.nearest_inside(T_world_body * origin_body_m).cast<float>();
  const RayOrigin origin = make_ray_origin(grid, origin_m);
  GNBV_CHECK(grid.contains(origin.key), "camera at {} {} {}", origin_m.x(), origin_m.y(),
             origin_m.z());
  const double reach_m = T_world_body.translation().cwiseAbs().maxCoeff();
  GNBV_CHECK(reach_m < 0x1p29 * grid.resolution_m(), "candidate {} m from the origin", reach_m);
  RayFanFrame frame{};
  const std::array<std::int32_t, 3> stride = {1, grid.size()[0], grid.size()[0] * grid.size()[1]};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto row = static_cast<Eigen::Index>(a);
    for (std::size_t b = 0; b < 3; ++b) {
      frame.R[a][b] = T_world_body.linear()(row, static_cast<Eigen::Index>(b));
    }
    frame.t_m[a] = T_world_body.translation()[row];
    frame.origin_m[a] = origin_m[row];
    frame.origin_key[a] = origin.key[a];
    frame.to_upper_border_m[a] = origin.to_upper_border_m[a];
    frame.to_lower_border_m[a] = origin.to_lower_border_m[a];
    frame.steps_down[a] = origin.key[a] - grid.min_key()[a];
    frame.steps_up[a] = grid.size()[a] - 1 - frame.steps_down[a];
    frame.stride[a] = stride[a];
  }
  frame.origin_voxel = static_cast<std::int32_t>(grid.index_of(origin.key));
  frame.resolution_m = grid.resolution_m();
  frame.inverse_resolution = 1.0 / grid.resolution_m();
  return frame;
}

/// Voxels that hold whatever the view can see.
VoxelBox box_of(const GridGeometry& grid, const ViewRays& rays, const Isometry& T_world_body) {
  Box3 box_m;
  for (const ViewRays::Camera& camera : rays.cameras) {
    box_m.extend(grid.nearest_inside(T_world_body * camera.origin_body_m));
    for (const Vec3& corner_body_m : camera.corners_body_m) {
      box_m.extend(grid.nearest_inside(T_world_body * corner_body_m));
    }
  }
  const KeyBox keys = grid.keys_in(box_m, 1);  // a voxel more for what float32 rounds
  if (keys.is_empty()) return {};
  const auto count = [&](std::size_t a) {
    return static_cast<std::size_t>(keys.high[a] - keys.low[a] + 1);
  };
  const auto row = static_cast<std::size_t>(grid.size()[0]);
  return {.first = grid.index_of(keys.low),
          .length = count(0),
          .rows = count(1),
          .row_stride = row,
          .planes = count(2),
          .plane_stride = row * static_cast<std::size_t>(grid.size()[1])};
}

std::uint32_t count_unique(std::span<std::int32_t> voxels) {
  std::sort(voxels.begin(), voxels.end());
  return static_cast<std::uint32_t>(std::unique(voxels.begin(), voxels.end()) - voxels.begin());
}

void add_density(const SurfaceCloud& cloud, std::span<const std::int32_t> occupied,
                 double sparse_below, ViewStats& stats) {
  std::int64_t sum = 0;
  for (const std::int32_t voxel : occupied) {
    const double density = cloud.density(static_cast<VoxelIndex>(voxel));
    sum += std::llround(density / kDensityUnit);
    stats.sparse_voxels += static_cast<std::uint32_t>(density > 0.0 && density < sparse_below);
  }
  stats.density_sum = static_cast<double>(sum) * kDensityUnit;
}

double entropy_nat(std::int64_t voxels, std::int64_t known) {
  return static_cast<double>(voxels * static_cast<std::int64_t>(kLn2Units) - known) *
         kEntropyUnit_nat;
}

void fill_ray_stats(const RaySums& sums, ViewStats& stats) {
  stats.rays = static_cast<std::uint32_t>(sums.rays);
  stats.rays_occupied = static_cast<std::uint32_t>(sums.rays_occupied);
  stats.occlusion_aware_nat = static_cast<double>(sums.occlusion_aware) * kEntropyUnit_nat;
  stats.unobserved_nat = static_cast<double>(sums.unobserved) * kEntropyUnit_nat;
  stats.rear_side_rays = static_cast<std::uint32_t>(sums.rear_side_rays);
  stats.rear_side_nat = static_cast<double>(sums.rear_side) * kEntropyUnit_nat;
  stats.crossed_by_occupied = static_cast<std::uint64_t>(sums.visits_occupied);
  stats.entropy_of_occupied_nat = entropy_nat(sums.visits_occupied, sums.known_occupied);
  stats.shadow_rays = static_cast<std::uint32_t>(sums.shadow_rays);
  stats.front_rays = static_cast<std::uint32_t>(sums.front_rays);
}

}  // namespace

VisitMarks::VisitMarks(std::size_t voxels) : marks(voxels + kMarkPadding) {}

ViewStats evaluate_view(const OccupancyGrid& grid, const SurfaceCloud& cloud, const ViewRays& rays,
                        const ViewPose& candidate, VisitMarks& marks, const ViewOptions& options) {
  if (options.slips.any()) {
    return evaluate_view_with_slips(grid, cloud, rays, candidate, options.slips,
                                    options.sparse_below);
  }
  const GridGeometry& geometry = grid.geometry();
  GNBV_CHECK(marks.marks.size() == geometry.voxel_count() + kMarkPadding,
             "marks of {} bytes for {} voxels", marks.marks.size(), geometry.voxel_count());
  GNBV_CHECK(rays.resolution_m == geometry.resolution_m(), "rays for voxels of {} m, not {} m",
             rays.resolution_m, geometry.resolution_m());
  const bool full = options.detail == ViewDetail::rays;
  const Isometry T = T_world_body(candidate);
  marks.predicted_ends.resize(rays.count() + kMarkPadding);
  marks.occupied.resize(rays.count() + kMarkPadding);
  ViewMaps maps = {
      .words = grid.words().data(),
      .log_odds = grid.all_log_odds().data(),
      .marks = marks.marks.data(),
      .resting_voxel = static_cast<std::int32_t>(geometry.voxel_count() + kMarkPadding - 1),
      .predicted = marks.predicted_ends.data(),
      .predicted_count = 0,
      .settled_word = grid.settled_word(),
      .settled_log_odds = grid.settled_log_odds(),
      .shadow_steps = full && options.shadow != nullptr ? options.shadow->steps() : nullptr};
  RaySums ray_sums{};
  ViewStats stats;
  stats.voxel_m3 = std::pow(geometry.resolution_m(), 3);
  const float odds_power = options.legacy_visibility ? -kLog2e : kLog2e;
  for (const ViewRays::Camera& camera : rays.cameras) {
    const RayFanFrame frame = make_frame(geometry, T, camera.origin_body_m);
    const RayEnds ends{.at_body_m = {rays.end_body_m[0].data() + camera.first,
                                     rays.end_body_m[1].data() + camera.first,
                                     rays.end_body_m[2].data() + camera.first},
                       .count = camera.count};
    const auto walk = full ? view_kernels().walk_full : view_kernels().walk_voxels;
    const std::int64_t share_before = ray_sums.unknown_share;
    walk(frame, ends, odds_power, maps, ray_sums);
    stats.unknown_volume_m3 +=
        static_cast<double>(ray_sums.unknown_share - share_before) * kShareUnit * camera.pyramid_m3;
  }
  VoxelSums voxel_sums{};
  voxel_sums.occupied = marks.occupied.data();
  view_kernels().tally(maps, box_of(geometry, rays, T), voxel_sums);

  const auto occupied = static_cast<std::int64_t>(voxel_sums.occupied_count);
  stats.free_voxels = static_cast<std::uint32_t>(voxel_sums.free);
  stats.occupied_voxels = static_cast<std::uint32_t>(occupied);
  stats.unknown_voxels =
      static_cast<std::uint32_t>(voxel_sums.visited - voxel_sums.free - occupied);
  stats.predicted_voxels = count_unique({maps.predicted, maps.predicted_count});
  stats.entropy_nat = entropy_nat(voxel_sums.visited, voxel_sums.known);
  stats.entropy_per_ray_nat = entropy_nat(ray_sums.visits, ray_sums.known);
  add_density(cloud, {voxel_sums.occupied, voxel_sums.occupied_count}, options.sparse_below, stats);
  if (full) fill_ray_stats(ray_sums, stats);
  if (maps.shadow_steps != nullptr) {
    stats.proximity_sum = static_cast<double>(voxel_sums.shadow) * options.shadow->steps_max() -
                          static_cast<double>(voxel_sums.shadow_steps);
  }
  return stats;
}

}  // namespace gnbv
