#include "planner/map/frame_insertion.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "planner/map/ray_walk.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr float kNoRay = std::numeric_limits<float>::infinity();

/// What the centres of the pixels span at z = 1.
Eigen::AlignedBox2d image_of(const CameraModel& camera) {
  const Eigen::Array2d focal_px(camera.fx_px, camera.fy_px);
  const Eigen::Array2d center_px(camera.cx_px, camera.cy_px);
  const Eigen::Array2d size_px(camera.config.width_px, camera.config.height_px);
  return {((0.5 - center_px) / focal_px).matrix(),
          ((size_px - 0.5 - center_px) / focal_px).matrix()};
}

/// No coordinate of a ray is larger.
double reach_m(const DepthFrame& frame, const CameraModel& camera) {
  const Eigen::AlignedBox2d image = image_of(camera);
  const Eigen::Vector2d steepest = image.min().cwiseAbs().cwiseMax(image.max().cwiseAbs());
  return frame.T_world_camera.translation().cwiseAbs().maxCoeff() +
         camera.config.range_max_m * std::hypot(1.0, steepest.norm());
}

/// Rays and planes are rounded to float32 here and in OctoMap, by a few units in the last place of
/// the largest coordinate.
double margin_m(const DepthFrame& frame, const CameraModel& camera) {
  constexpr double kLeast_m = 1e-4;
  constexpr double kUnits = 64.0 * 0x1p-24;
  return std::max(kLeast_m, kUnits * reach_m(frame, camera));
}

/// The view but for map and tiles, and for what depends on how deep the rays go.
FrameView make_frame_view(const GridGeometry& grid, const FrameRays& rays, const DepthFrame& frame,
                          const CameraModel& camera) {
  const Eigen::Matrix3d R = frame.T_world_camera.linear();
  const Vec3 origin_m = frame.T_world_camera.translation();
  const RayOrigin origin = make_ray_origin(grid, origin_m.cast<float>());
  const Vec3 toward = R * image_of(camera).min().homogeneous();
  const double half_m = 0.5 * grid.resolution_m();
  const double margin = margin_m(frame, camera);
  const auto narrow = [](double x) { return static_cast<float>(x); };
  FrameView view{};
  view.width = camera.config.width_px;
  view.height = camera.config.height_px;
  view.row_stride = rays.row_stride;
  view.tile_stride = view.row_stride / kTile_px;
  view.level_stride = view.tile_stride * ((view.height + kTile_px - 1) / kTile_px);
  view.inverse_depth = rays.inverse_depth.data();
  view.focal_px[0] = narrow(camera.fx_px);
  view.focal_px[1] = narrow(camera.fy_px);
  view.center_px[0] = narrow(camera.cx_px - 0.5);
  view.center_px[1] = narrow(camera.cy_px - 0.5);
  view.center_slack = narrow(0.501 * std::hypot(1.0 / camera.fx_px, 1.0 / camera.fy_px));
  view.half_voxel_m = narrow(half_m);
  view.margin_m = narrow(margin);
  view.direction_slack = view.margin_m / narrow(camera.config.range_min_m);
  view.resolution_m = grid.resolution_m();
  view.inverse_resolution = grid.inverse_resolution();
  for (int a = 0; a < 3; ++a) {
    view.toward[a] = narrow(toward[a]);
    view.right[a] = narrow(R(a, 0) / camera.fx_px);
    view.down[a] = narrow(R(a, 1) / camera.fy_px);
    for (int k = 0; k < 3; ++k) view.camera_axis[k][a] = narrow(R(a, k));
    view.extent_m[a] = narrow(half_m * R.col(a).lpNorm<1>() + margin);
    view.origin_m[a] = origin_m[a];
    view.min_key[a] = grid.min_key()[a];
    view.size[a] = grid.size()[a];
    view.camera_key[a] = origin.key[a];
    view.lower_border_m[a] = narrow(origin.to_lower_border_m[a]);
    view.upper_border_m[a] = narrow(origin.to_upper_border_m[a]);
  }
  return view;
}

