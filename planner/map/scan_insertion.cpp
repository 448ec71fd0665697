#include "planner/map/scan_insertion.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "planner/map/frame_view.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kScansPerBatch = 32;  // and as many being applied

/// Few pixels over many voxels are walked faster: a voxel costs as much as some 20 steps of a ray.
bool is_faster_projected(const GridGeometry& grid, const CameraModel& camera) {
  constexpr double kStepsPerVoxel = 20.0;
  const CameraConfig& c = camera.config;
  const double steps = 2.0 * c.range_max_m / grid.resolution_m() * c.width_px * c.height_px;
  return steps > kStepsPerVoxel * frustum_m3(c) / std::pow(grid.resolution_m(), 3);
}

}  // namespace

std::vector<Vec3f> surface_points_world_m(std::span<const ScanRay> rays) {
  std::vector<Vec3f> points;
  for (const ScanRay& ray : rays) {
    if (ray.hit) points.push_back(ray.end_world_m);
  }
  return points;
}

std::vector<ScanRay> rays_of(const LidarScan& scan, const LidarModel& lidar, double floor_z_m) {
  const std::vector<Vec3f>& beams = lidar.beams_lidar;
  GNBV_CHECK(scan.range_m.size() == beams.size(), "{} ranges for {} beams", scan.range_m.size(),
             beams.size());
  const auto range_min_m = static_cast<float>(lidar.config.range_min_m);
  const auto range_max_m = static_cast<float>(lidar.config.range_max_m);
  std::vector<ScanRay> rays;
  rays.reserve(beams.size());
  for (std::size_t b = 0; b < beams.size(); ++b) {
    const float range_m = scan.range_m[b];
    if (!(range_m >= range_min_m)) continue;
    const bool has_return = range_m <= range_max_m;
    const double along_m = has_return ? static_cast<double>(range_m) : lidar.config.range_max_m;
    const Vec3 end_m = scan.T_world_lidar * (along_m * beams[b].cast<double>());
    rays.push_back({end_m.cast<float>(), has_return && end_m.z() >= floor_z_m});
  }
  return rays;
}

void ScanInserter::need_walkers(int threads) {
  while (static_cast<int>(walkers_.size()) < std::max(threads, 1)) walkers_.emplace_back(grid_);
}

ScanUpdate ScanInserter::compute_update(const FrameRays& rays, const DepthFrame& frame,
                                        const CameraModel& camera, const OccupancyGrid& map,
                                        int threads) {
  if (can_project(grid_, frame, camera) && is_faster_projected(grid_, camera)) {
    return frames_.compute_update(rays, frame, camera, map, threads);
  }
  std::vector<ScanRay> each;
  for (std::size_t i = 0; i < rays.kind.size(); ++i) {
    if (rays.kind[i] == PixelRay::none) continue;
    each.push_back({Vec3f(rays.x_m[i], rays.y_m[i], rays.z_m[i]), rays.kind[i] == PixelRay::hits});
  }
  need_walkers(1);
  ScanUpdate update = walkers_[0].compute_update(rays.origin_world_m, each);
  std::ranges::sort(update.free);
  std::ranges::sort(update.occupied);
  return update;
}

void ScanInserter::insert_scans(OccupancyGrid& grid, std::span<const LidarScan> scans,
                                std::span<const LidarModel> lidars, double floor_z_m, int threads) {
  GNBV_CHECK(grid.geometry().min_key() == grid_.min_key() && grid.geometry().size() == grid_.size(),
             "another grid than the one this inserter was made for");
  need_walkers(threads);
  std::vector<ScanUpdate> walked(kScansPerBatch);
  std::vector<ScanUpdate> updates(kScansPerBatch);
  std::span<ScanUpdate> to_apply;  // while the next batch is walked
  while (!scans.empty() || !to_apply.empty()) {
    const auto batch = scans.first(std::min(kScansPerBatch, scans.size()));
    scans = scans.subspan(batch.size());
    std::atomic<std::size_t> next{0};
    parallel_for(threads, static_cast<std::size_t>(std::max(threads, 1)), [&](std::size_t w) {
      for (std::size_t u = 0; w == 0 && u < to_apply.size(); ++u) grid.apply(to_apply[u]);
      for (std::size_t s = next++; s < batch.size(); s = next++) {
        const LidarModel& lidar = lidars[static_cast<std::size_t>(batch[s].lidar)];
        walked[s] =
            walkers_[w].compute_update(batch[s].T_world_lidar.translation().cast<float>(),
                                       rays_of(batch[s], lidar, floor_z_m), std::move(walked[s]));
      }
    });
    std::swap(walked, updates);
    to_apply = std::span(updates).first(batch.size());
  }
}

}  // namespace gnbv
