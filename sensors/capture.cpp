#include "sensors/capture.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

// A packet of 16 rays is a square of pixels: the fastest shape measured with Embree's coherent
// packets (4x2 and 16x1 pixels are slower). Tiles start at pixel (0, 0) whatever the threads do.
constexpr int kTile_px = 4;
constexpr std::size_t kTilePixels = 16;
constexpr int kTileRowsPerTask = 4;

/// Traced from the sensor itself: what is too near to be measured still hides what lies behind it.
constexpr float kTraceFrom_m = 0.0F;

float measured_range(float distance_m, double range_min_m) {
  return distance_m < static_cast<float>(range_min_m) ? kInvalidRange : distance_m;
}

/// The separable parts of CameraModel::ray_camera for every column and row.
struct PixelGrid {
  std::vector<float> x_camera;  // (width)
  std::vector<float> y_camera;  // (height)

  explicit PixelGrid(const CameraModel& camera) {
    for (int u = 0; u < camera.config.width_px; ++u)
      x_camera.push_back(camera.ray_camera(u, 0).x());
    for (int v = 0; v < camera.config.height_px; ++v) {
      y_camera.push_back(camera.ray_camera(0, v).y());
    }
  }
};

/// Traces one row of tiles into the frame. Tiles that overhang the image repeat its last column or
/// row, so that every packet is full.
void capture_tile_row(const RayScene& scene, const CameraModel& camera, const PixelGrid& grid,
                      int tile_row, DepthFrame& frame) {
  const int width = camera.config.width_px;
  const int height = camera.config.height_px;
  const auto tiles = static_cast<std::size_t>((width + kTile_px - 1) / kTile_px);
  const Eigen::Matrix3f R_world_camera = frame.T_world_camera.linear().cast<float>();
  const Vec3f origin_world_m = frame.T_world_camera.translation().cast<float>();

  std::array<Vec3f, kTile_px> row_world;
  for (int j = 0; j < kTile_px; ++j) {
    const int v = std::min(tile_row * kTile_px + j, height - 1);
    row_world[static_cast<std::size_t>(j)] =
        R_world_camera.col(2) + grid.y_camera[static_cast<std::size_t>(v)] * R_world_camera.col(1);
  }
  std::vector<Vec3f> directions_world;
  directions_world.reserve(tiles * kTilePixels);
  for (int u0 = 0; u0 < width; u0 += kTile_px) {
    for (const Vec3f& row : row_world) {
      for (int i = 0; i < kTile_px; ++i) {
        const auto u = static_cast<std::size_t>(std::min(u0 + i, width - 1));
        directions_world.push_back(row + grid.x_camera[u] * R_world_camera.col(0));
      }
    }
  }

  std::vector<RayHit> hits(directions_world.size());
  scene.first_hits(origin_world_m, directions_world, kTraceFrom_m,
                   static_cast<float>(camera.config.range_max_m), hits);

  std::size_t ray = 0;
  for (int u0 = 0; u0 < width; u0 += kTile_px) {
    for (int j = 0; j < kTile_px; ++j) {
      for (int i = 0; i < kTile_px; ++i, ++ray) {
        const int u = u0 + i;
        const int v = tile_row * kTile_px + j;
        if (u >= width || v >= height) continue;
        // the directions reach z = 1 of the optical frame, so distances along them are depths
        frame.depth_m[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(u)] =
            measured_range(hits[ray].distance_m, camera.config.range_min_m);
      }
    }
  }
}

}  // namespace

DepthFrame capture_depth(const RayScene& scene, const CameraModel& camera, int camera_index,
                         const Isometry& T_world_body, int threads) {
  const int width = camera.config.width_px;
  const int height = camera.config.height_px;
  GNBV_CHECK(width > 0 && height > 0, "camera {} has {} x {} pixels", camera.config.name, width,
             height);
  DepthFrame frame;
  frame.camera = camera_index;
  frame.T_world_camera = T_world_body * camera.T_body_camera;
  frame.depth_m.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));

  const PixelGrid grid(camera);
  const int tile_rows = (height + kTile_px - 1) / kTile_px;
  const int tasks = (tile_rows + kTileRowsPerTask - 1) / kTileRowsPerTask;
  parallel_for(threads, static_cast<std::size_t>(tasks), [&](std::size_t task) {
    const int first = static_cast<int>(task) * kTileRowsPerTask;
    const int last = std::min(first + kTileRowsPerTask, tile_rows);
    for (int row = first; row < last; ++row) capture_tile_row(scene, camera, grid, row, frame);
  });
  return frame;
}

LidarScan capture_scan(const RayScene& scene, const LidarConfig& lidar,
                       const Isometry& T_world_body) {
  LidarScan scan;
  scan.T_world_lidar = T_world_body * T_body_lidar(lidar);
  const Eigen::Matrix3f R_world_lidar = scan.T_world_lidar.linear().cast<float>();
  std::vector<Vec3f> directions_world;
  directions_world.reserve(static_cast<std::size_t>(lidar.beams));
  for (int beam = 0; beam < lidar.beams; ++beam) {
    directions_world.push_back(R_world_lidar * beam_lidar(lidar, beam));
  }
  std::vector<RayHit> hits(directions_world.size());
  scene.first_hits(scan.T_world_lidar.translation().cast<float>(), directions_world, kTraceFrom_m,
                   static_cast<float>(lidar.range_max_m), hits);
  scan.range_m.reserve(hits.size());
  for (const RayHit& hit : hits) {
    scan.range_m.push_back(measured_range(hit.distance_m, lidar.range_min_m));
  }
  return scan;
}

}  // namespace gnbv
