#include "planner/map/frame_insertion.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "planner/map/frame_view.hpp"
#include "planner/map/ray_walk.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr float kNoRay = std::numeric_limits<float>::infinity();

int round_up(int count, int unit) { return (count + unit - 1) / unit * unit; }

}  // namespace

FrameInserter::FrameInserter(const GridGeometry& grid)
    : grid_(grid), marks_(grid.voxel_count() + kPadding) {}

void FrameInserter::prepare(const CameraModel& camera, int threads) {
  width_ = camera.config.width_px;
  height_ = camera.config.height_px;
  row_stride_ = round_up(width_, kPadding) + kPadding;
  tiles_x_ = row_stride_ / kTile_px;
  tiles_y_ = round_up(height_, kTile_px) / kTile_px;
  levels_ = 1;
  while ((1 << levels_) < std::max(tiles_x_, tiles_y_)) ++levels_;
  const std::size_t rows = static_cast<std::size_t>(tiles_y_) * kTile_px;
  inverse_depth_.resize(rows * static_cast<std::size_t>(row_stride_));
  const auto below = static_cast<std::ptrdiff_t>(height_) * row_stride_;  // the last tiles' rest
  std::fill(inverse_depth_.begin() + below, inverse_depth_.end(), kNoRay);
  const auto tiles = static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y_);
  tile_windows_.resize(tiles * static_cast<std::size_t>(levels_));
  ends_.resize(static_cast<std::size_t>(tiles_y_));
  workers_.resize(static_cast<std::size_t>(std::max(threads, 1)));
  const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  for (Worker& worker : workers_) {
    worker.walk.resize(pixels, 0);
    worker.doubts.resize(pixels + kPadding);
    worker.row.resize(static_cast<std::size_t>(row_stride_) + 1);
    worker.ends.resize(static_cast<std::size_t>(width_ + kPadding));
  }
}

void FrameInserter::keep_tiles(int band) {
  std::vector<float> least(static_cast<std::size_t>(row_stride_), kNoRay);
  for (int v = band * kTile_px; v < (band + 1) * kTile_px; ++v) {
    const float* const row = inverse_depth_.data() + v * row_stride_;
    for (std::size_t u = 0; u < least.size(); ++u) least[u] = row[u] < least[u] ? row[u] : least[u];
  }
  float* const tiles = tile_windows_.data() + band * tiles_x_;
  for (int t = 0; t < tiles_x_; ++t) {
    const auto first = least.begin() + t * kTile_px;
    tiles[t] = *std::min_element(first, first + kTile_px);
  }
}

void FrameInserter::widen_tiles() {
  const int level_stride = tiles_x_ * tiles_y_;
  for (int level = 1; level < levels_; ++level) {
    const float* const from = tile_windows_.data() + (level - 1) * level_stride;
    float* const to = tile_windows_.data() + level * level_stride;
    const int half = 1 << (level - 1);
    for (int ty = 0; ty < tiles_y_; ++ty) {
      const float* const upper = from + ty * tiles_x_;
      const float* const lower = from + std::min(ty + half, tiles_y_ - 1) * tiles_x_;
      for (int tx = 0; tx < tiles_x_; ++tx) {
        const int right = std::min(tx + half, tiles_x_ - 1);
        to[ty * tiles_x_ + tx] =
            std::min(std::min(upper[tx], upper[right]), std::min(lower[tx], lower[right]));
      }
    }
  }
}

void FrameInserter::read_band(const FrameRays& rays, const DepthFrame& frame,
                              const CameraModel& camera, int band, Worker& worker) {
  const FrameKernels& kernels = frame_kernels();
  EndRow ends{};
  ends.width = width_;
  ends.inverse_resolution = grid_.inverse_resolution();
  std::ranges::copy(grid_.min_key(), ends.min_key);
  std::ranges::copy(grid_.size(), ends.size);
  ends.scratch = worker.row.data();
  PixelRow depths{};
  depths.width = width_;
  set_ranges(camera, depths);
  std::vector<VoxelIndex>& voxels = ends_[static_cast<std::size_t>(band)];
  voxels.clear();
  for (int v = band * kTile_px; v < std::min((band + 1) * kTile_px, height_); ++v) {
    const std::ptrdiff_t first = std::ptrdiff_t{v} * width_;
    depths.depth_m = frame.depth_m.data() + first;
    kernels.invert_row(depths, inverse_depth_.data() + std::ptrdiff_t{v} * row_stride_,
                       row_stride_);
    ends.end_m[0] = rays.x_m.data() + first;
    ends.end_m[1] = rays.y_m.data() + first;
    ends.end_m[2] = rays.z_m.data() + first;
    ends.kind = reinterpret_cast<const std::uint8_t*>(rays.kind.data() + first);
    const int count = kernels.ends_of_row(ends, worker.ends.data());
    voxels.insert(voxels.end(), worker.ends.begin(), worker.ends.begin() + count);
  }
  keep_tiles(band);
}

