#include "planner/view/visibility.hpp"

#include <algorithm>
#include <cmath>

#include "planner/map/ray_walk.hpp"
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
  const Vec3 t_m = T_world_body.translation();
  const double reach_m = t_m.cwiseAbs().maxCoeff();
  GNBV_CHECK(reach_m < 0x1p29 * grid.resolution_m(), "candidate {} m from the origin", reach_m);
  RayFanFrame frame{};
  std::int32_t stride = 1;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) frame.R[a][b] = T_world_body.linear()(a, b);
    frame.t_m[a] = t_m[a];
    frame.origin_m[a] = origin_m[a];
    frame.origin_key[a] = origin.key[a];
    frame.to_upper_border_m[a] = origin.to_upper_border_m[a];
    frame.to_lower_border_m[a] = origin.to_lower_border_m[a];
    frame.steps_down[a] = origin.key[a] - grid.min_key()[a];
    frame.steps_up[a] = grid.size()[a] - 1 - frame.steps_down[a];
    frame.stride[a] = stride;
    stride *= grid.size()[a];
  }
  frame.origin_voxel = static_cast<std::int32_t>(grid.index_of(origin.key));
  frame.resolution_m = grid.resolution_m();
  frame.inverse_resolution = grid.inverse_resolution();
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
  VoxelBox box{};
  box.first = grid.index_of(keys.low);
  std::size_t stride = 1;
  for (int a = 0; a < 3; ++a) {
    box.count[a] = keys.high[a] - keys.low[a] + 1;
    box.stride[a] = stride;
    stride *= grid.size()[a];
  }
  return box;
}

double entropy_nat(std::int64_t voxels, std::int64_t known) {
  return static_cast<double>(voxels * kLn2Units - known) * kEntropyUnit_nat;
}

void fill_voxel_stats(const SurfaceCloud& cloud, const VoxelSums& sums, double sparse_below,
                      ViewStats& stats) {
  stats.free_voxels = static_cast<std::uint32_t>(sums.free);
  stats.occupied_voxels = static_cast<std::uint32_t>(sums.occupied_count);
  stats.unknown_voxels =
      static_cast<std::uint32_t>(sums.visited) - stats.free_voxels - stats.occupied_voxels;
  stats.entropy_nat = entropy_nat(sums.visited, sums.known);
  std::int64_t density_sum = 0;
  for (const std::int32_t voxel : std::span(sums.occupied, sums.occupied_count)) {
    const double density = cloud.density(voxel);
    density_sum += std::llround(density / kDensityUnit);
    stats.sparse_voxels += density > 0.0 && density < sparse_below;
  }
  stats.density_sum = static_cast<double>(density_sum) * kDensityUnit;
}

void fill_ray_stats(const RaySums& sums, ViewStats& stats) {
  const auto count = [](std::int64_t rays) { return static_cast<std::uint32_t>(rays); };
  const auto nat = [](std::int64_t sum) { return static_cast<double>(sum) * kEntropyUnit_nat; };
  stats.rays = count(sums.rays);
  stats.rays_occupied = count(sums.rays_occupied);
  stats.occlusion_aware_nat = nat(sums.occlusion_aware);
  stats.unobserved_nat = nat(sums.unobserved);
  stats.rear_side_rays = count(sums.rear_side_rays);
  stats.rear_side_nat = nat(sums.rear_side);
  stats.crossed_by_occupied = static_cast<std::uint64_t>(sums.visits_occupied);
  stats.entropy_of_occupied_nat = entropy_nat(sums.visits_occupied, sums.known_occupied);
  stats.shadow_rays = count(sums.shadow_rays);
  stats.front_rays = count(sums.front_rays);
}

}  // namespace

std::size_t ViewRays::count() const {
  std::size_t rays = 0;
  for (const Camera& camera : cameras) rays += camera.count;
  return rays;
}

namespace {

/// Ends of a radial lens's rays on the sphere at maximum range, one a voxel's face of it: ring by
/// ring around the axis.
std::vector<Vec3> ring_ends_camera_m(const CameraModel& camera, double resolution_m) {
  const double range_m = camera.config.range_max_m;
  const double step_rad = resolution_m / range_m;
  const double last_rad = std::atan(camera.lens->radius_max());
  std::vector<Vec3> ends;
  for (double off_rad = 0.5 * step_rad; off_rad <= last_rad; off_rad += step_rad) {
    const double around = 2.0 * kPi * std::sin(off_rad) / step_rad;
    const int count = std::max(1, static_cast<int>(std::lround(around)));
    for (int i = 0; i < count; ++i) {
      const double bearing_rad = 2.0 * kPi * i / count;
      const Vec3 along(std::sin(off_rad) * std::cos(bearing_rad),
                       std::sin(off_rad) * std::sin(bearing_rad), std::cos(off_rad));
      if (camera.lens->sees(along)) ends.push_back(range_m * along);
    }
  }
  return ends;
}

/// The same of a LIDAR's sector along its beams, of which those are left out that end less than a
/// voxel beside another one.
std::vector<Vec3> beam_ends_camera_m(const CameraModel& camera, double resolution_m) {
  const CameraConfig& c = camera.config;
  const auto stride = [&](double px_per_rad) {
    return std::max(1, static_cast<int>(resolution_m / c.range_max_m * px_per_rad));
  };
  std::vector<Vec3> ends;
  for (int v = 0; v < c.height_px; v += stride(camera.fy_px)) {
    for (int u = 0; u < c.width_px; u += stride(camera.fx_px)) {
      if (const auto xy = camera.lens->direction_at(u + 0.5, v + 0.5)) {
        ends.push_back(c.range_max_m * xy->homogeneous().normalized());
      }
    }
  }
  return ends;
}

}  // namespace

