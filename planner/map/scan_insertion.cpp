#include "planner/map/scan_insertion.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "planner/map/frame_view.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kRaysPerBand = 16384;
constexpr std::size_t kScansPerBatch = 64;

/// Appends and marks the voxels that hold the ends of hits.
void collect_occupied(const GridGeometry& grid, FanWalker& walker, std::span<const ScanRay> rays,
                      std::vector<VoxelPlace>& places) {
  for (const ScanRay& ray : rays) {
    if (!ray.hit) continue;
    const Key key = grid.key_of(ray.end_world_m);
    if (!grid.contains(key)) continue;
    const VoxelPlace place = walker.place_of(key);
    if (walker.mark(place)) places.push_back(place);
  }
}

/// Joins the lists of the bands in their order, each voxel once, and leaves the voxels marked.
void join(FanWalker& walker, std::span<const std::vector<VoxelPlace>> bands,
          std::vector<VoxelPlace>& joined) {
  joined.clear();
  for (const std::vector<VoxelPlace>& band : bands) {
    for (const VoxelPlace place : band) {
      if (walker.mark(place)) joined.push_back(place);
    }
  }
}

std::vector<VoxelIndex> voxels_of(std::span<const VoxelPlace> places) {
  std::vector<VoxelIndex> voxels(places.size());
  std::transform(places.begin(), places.end(), voxels.begin(), voxel_of);
  return voxels;
}

/// Few pixels over many voxels are walked faster: a voxel costs as much as some 20 steps of a ray.
bool is_faster_projected(const GridGeometry& grid, const CameraModel& camera) {
  constexpr double kStepsPerVoxel = 20.0;
  const CameraConfig& c = camera.config;
  const double depth_voxels = c.range_max_m / grid.resolution_m();
  const double steps = 2.0 * depth_voxels * c.width_px * c.height_px;
  const double voxels = 4.0 / 3.0 * std::tan(0.5 * c.fov_x_rad) * std::tan(0.5 * c.fov_y_rad) *
                        depth_voxels * depth_voxels * depth_voxels;
  return steps > kStepsPerVoxel * voxels;
}

}  // namespace

std::vector<Vec3f> surface_points_world_m(std::span<const ScanRay> rays) {
  std::vector<Vec3f> points;
  for (const ScanRay& ray : rays) {
    if (ray.hit) points.push_back(ray.end_world_m);
  }
  return points;
}

std::vector<ScanRay> rays_of(const DepthFrame& frame, const CameraModel& camera, double floor_z_m) {
  const int width_px = camera.config.width_px;
  const int height_px = camera.config.height_px;
  GNBV_CHECK(frame.depth_m.size() ==
                 static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px),
             "{} depths for {} x {} pixels", frame.depth_m.size(), width_px, height_px);
  const auto range_min_m = static_cast<float>(camera.config.range_min_m);
  const auto range_max_m = static_cast<float>(camera.config.range_max_m);
  const Eigen::Matrix3d R = frame.T_world_camera.linear();
  const Vec3 origin_m = frame.T_world_camera.translation();
  std::vector<Vec3> across(static_cast<std::size_t>(width_px));  // world part of each column
  for (int u = 0; u < width_px; ++u) {
    across[static_cast<std::size_t>(u)] =
        R.col(0) * static_cast<double>(camera.ray_camera(u, 0).x());
  }
  std::vector<ScanRay> rays;
  rays.reserve(frame.depth_m.size());
  const float* depth_m = frame.depth_m.data();
  for (int v = 0; v < height_px; ++v) {
    const Vec3 down = R.col(1) * static_cast<double>(camera.ray_camera(0, v).y()) + R.col(2);
    for (const Vec3& column : across) {
      const float d_m = *depth_m++;
      if (!(d_m >= range_min_m)) continue;
      const bool has_return = d_m <= range_max_m;
      const double along_m = has_return ? static_cast<double>(d_m) : camera.config.range_max_m;
      const Vec3 end_m = origin_m + along_m * (column + down);
      rays.push_back({end_m.cast<float>(), has_return && end_m.z() >= floor_z_m});
    }
  }
  return rays;
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

