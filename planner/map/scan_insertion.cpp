#include "planner/map/scan_insertion.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

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

FanWalker::FanWalker(const GridGeometry& grid) : grid_(grid), framed_(grid.grown(1)) {
  const Key& min = grid.min_key();
  const Key& size = grid.size();
  const Key& framed = framed_.size();
  move_ = {1, framed[0], framed[0] * framed[1]};
  layers_per_place_ = 1.0 / move_[2];
  rows_per_place_ = 1.0 / move_[1];
  steps_max_ = static_cast<std::size_t>(framed[0] + framed[1] + framed[2]);
  marks_.assign(framed_.voxel_count() + 1, kFanFrame);
  for (std::int32_t z = min[2]; z < min[2] + size[2]; ++z) {
    for (std::int32_t y = min[1]; y < min[1] + size[1]; ++y) {
      std::fill_n(marks_.data() + framed_.index_of({min[0], y, z}), size[0], kFanUnlisted);
    }
  }
  marks_.back() = kFanListed;  // the resting place
}

VoxelIndex FanWalker::voxel_at(Place place) const {
  // half a place keeps the quotients off whole numbers by more than float64 rounds
  const double middle = place + 0.5;
  const auto layer = static_cast<Place>(middle * layers_per_place_);
  const auto row = static_cast<Place>(middle * rows_per_place_);
  // without the frame: two places a row, two rows a layer, and those before the first voxel
  const Key& size = grid_.size();
  return static_cast<VoxelIndex>(place - 2 * row - (2 * layer + size[1] + 1) * size[0] - 1);
}

void FanWalker::list(const Key& key) {
  const VoxelIndex place = framed_.index_of(key);
  listed_[listed_count_] = static_cast<Place>(place);
  listed_count_ += marks_[place] == kFanUnlisted;
  marks_[place] = kFanListed;
}

void FanWalker::take(std::size_t first, std::vector<VoxelIndex>& voxels) {
  voxels.resize(listed_count_ - first);
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    const Place place = listed_[first + i];
    marks_[static_cast<std::size_t>(place)] = kFanUnlisted;
    voxels[i] = voxel_at(place);
  }
  listed_count_ = first;
}

ScanUpdate FanWalker::compute_update(const Vec3f& origin_world_m, std::span<const ScanRay> rays,
                                     ScanUpdate update) {
  // list() writes before it knows whether the place is new: one more than there are ends
  listed_.resize(std::max(listed_.size(), rays.size() + 1));
  // occupied wins: its voxels are marked, so no walk lists them
  for (const ScanRay& ray : rays) {
    if (!ray.hit) continue;
    const Key key = grid_.key_of(ray.end_world_m);
    if (grid_.contains(key)) list(key);
  }
  const std::size_t occupied_count = listed_count_;
  const RayOrigin origin = make_ray_origin(grid_, origin_world_m);
  const auto resting = static_cast<Place>(marks_.size() - 1);
  while (!rays.empty()) {
    // a ray lists its start and a place a step; those that go no further share the sensor's place
    const std::size_t room = listed_count_ + (kFanBundle + 1) * steps_max_;
    if (listed_.size() < room) listed_.resize(2 * room);
    std::size_t count = 0;
    for (; count < kFanBundle && !rays.empty(); rays = rays.subspan(1)) {
      count += start_ray(origin, rays.front().end_world_m, count);
    }
    std::fill(bundle_.length_m + count, bundle_.length_m + kFanBundle, -RaySteps::kNever);
    listed_count_ +=
        fan_kernels().walk(bundle_, resting, marks_.data(), listed_.data() + listed_count_);
    GNBV_CHECK(listed_count_ < listed_.size(), "{} places listed", listed_count_);
  }
  take(occupied_count, update.free);
  take(0, update.occupied);
  return update;
}

bool FanWalker::start_ray(const RayOrigin& origin, const Vec3f& end_m, std::size_t which) {
  RaySteps ray = make_ray_steps(grid_, origin, end_m);
  if (ray.key == ray.key_end) return false;
  const bool moves = ray.length_m > 0.0;
  const auto misses_along = [&](std::size_t a) {
    const std::int32_t min = grid_.min_key()[a];
    return ray.key[a] < min ? ray.step[a] <= 0
                            : ray.key[a] >= min + grid_.size()[a] && ray.step[a] >= 0;
  };
  while (!grid_.contains(ray.key)) {  // a sensor outside
    const bool misses = misses_along(0) || misses_along(1) || misses_along(2);
    if (!moves || misses || !ray.advance()) return false;
  }
  list(ray.key);
  if (!moves) return false;
  for (std::size_t a = 0; a < 3; ++a) {
    bundle_.t_next[a][which] = ray.t_next[a];
    bundle_.t_voxel[a][which] = ray.t_voxel[a];
    bundle_.move[a][which] = ray.step[a] * move_[a];
  }
  bundle_.length_m[which] = ray.length_m;
  bundle_.place[which] = framed_.index_of(ray.key);
  bundle_.end[which] =
      grid_.contains(ray.key_end) ? std::int64_t{framed_.index_of(ray.key_end)} : -1;
  return true;
}

ScanUpdate ScanInserter::compute_update(const FrameRays& rays, const DepthFrame& frame,
                                        const CameraModel& camera, const OccupancyGrid& map,
                                        int threads) {
  if (can_project(grid_, frame, camera) && is_faster_projected(grid_, camera)) {
    return frames_.compute_update(rays, frame, camera, map, threads);
  }
  return compute_update(rays);
}

ScanUpdate ScanInserter::compute_update(const FrameRays& rays) {
  std::vector<ScanRay> each;
  for (std::size_t i = 0; i < rays.kind.size(); ++i) {
    if (rays.kind[i] == PixelRay::none) continue;
    each.push_back({rays.end_world_m(i), rays.kind[i] == PixelRay::hits});
  }
  if (walkers_.empty()) walkers_.emplace_back(grid_);
  ScanUpdate update = walkers_[0].compute_update(rays.origin_world_m, each);
  std::ranges::sort(update.free);
  std::ranges::sort(update.occupied);
  return update;
}

void ScanInserter::insert_scans(OccupancyGrid& grid, std::span<const LidarScan> scans,
                                std::span<const LidarModel> lidars, double floor_z_m, int threads) {
  GNBV_CHECK(grid.geometry() == grid_, "another grid than the one this inserter was made for");
  while (std::ssize(walkers_) < std::max(threads, 1)) walkers_.emplace_back(grid_);
  std::vector<ScanUpdate> walked(kScansPerBatch), updates(kScansPerBatch);
  std::span<ScanUpdate> to_apply;  // while the next batch is walked
  while (!scans.empty() || !to_apply.empty()) {
    const auto batch = scans.first(std::min(kScansPerBatch, scans.size()));
    scans = scans.subspan(batch.size());
    std::atomic<std::size_t> next{0};
    parallel_for(threads, walkers_.size(), [&](std::size_t w) {
      for (std::size_t u = 0; w == 0 && u < to_apply.size(); ++u) grid.apply(to_apply[u]);
      for (std::size_t s = next++; s < batch.size(); s = next++) {
        const Vec3f origin_m = batch[s].T_world_lidar.translation().cast<float>();
        const std::vector<ScanRay> rays = rays_of(batch[s], lidars[batch[s].lidar], floor_z_m);
        walked[s] = walkers_[w].compute_update(origin_m, rays, std::move(walked[s]));
      }
    });
    std::swap(walked, updates);
    to_apply = std::span(updates).first(batch.size());
  }
}

}  // namespace gnbv