/// Adds the pyramid of rays down to `furthest_m`, and the box of voxels that it can meet.
void set_reach(const GridGeometry& grid, const DepthFrame& frame, const CameraModel& camera,
               double furthest_m, FrameView& view) {
  const Eigen::Matrix3d R = frame.T_world_camera.linear();
  const Eigen::AlignedBox2d image = image_of(camera);
  const double margin = margin_m(frame, camera);
  const double room_m = 0.5 * grid.resolution_m() + 2.0 * margin;
  const Vec3 normals_camera[6] = {{1.0, 0.0, -image.min().x()},
                                  {-1.0, 0.0, image.max().x()},
                                  {0.0, 1.0, -image.min().y()},
                                  {0.0, -1.0, image.max().y()},
                                  {0.0, 0.0, 1.0},
                                  {0.0, 0.0, -1.0}};
  for (int k = 0; k < 6; ++k) {
    const Vec3 normal = R * normals_camera[k];
    for (int a = 0; a < 3; ++a) view.plane[k][a] = normal[a];
    view.plane[k][3] = (k < 5 ? 0.0 : furthest_m) + room_m * normal.lpNorm<1>();
  }
  const Vec3 origin_m = frame.T_world_camera.translation();
  Box3 reached_m(origin_m);
  for (const auto corner : {image.BottomLeft, image.BottomRight, image.TopLeft, image.TopRight}) {
    reached_m.extend(origin_m + R * image.corner(corner).homogeneous() * furthest_m);
  }
  const Box3 grown_m(reached_m.min().array() - margin, reached_m.max().array() + margin);
  const KeyBox keys = grid.keys_in(grown_m, 1);
  for (int a = 0; a < 3; ++a) {
    view.box_first[a] = keys.low[a] - view.min_key[a];
    view.box_last[a] = keys.high[a] - view.min_key[a];
  }
}

/// Fills the levels above the first: the least of the four windows of half the size.
void widen_tiles(const FrameView& view, int levels, float* windows) {
  const int columns = view.tile_stride;
  const int rows = view.level_stride / columns;
  for (int level = 1; level < levels; ++level) {
    const float* const from = windows + (level - 1) * view.level_stride;
    float* const to = windows + level * view.level_stride;
    const int half = 1 << (level - 1);
    for (int ty = 0; ty < rows; ++ty) {
      const float* const upper = from + ty * columns;
      const float* const lower = from + std::min(ty + half, rows - 1) * columns;
      for (int tx = 0; tx < columns; ++tx) {
        const int right = std::min(tx + half, columns - 1);
        to[ty * columns + tx] = std::min({upper[tx], upper[right], lower[tx], lower[right]});
      }
    }
  }
}

}  // namespace

bool can_project(const GridGeometry& grid, const DepthFrame& frame, const CameraModel& camera) {
  constexpr double kRotationSlack = 1e-9;
  constexpr double kOctomapKeys = 32768.0;
  constexpr double kMarginsPerVoxel = 20.0;
  constexpr int kPixels = 1 << 23;
  const Eigen::Matrix3d R = frame.T_world_camera.linear();
  const double rotation_error =
      (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return (!camera.lens || camera.lens->is_pinhole()) &&
         grid.contains(grid.key_of(Vec3f(frame.T_world_camera.translation().cast<float>()))) &&
         rotation_error < kRotationSlack && camera.config.range_min_m > 0.0 &&
         reach_m(frame, camera) < kOctomapKeys * grid.resolution_m() &&
         kMarginsPerVoxel * margin_m(frame, camera) < grid.resolution_m() &&
         camera.config.width_px + 2 * kPadding < kPixels / (camera.config.height_px + kTile_px);
}

FrameInserter::FrameInserter(const GridGeometry& grid)
    : grid_(grid), marks_(grid.voxel_count() + kPadding) {}

void FrameInserter::read_band(const FrameView& view, const FrameRays& rays, int band,
                              Worker& worker) {
  std::vector<VoxelIndex>& voxels = ends_[band];
  voxels.clear();
  std::vector<float> least(view.row_stride, kNoRay);  // of each column
  for (int v = band * kTile_px; v < std::min((band + 1) * kTile_px, view.height); ++v) {
    const float* const row = view.inverse_depth + std::ptrdiff_t{v} * view.row_stride;
    for (std::size_t u = 0; u < least.size(); ++u) least[u] = row[u] < least[u] ? row[u] : least[u];
    const EndRow ends = rays.row(std::ptrdiff_t{v} * view.width);
    const int count = frame_kernels().ends_of_row(view, ends, worker.ends.data());
    voxels.insert(voxels.end(), worker.ends.begin(), worker.ends.begin() + count);
  }
  for (int t = 0; t < view.tile_stride; ++t) {
    const auto first = least.begin() + t * kTile_px;
    tile_windows_[band * view.tile_stride + t] = *std::min_element(first, first + kTile_px);
  }
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
      i = static_cast<const std::uint8_t*>(next) - begin;
      begin[i] = 0;
      ++walked_count_;
      walk_ray_inside(grid_, origin, rays.end_world_m(i), [&](VoxelIndex v) {
        if (marks_[v] == kUntouched) marks_[v] = kFreed;
        return true;
      });
    }
  }
}