ViewRays make_view_rays(std::span<const CameraModel> cameras, double resolution_m) {
  constexpr int kTile = 4;
  ViewRays rays;
  rays.resolution_m = resolution_m;
  for (const CameraModel& model : cameras) {
    const double depth_m = model.config.range_max_m;
    const auto points_across = [&](double span) {
      const double half_m = depth_m * (0.5 * span);
      return static_cast<int>(2.0 * half_m / resolution_m) + 1;
    };
    const Eigen::Vector2d middle_m = depth_m * model.sight.center();
    const int columns = points_across(model.sight.sizes().x());
    const int rows = points_across(model.sight.sizes().y());
    // centred: the lattice rarely fits the plane exactly
    const auto end_camera_m = [&](int column, int row) -> Vec3 {
      return {(column - 0.5 * (columns - 1)) * resolution_m + middle_m.x(),
              (row - 0.5 * (rows - 1)) * resolution_m + middle_m.y(), depth_m};
    };
    const auto end_body_m = [&](int column, int row) -> Vec3 {
      return model.T_body_camera * end_camera_m(column, row);
    };
    const auto add = [&](const Vec3& end_m) {
      for (int a = 0; a < 3; ++a) rays.end_body_m[a].push_back(end_m[a]);
    };
    ViewRays::Camera camera;
    camera.origin_body_m = model.T_body_camera.translation();
    camera.corners_body_m = {end_body_m(0, 0), end_body_m(columns - 1, 0), end_body_m(0, rows - 1),
                             end_body_m(columns - 1, rows - 1)};
    camera.pyramid_m3 = resolution_m * resolution_m * depth_m / 3.0;
    camera.first = rays.end_body_m[0].size();
    if (model.is_radial()) {
      const bool is_sector = model.lens->is_panorama();
      for (const Vec3& end_m : is_sector ? beam_ends_camera_m(model, resolution_m)
                                         : ring_ends_camera_m(model, resolution_m)) {
        add(model.T_body_camera * end_m);
      }
      const auto count = static_cast<double>(rays.end_body_m[0].size() - camera.first);
      if (is_sector) camera.pyramid_m3 = frustum_m3(model.config) / count;
    }
    for (int top = 0; top < rows && !model.is_radial(); top += kTile) {
      for (int left = 0; left < columns; left += kTile) {
        for (int row = top; row < std::min(top + kTile, rows); ++row) {
          for (int column = left; column < std::min(left + kTile, columns); ++column) {
            if (model.lens && !model.lens->sees(end_camera_m(column, row))) continue;
            add(end_body_m(column, row));
          }
        }
      }
    }
    camera.count = rays.end_body_m[0].size() - camera.first;
    const std::size_t padded = (camera.count + kPadding - 1) / kPadding * kPadding;
    for (std::vector<double>& column : rays.end_body_m) column.resize(camera.first + padded, 0.0);
    rays.cameras.push_back(camera);
  }
  return rays;
}

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
  const auto walk = full ? view_kernels().walk_full : view_kernels().walk_voxels;
  for (const ViewRays::Camera& camera : rays.cameras) {
    const RayFanFrame frame = make_frame(geometry, T, camera.origin_body_m);
    const RayEnds ends{.at_body_m = {rays.end_body_m[0].data() + camera.first,
                                     rays.end_body_m[1].data() + camera.first,
                                     rays.end_body_m[2].data() + camera.first},
                       .count = camera.count};
    const std::int64_t share_before = ray_sums.unknown_share;
    walk(frame, ends, odds_power, maps, ray_sums);
    stats.unknown_volume_m3 +=
        static_cast<double>(ray_sums.unknown_share - share_before) * kShareUnit * camera.pyramid_m3;
  }
  VoxelSums voxel_sums{};
  voxel_sums.occupied = marks.occupied.data();
  view_kernels().tally(maps, box_of(geometry, rays, T), voxel_sums);
  fill_voxel_stats(cloud, voxel_sums, options.sparse_below, stats);
  std::int32_t* const predicted_end = maps.predicted + maps.predicted_count;
  std::sort(maps.predicted, predicted_end);
  stats.predicted_voxels =
      static_cast<std::uint32_t>(std::unique(maps.predicted, predicted_end) - maps.predicted);
  stats.entropy_per_ray_nat = entropy_nat(ray_sums.visits, ray_sums.known);
  if (full) fill_ray_stats(ray_sums, stats);
  if (maps.shadow_steps != nullptr) {
    stats.proximity_sum = static_cast<double>(voxel_sums.shadow) * options.shadow->steps_max() -
                          static_cast<double>(voxel_sums.shadow_steps);
  }
  return stats;
}

}  // namespace gnbv
