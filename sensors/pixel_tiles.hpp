// The rays of an image, in the order in which they are traced.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "sensors/camera_model.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {

/// Neighbouring tiles of one row.
struct TileRun {
  int row = 0;
  int first = 0;  // tile of the row
  int count = 0;
};

/// An image cut into squares of 16 pixels, each a packet of rays: the fastest shape measured with
/// Embree's coherent packets (4x2 and 16x1 pixels are slower). Tiles start at pixel (0, 0); those
/// that overhang the image repeat its last column or row, so that every packet is full.
class PixelTiles {
 public:
  PixelTiles(const CameraModel& camera, const Isometry& T_world_camera)
      : width_px_(camera.config.width_px),
        height_px_(camera.config.height_px),
        R_world_camera_(T_world_camera.linear().cast<float>()),
        per_px_(static_cast<float>(1.0 / camera.fx_px), static_cast<float>(1.0 / camera.fy_px)) {
    // the separable parts of CameraModel::ray_camera
    for (int u = 0; u < kTile_px * columns(); ++u) {
      x_camera_.push_back(camera.ray_camera(std::min(u, width_px_ - 1), 0).x());
    }
    for (int v = 0; v < kTile_px * rows(); ++v) {
      y_camera_.push_back(camera.ray_camera(0, std::min(v, height_px_ - 1)).y());
    }
  }

  /// Rows of tiles, and tiles a row.
  int rows() const { return (height_px_ + kTile_px - 1) / kTile_px; }
  int columns() const { return (width_px_ + kTile_px - 1) / kTile_px; }

  /// Through the pixel centres, a packet a tile; they reach z = 1 of the optical frame, so that
  /// distances along them are depths.
  void directions_world(const TileRun& run, std::span<RayPacket> packets) const {
    using Four = Eigen::Array4f;
    static_assert(kTile_px == Four::SizeAtCompileTime);
    const Vec3f right_world = R_world_camera_.col(0);
    for (std::size_t j = 0; j < kTile_px; ++j) {
      const float y = y_camera_[static_cast<std::size_t>(run.row) * kTile_px + j];
      const Vec3f row_world = R_world_camera_.col(2) + y * R_world_camera_.col(1);
      for (std::size_t tile = 0; tile < packets.size(); ++tile) {
        RayPacket& packet = packets[tile];
        const Four x(&x_camera_[(static_cast<std::size_t>(run.first) + tile) * kTile_px]);
        Four::Map(&packet.x[j * kTile_px]) = row_world.x() + x * right_world.x();
        Four::Map(&packet.y[j * kTile_px]) = row_world.y() + x * right_world.y();
        Four::Map(&packet.z[j * kTile_px]) = row_world.z() + x * right_world.z();
      }
    }
  }

  /// What looking this many pixels further right and down adds to a direction.
  Vec3f shift_world(double right_px, double down_px) const {
    return static_cast<float>(right_px) * per_px_.x() * R_world_camera_.col(0) +
           static_cast<float>(down_px) * per_px_.y() * R_world_camera_.col(1);
  }

  /// Puts one number a ray of a tile into its pixels of a row-major image, row by row of the tile.
  void put(const TileRun& run, std::size_t tile, const std::array<float, RayPacket::kRays>& values,
           std::span<float> image) const {
    const auto width = static_cast<std::size_t>(width_px_);
    const std::size_t u0 = (static_cast<std::size_t>(run.first) + tile) * kTile_px;
    const std::size_t v0 = static_cast<std::size_t>(run.row) * kTile_px;
    const auto v_end = std::min<std::size_t>(v0 + kTile_px, static_cast<std::size_t>(height_px_));
    const std::size_t u_count = std::min<std::size_t>(kTile_px, width - u0);
    const float* from = values.data();
    for (std::size_t v = v0; v < v_end; ++v, from += kTile_px) {
      float* const to = &image[v * width + u0];
      if (u_count == kTile_px) {
        std::memcpy(to, from, kTile_px * sizeof(float));  // of a constant length: a single move
      } else {
        std::memcpy(to, from, u_count * sizeof(float));
      }
    }
  }

  /// Calls use(tile, ray, pixel) for each pixel: its tile in the run, its place in the tile's
  /// packet, and its own index in the image, row-major.
  template <typename Use>
  void for_each_pixel(const TileRun& run, const Use& use) const {
    const int v0 = run.row * kTile_px;
    const int v_count = std::min(kTile_px, height_px_ - v0);
    for (int tile = 0; tile < run.count; ++tile) {
      const int u0 = (run.first + tile) * kTile_px;
      const int u_count = std::min(kTile_px, width_px_ - u0);
      for (int j = 0; j < v_count; ++j) {
        for (int i = 0; i < u_count; ++i) {
          use(static_cast<std::size_t>(tile), static_cast<std::size_t>(j * kTile_px + i),
              static_cast<std::size_t>(v0 + j) * static_cast<std::size_t>(width_px_) +
                  static_cast<std::size_t>(u0 + i));
        }
      }
    }
  }

 private:
  static constexpr int kTile_px = 4;
  static_assert(kTile_px * kTile_px == RayPacket::kRays);

  int width_px_;
  int height_px_;
  Eigen::Matrix3f R_world_camera_;
  Eigen::Vector2f per_px_;       // of the plane z = 1, a pixel
  std::vector<float> x_camera_;  // of every column of the tiles
  std::vector<float> y_camera_;  // of every row of the tiles
};

/// Memory for the rays of a run.
struct RunRays {
  std::vector<RayPacket> directions_world;
  std::vector<HitPacket> hits;
  std::vector<std::array<float, RayPacket::kRays>> distances_m;

  void resize(int tiles) {
    const auto count = static_cast<std::size_t>(tiles);
    directions_world.resize(count);
    hits.resize(count);
    distances_m.resize(count);
  }
};

/// Calls capture_run(run, rays) until every tile was in one run; a few rows of tiles are a task,
/// and a run is short enough for its rays to stay in the first-level cache.
template <typename CaptureRun>
void for_each_tile_run(const PixelTiles& tiles, int threads, const CaptureRun& capture_run) {
  constexpr int kRowsPerTask = 8;
  constexpr int kTilesPerRun = 20;
  const int tasks = (tiles.rows() + kRowsPerTask - 1) / kRowsPerTask;
  parallel_for(threads, static_cast<std::size_t>(tasks), [&](std::size_t task) {
    RunRays rays;
    const int first_row = static_cast<int>(task) * kRowsPerTask;
    const int last_row = std::min(first_row + kRowsPerTask, tiles.rows());
    for (int row = first_row; row < last_row; ++row) {
      for (int first = 0; first < tiles.columns(); first += kTilesPerRun) {
        const TileRun run = {row, first, std::min(kTilesPerRun, tiles.columns() - first)};
        rays.resize(run.count);
        capture_run(run, rays);
      }
    }
  });
}

}  // namespace gnbv