ScanUpdate ScanInserter::compute_update(const Vec3f& origin_world_m, std::span<const ScanRay> rays,
                                        int threads) {
  const std::size_t bands = (rays.size() + kRaysPerBand - 1) / kRaysPerBand;
  const int workers = std::clamp(threads, 1, static_cast<int>(std::max<std::size_t>(bands, 1)));
  need_walkers(workers);
  occupied_.resize(bands);
  free_.resize(bands);
  const auto rays_of_band = [&](std::size_t band) {
    const std::size_t first = band * kRaysPerBand;
    return rays.subspan(first, std::min(kRaysPerBand, rays.size() - first));
  };
  const auto for_each_band = [&](const auto& task) {
    parallel_for(workers, static_cast<std::size_t>(workers), [&](std::size_t w) {
      for (std::size_t band = w; band < bands; band += static_cast<std::size_t>(workers)) {
        task(walkers_[w], band);
      }
    });
  };

  for_each_band([&](FanWalker& walker, std::size_t band) {
    occupied_[band].clear();
    collect_occupied(grid_, walker, rays_of_band(band), occupied_[band]);
    walker.clear(occupied_[band]);
  });
  std::vector<VoxelPlace> occupied;
  join(walkers_[0], occupied_, occupied);
  walkers_[0].clear(occupied);

  // occupied wins: its voxels are marked, so no walk lists them
  const RayOrigin origin = make_ray_origin(grid_, origin_world_m);
  for_each_band([&](FanWalker& walker, std::size_t band) {
    for (const VoxelPlace place : occupied) walker.mark(place);
    free_[band].clear();
    walker.walk(origin, rays_of_band(band), free_[band]);
    walker.clear(free_[band]);
    walker.clear(occupied);
  });
  std::vector<VoxelPlace> free;
  join(walkers_[0], free_, free);
  walkers_[0].clear(free);
  return {.free = voxels_of(free), .occupied = voxels_of(occupied)};
}

ScanUpdate ScanInserter::compute_update(const FrameRays& rays, const DepthFrame& frame,
                                        const CameraModel& camera, int threads) {
  if (can_project(grid_, frame, camera) && is_faster_projected(grid_, camera)) {
    return frames_.compute_update(rays, frame, camera, threads);
  }
  std::vector<ScanRay> each;
  for (std::size_t i = 0; i < rays.kind.size(); ++i) {
    if (rays.kind[i] == PixelRay::none) continue;
    each.push_back({Vec3f(rays.x_m[i], rays.y_m[i], rays.z_m[i]), rays.kind[i] == PixelRay::hits});
  }
  ScanUpdate update = compute_update(rays.origin_world_m, each, threads);
  std::ranges::sort(update.free);
  std::ranges::sort(update.occupied);
  return update;
}

void ScanInserter::insert_scans(OccupancyGrid& grid, std::span<const LidarScan> scans,
                                std::span<const LidarModel> lidars, double floor_z_m, int threads) {
  GNBV_CHECK(grid.geometry().min_key() == grid_.min_key() && grid.geometry().size() == grid_.size(),
             "another grid than the one this inserter was made for");
  const auto workers = static_cast<std::size_t>(std::max(threads, 1));
  need_walkers(threads);
  std::vector<ScanUpdate> updates(kScansPerBatch);
  std::vector<std::vector<VoxelPlace>> occupied(workers);
  std::vector<std::vector<VoxelPlace>> free(workers);
  while (!scans.empty()) {
    const auto batch = scans.first(std::min(kScansPerBatch, scans.size()));
    scans = scans.subspan(batch.size());
    std::atomic<std::size_t> next{0};
    parallel_for(threads, workers, [&](std::size_t w) {
      for (std::size_t s = next++; s < batch.size(); s = next++) {
        const LidarModel& lidar = lidars[static_cast<std::size_t>(batch[s].lidar)];
        const std::vector<ScanRay> rays = rays_of(batch[s], lidar, floor_z_m);
        const Vec3f origin_m = batch[s].T_world_lidar.translation().cast<float>();
        occupied[w].clear();
        collect_occupied(grid_, walkers_[w], rays, occupied[w]);
        free[w].clear();
        walkers_[w].walk(make_ray_origin(grid_, origin_m), rays, free[w]);
        walkers_[w].clear(occupied[w]);
        walkers_[w].clear(free[w]);
        updates[s] = {.free = voxels_of(free[w]), .occupied = voxels_of(occupied[w])};
      }
    });
    for (std::size_t s = 0; s < batch.size(); ++s) grid.apply(updates[s]);
  }
}

ScanUpdate compute_update(const GridGeometry& grid, const Vec3f& origin_world_m,
                          std::span<const ScanRay> rays, int threads) {
  return ScanInserter(grid).compute_update(origin_world_m, rays, threads);
}

void insert_scans(OccupancyGrid& grid, std::span<const LidarScan> scans,
                  std::span<const LidarModel> lidars, double floor_z_m, int threads) {
  ScanInserter(grid.geometry()).insert_scans(grid, scans, lidars, floor_z_m, threads);
}

}  // namespace gnbv
