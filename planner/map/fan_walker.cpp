#include "planner/map/fan_walker.hpp"

#include <algorithm>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr std::int32_t kNowhere = -1;

}  // namespace

FanWalker::FanWalker(const GridGeometry& grid) : grid_(grid) {
  const Key& size = grid.size();
  const std::array<std::int64_t, 3> framed = {size[0] + 2, size[1] + 2, size[2] + 2};
  const std::array<std::int64_t, 3> stride = {1, framed[0], framed[0] * framed[1]};
  const std::int64_t places = stride[2] * framed[2];  // below 2^31: GridGeometry
  for (std::size_t a = 0; a < 3; ++a) {
    move_[a] = static_cast<Place>(stride[a]);
    first_ += move_[a];
    steps_max_ += static_cast<std::size_t>(framed[a]);
  }
  layers_per_place_ = 1.0 / static_cast<double>(move_[2]);
  rows_per_place_ = 1.0 / static_cast<double>(move_[1]);
  marks_.assign(static_cast<std::size_t>(places) + 1, kFanFrame);
  for (std::int32_t z = 0; z < size[2]; ++z) {
    for (std::int32_t y = 0; y < size[1]; ++y) {
      const auto row = marks_.begin() + first_ + z * stride[2] + y * stride[1];
      std::fill(row, row + size[0], kFanUnlisted);
    }
  }
  marks_.back() = kFanListed;  // where nothing is left to walk
}

FanWalker::Place FanWalker::place_of(const Key& key) const {
  const Key& min = grid_.min_key();
  return first_ + (key[0] - min[0]) * move_[0] + (key[1] - min[1]) * move_[1] +
         (key[2] - min[2]) * move_[2];
}

VoxelIndex FanWalker::voxel_at(Place place) const {
  // half a place keeps the quotients off whole numbers by more than float64 rounds
  const double middle = static_cast<double>(place) + 0.5;
  const auto layer = static_cast<Place>(middle * layers_per_place_);
  const auto row = static_cast<Place>(middle * rows_per_place_);
  // a row has two places more than voxels, a layer two rows more, and the frame's first ones
  const Key& size = grid_.size();
  return static_cast<VoxelIndex>(place - 2 * row - (2 * layer + size[1] + 1) * size[0] - 1);
}

void FanWalker::list(Place place) {
  std::uint8_t& mark = marks_[static_cast<std::size_t>(place)];
  listed_[listed_count_] = place;
  listed_count_ += static_cast<std::size_t>(mark == kFanUnlisted);
  mark = kFanListed;
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
  for (const ScanRay& ray : rays) {
    if (!ray.hit) continue;
    const Key key = grid_.key_of(ray.end_world_m);
    if (grid_.contains(key)) list(place_of(key));
  }
  const std::size_t occupied_count = listed_count_;
  // occupied wins: its voxels are marked, so no walk lists them
  walk(make_ray_origin(grid_, origin_world_m), rays);
  take(occupied_count, update.free);
  take(0, update.occupied);
  return update;
}

bool FanWalker::enter(RaySteps& ray) const {
  const Key& min = grid_.min_key();
  const Key& size = grid_.size();
  const auto misses_along = [&](std::size_t a) {
    return ray.key[a] < min[a] ? ray.step[a] <= 0
                               : ray.key[a] >= min[a] + size[a] && ray.step[a] >= 0;
  };
  while (!grid_.contains(ray.key)) {
    if (misses_along(0) || misses_along(1) || misses_along(2) || !ray.advance()) return false;
  }
  return true;
}

bool FanWalker::start_ray(const RayOrigin& origin, const Vec3f& end_m, std::size_t which) {
  RaySteps ray = make_ray_steps(grid_, origin, end_m);
  if (ray.key == ray.key_end) return false;
  if (!grid_.contains(ray.key) && (!(ray.length_m > 0.0) || !enter(ray))) return false;
  const Place start = place_of(ray.key);
  list(start);
  if (!(ray.length_m > 0.0)) return false;
  for (std::size_t a = 0; a < 3; ++a) {
    bundle_.t_next[a][which] = ray.t_next[a];
    bundle_.t_voxel[a][which] = ray.t_voxel[a];
    bundle_.move[a][which] = ray.step[a] * move_[a];
  }
  bundle_.length_m[which] = ray.length_m;
  bundle_.place[which] = start;
  bundle_.end[which] = grid_.contains(ray.key_end) ? place_of(ray.key_end) : kNowhere;
  return true;
}

void FanWalker::walk(const RayOrigin& origin, std::span<const ScanRay> rays) {
  const auto resting = static_cast<Place>(marks_.size() - 1);
  while (!rays.empty()) {
    // each ray lists its start and a place a step; those that go no further share the sensor's
    const std::size_t room = listed_count_ + (kFanBundle + 1) * steps_max_;
    if (listed_.size() < room) listed_.resize(2 * room);
    std::size_t count = 0;
    while (count < kFanBundle && !rays.empty()) {
      if (start_ray(origin, rays.front().end_world_m, count)) ++count;
      rays = rays.subspan(1);
    }
    for (std::size_t rest = count; rest < kFanBundle; ++rest) {
      bundle_.length_m[rest] = -RaySteps::kNever;
    }
    listed_count_ +=
        fan_kernels().walk(bundle_, resting, marks_.data(), listed_.data() + listed_count_);
    GNBV_CHECK(listed_count_ < listed_.size(), "{} places listed", listed_count_);
  }
}

}  // namespace gnbv