ScanUpdate FrameInserter::collect(const FrameView& view) {
  ScanUpdate update;
  const int length = view.box_last[0] - view.box_first[0] + 1;
  for (int z = view.box_first[2]; z <= view.box_last[2]; ++z) {
    for (int y = view.box_first[1]; y <= view.box_last[1]; ++y) {
      const int first = (z * view.size[1] + y) * view.size[0] + view.box_first[0];
      std::uint8_t* const row = marks_.data() + first;
      for (int x = 0; x < length; ++x) {
        if (row[x] == kUntouched) continue;
        (row[x] == kEnd ? update.occupied : update.free).push_back(first + x);
      }
      std::memset(row, kUntouched, length);
    }
  }
  return update;
}

ScanUpdate FrameInserter::compute_update(const FrameRays& rays, const DepthFrame& frame,
                                         const CameraModel& camera, const OccupancyGrid& map,
                                         int threads) {
  GNBV_CHECK(map.geometry() == grid_, "another map than the one this inserter was made for");
  FrameView view = make_frame_view(grid_, rays, frame, camera);
  const int bands = view.level_stride / view.tile_stride;
  const std::size_t pixels = static_cast<std::size_t>(view.width) * view.height;
  GNBV_CHECK(rays.kind.size() == pixels, "{} rays for {} pixels", rays.kind.size(), pixels);
  int levels = 1;
  while ((1 << levels) < std::max(view.tile_stride, bands)) ++levels;
  tile_windows_.resize(static_cast<std::size_t>(levels) * view.level_stride);
  ends_.resize(bands);
  workers_.resize(std::max(threads, 1));
  for (Worker& worker : workers_) {
    worker.walk.resize(pixels, 0);
    worker.doubts.resize(pixels + kPadding);
    worker.ends.resize(view.width + kPadding);
  }
  const int workers = static_cast<int>(workers_.size());
  parallel_for(threads, workers_.size(), [&](std::size_t w) {
    for (int band = static_cast<int>(w); band < bands; band += workers) {
      read_band(view, rays, band, workers_[w]);
    }
  });
  widen_tiles(view, levels, tile_windows_.data());
  const float nearest_inverse =
      *std::min_element(tile_windows_.begin(), tile_windows_.begin() + view.level_stride);
  if (nearest_inverse == kNoRay) return {};
  set_reach(grid_, frame, camera, 1.0 / static_cast<double>(nearest_inverse), view);
  view.words = map.words().data();
  view.settled_word = map.settled_word();
  view.tile_windows = tile_windows_.data();
  for (const std::vector<VoxelIndex>& band : ends_) {
    for (const VoxelIndex v : band) marks_[v] = kEnd;
  }
  parallel_for(threads, workers_.size(), [&](std::size_t w) {
    const FrameMarks marks = {marks_.data(), workers_[w].walk.data(), workers_[w].doubts.data()};
    for (int z = view.box_first[2] + static_cast<int>(w); z <= view.box_last[2]; z += workers) {
      frame_kernels().project_layer(view, z, marks);
    }
  });
  walk_doubtful_rays(rays);
  return collect(view);
}

}  // namespace gnbv