void FrameInserter::walk_doubtful_rays(const FrameRays& rays) {
  const RayOrigin origin = make_ray_origin(grid_, rays.origin_world_m);
  walked_count_ = 0;
  for (Worker& worker : workers_) {
    std::uint8_t* const begin = worker.walk.data();
    const std::size_t size = worker.walk.size();
    for (std::size_t i = 0; i < size; ++i) {
      // few are asked for: memchr passes over the others fastest
      const void* const next = std::memchr(begin + i, 1, size - i);
      if (next == nullptr) break;
      i = static_cast<std::size_t>(static_cast<const std::uint8_t*>(next) - begin);
      begin[i] = 0;
      ++walked_count_;
      walk_ray_inside(grid_, origin, Vec3f(rays.x_m[i], rays.y_m[i], rays.z_m[i]),
                      [&](VoxelIndex v) {
                        if (marks_[v] == kUntouched) marks_[v] = kFreed;
                        return true;
                      });
    }
  }
}

ScanUpdate FrameInserter::collect(const FrameView& view) {
  ScanUpdate update;
  const auto length = static_cast<std::size_t>(view.box_last[0] - view.box_first[0] + 1);
  for (int z = view.box_first[2]; z <= view.box_last[2]; ++z) {
    for (int y = view.box_first[1]; y <= view.box_last[1]; ++y) {
      const std::ptrdiff_t start =
          (std::ptrdiff_t{z} * view.size[1] + y) * view.size[0] + view.box_first[0];
      std::uint8_t* const row = marks_.data() + start;
      for (std::size_t x = 0; x < length; ++x) {
        if (row[x] == kUntouched) continue;
        const auto voxel = static_cast<VoxelIndex>(start) + static_cast<VoxelIndex>(x);
        (row[x] == kEnd ? update.occupied : update.free).push_back(voxel);
      }
      std::memset(row, kUntouched, length);
    }
  }
  return update;
}

ScanUpdate FrameInserter::compute_update(const FrameRays& rays, const DepthFrame& frame,
                                         const CameraModel& camera, const OccupancyGrid& map,
                                         int threads) {
  prepare(camera, threads);
  GNBV_CHECK(map.geometry().min_key() == grid_.min_key() && map.geometry().size() == grid_.size(),
             "another map than the one this inserter was made for");
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  GNBV_CHECK(frame.depth_m.size() == pixels && rays.kind.size() == pixels,
             "{} depths and {} rays for {} pixels", frame.depth_m.size(), rays.kind.size(), pixels);
  const std::size_t workers = workers_.size();
  parallel_for(threads, workers, [&](std::size_t w) {
    for (auto band = static_cast<int>(w); band < tiles_y_; band += static_cast<int>(workers)) {
      read_band(rays, frame, camera, band, workers_[w]);
    }
  });
  widen_tiles();
  const float nearest_inverse =
      *std::min_element(tile_windows_.begin(), tile_windows_.begin() + tiles_x_ * tiles_y_);
  if (nearest_inverse == kNoRay) return {};
  FrameView view =
      make_frame_view(grid_, frame, camera, 1.0 / static_cast<double>(nearest_inverse));
  view.words = map.words().data();
  view.settled_word = map.settled_word();
  view.inverse_depth = inverse_depth_.data();
  view.row_stride = row_stride_;
  view.tile_windows = tile_windows_.data();
  view.tile_stride = tiles_x_;
  view.level_stride = tiles_x_ * tiles_y_;
  for (const std::vector<VoxelIndex>& band : ends_) {
    for (const VoxelIndex v : band) marks_[v] = kEnd;
  }
  parallel_for(threads, workers, [&](std::size_t w) {
    const FrameMarks marks{.voxel = marks_.data(),
                           .walk = workers_[w].walk.data(),
                           .doubts = workers_[w].doubts.data()};
    for (int z = view.box_first[2] + static_cast<int>(w); z <= view.box_last[2];
         z += static_cast<int>(workers)) {
      frame_kernels().project_layer(view, z, marks);
    }
  });
  walk_doubtful_rays(rays);
  return collect(view);
}

}  // namespace gnbv
