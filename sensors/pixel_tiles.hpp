// The rays of an image, in the order in which they are traced.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sensors/camera_model.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {

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
    for (int u = 0; u < width_px_; ++u) x_camera_.push_back(camera.ray_camera(u, 0).x());
    for (int v = 0; v < height_px_; ++v) y_camera_.push_back(camera.ray_camera(0, v).y());
  }

  int rows() const { return (height_px_ + kTile_px - 1) / kTile_px; }

  /// Through the pixel centres of one row of tiles, tile by tile; they reach z = 1 of the optical
  /// frame, so that distances along them are depths.
  std::vector<Vec3f> directions_world(int tile_row) const {
    std::vector<Vec3f> directions;
    directions.reserve(x_camera_.size() * kTile_px + kTile_px * kTile_px);
    for (int u0 = 0; u0 < width_px_; u0 += kTile_px) {
      for (int j = 0; j < kTile_px; ++j) {
        const int v = std::min(tile_row * kTile_px + j, height_px_ - 1);
        const Vec3f row_world = R_world_camera_.col(2) +
                                y_camera_[static_cast<std::size_t>(v)] * R_world_camera_.col(1);
        for (int i = 0; i < kTile_px; ++i) {
          const int u = std::min(u0 + i, width_px_ - 1);
          directions.push_back(row_world +
                               x_camera_[static_cast<std::size_t>(u)] * R_world_camera_.col(0));
        }
      }
    }
    return directions;
  }

  /// What looking this many pixels further right and down adds to a direction.
  Vec3f shift_world(double right_px, double down_px) const {
    return static_cast<float>(right_px) * per_px_.x() * R_world_camera_.col(0) +
           static_cast<float>(down_px) * per_px_.y() * R_world_camera_.col(1);
  }

  /// Calls use(ray, pixel) with the indices of each pixel's direction and of the pixel itself,
  /// row-major.
  template <typename Use>
  void for_each_pixel(int tile_row, const Use& use) const {
    const int v0 = tile_row * kTile_px;
    std::size_t ray = 0;
    for (int u0 = 0; u0 < width_px_; u0 += kTile_px) {
      for (int v = v0; v < v0 + kTile_px; ++v) {
        for (int u = u0; u < u0 + kTile_px; ++u, ++ray) {
          if (u >= width_px_ || v >= height_px_) continue;
          use(ray, static_cast<std::size_t>(v) * static_cast<std::size_t>(width_px_) +
                       static_cast<std::size_t>(u));
        }
      }
    }
  }

 private:
  static constexpr int kTile_px = 4;

  int width_px_;
  int height_px_;
  Eigen::Matrix3f R_world_camera_;
  Eigen::Vector2f per_px_;       // of the plane z = 1, a pixel
  std::vector<float> x_camera_;  // (width)
  std::vector<float> y_camera_;  // (height)
};

/// Calls capture_row(tile_row) for every row, a few in a task.
template <typename CaptureRow>
void for_each_tile_row(const PixelTiles& tiles, int threads, const CaptureRow& capture_row) {
  constexpr int kRowsPerTask = 4;
  const int tasks = (tiles.rows() + kRowsPerTask - 1) / kRowsPerTask;
  parallel_for(threads, static_cast<std::size_t>(tasks), [&](std::size_t task) {
    const int first = static_cast<int>(task) * kRowsPerTask;
    const int last = std::min(first + kRowsPerTask, tiles.rows());
    for (int row = first; row < last; ++row) capture_row(row);
  });
}

}  // namespace gnbv
