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
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {

/// Neighbouring tiles of one row: their rays, and memory for what these meet. A packet is a tile.
struct TileRun {
  int row = 0;
  int first = 0;  // tile of the row
  std::vector<RayPacket> directions_world;
  std::vector<HitPacket> hits;
  std::vector<std::array<float, RayPacket::kRays>> distances_m;
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
    GNBV_CHECK(width_px_ > 0 && height_px_ > 0, "camera {} has {} x {} pixels", camera.config.name,
               width_px_, height_px_);
    if (camera.lens) {
      lens_ = camera.lens.get();
      lens_->directions();  // made here, before threads ask for them
      return;
    }
    // the separable parts of CameraModel::ray_camera
    for (int u = 0; u < kTile_px * tiles_along(width_px_); ++u) {
      x_camera_.push_back(camera.ray_camera(std::min(u, width_px_ - 1), 0).x());
    }
    for (int v = 0; v < kTile_px * tiles_along(height_px_); ++v) {
      y_camera_.push_back(camera.ray_camera(0, std::min(v, height_px_ - 1)).y());
    }
  }

  std::size_t pixel_count() const {
    return static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_);
  }

  /// Calls use(run), the directions of its rays set, until every tile was in one run. A few rows of
  /// tiles are a task; the rays of a run stay in the first-level cache.
  template <typename Use>
  void for_each_run(int threads, const Use& use) const {
    constexpr int kRowsPerTask = 8;
    constexpr int kTilesPerRun = 20;
    const int rows = tiles_along(height_px_);
    const int columns = tiles_along(width_px_);
    const int tasks = (rows + kRowsPerTask - 1) / kRowsPerTask;
    parallel_for(threads, static_cast<std::size_t>(tasks), [&](std::size_t task) {
      TileRun run;
      run.row = static_cast<int>(task) * kRowsPerTask;
      for (const int end = std::min(run.row + kRowsPerTask, rows); run.row < end; ++run.row) {
        for (run.first = 0; run.first < columns; run.first += kTilesPerRun) {
          const auto count = static_cast<std::size_t>(std::min(kTilesPerRun, columns - run.first));
          run.directions_world.resize(count);
          run.hits.resize(count);
          run.distances_m.resize(count);
          set_directions(run);
          use(run);
        }
      }
    });
  }

  /// What looking this many pixels further right and down of that pixel adds to a direction.
  Vec3f shift_world(double right_px, double down_px, std::size_t pixel) const {
    if (lens_ != nullptr) {
      const auto width = static_cast<std::size_t>(width_px_);
      const auto there = lens_->direction_at(static_cast<double>(pixel % width) + 0.5 + right_px,
                                             static_cast<double>(pixel / width) + 0.5 + down_px);
      if (!there || !is_seen(pixel)) return Vec3f::Zero();
      return R_world_camera_ * (ray_of(there->cast<float>()) - ray_of(lens_->directions()[pixel]));
    }
    return static_cast<float>(right_px) * per_px_.x() * R_world_camera_.col(0) +
           static_cast<float>(down_px) * per_px_.y() * R_world_camera_.col(1);
  }

  /// Whether the lens sends anything to that pixel.
  bool is_seen(std::size_t pixel) const {
    return lens_ == nullptr || !std::isnan(lens_->directions()[pixel].x());
  }

  /// Puts the distances of a tile's rays into its pixels of a row-major image.
  void put_distances(const TileRun& run, std::size_t tile, std::span<float> image) const {
    const auto width = static_cast<std::size_t>(width_px_);
    const std::size_t u0 = (static_cast<std::size_t>(run.first) + tile) * kTile_px;
    const std::size_t v0 = static_cast<std::size_t>(run.row) * kTile_px;
    const auto v_end = std::min<std::size_t>(v0 + kTile_px, static_cast<std::size_t>(height_px_));
    const std::size_t u_count = std::min<std::size_t>(kTile_px, width - u0);
    const float* from = run.distances_m[tile].data();
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
    for (std::size_t tile = 0; tile < run.directions_world.size(); ++tile) {
      const int u0 = (run.first + static_cast<int>(tile)) * kTile_px;
      const int u_count = std::min(kTile_px, width_px_ - u0);
      for (int j = 0; j < v_count; ++j) {
        for (int i = 0; i < u_count; ++i) {
          use(tile, static_cast<std::size_t>(j * kTile_px + i),
              static_cast<std::size_t>(v0 + j) * static_cast<std::size_t>(width_px_) +
                  static_cast<std::size_t>(u0 + i));
        }
      }
    }
  }

 private:
  static constexpr int kTile_px = 4;
  static_assert(kTile_px * kTile_px == RayPacket::kRays);

  /// The ray along which ranges are measured; the axis where there is none.
  Vec3f ray_of(const Eigen::Vector2f& xy) const {
    if (std::isnan(xy.x())) return Vec3f::UnitZ();
    return lens_->is_radial() ? Vec3f(xy.homogeneous().normalized()) : Vec3f(xy.homogeneous());
  }

  void set_lens_directions(TileRun& run) const {
    for (std::size_t tile = 0; tile < run.directions_world.size(); ++tile) {
      RayPacket& packet = run.directions_world[tile];
      for (int ray = 0; ray < kTile_px * kTile_px; ++ray) {
        const int u = (run.first + static_cast<int>(tile)) * kTile_px + ray % kTile_px;
        const int v = run.row * kTile_px + ray / kTile_px;
        const int pixel = std::min(v, height_px_ - 1) * width_px_ + std::min(u, width_px_ - 1);
        const Vec3f along =
            R_world_camera_ * ray_of(lens_->directions()[static_cast<std::size_t>(pixel)]);
        const auto i = static_cast<std::size_t>(ray);
        packet.x[i] = along.x();
        packet.y[i] = along.y();
        packet.z[i] = along.z();
      }
    }
  }

  static int tiles_along(int side_px) { return (side_px + kTile_px - 1) / kTile_px; }

  /// Through the pixel centres. They reach z = 1 of the optical frame, so that distances along them
  /// are depths; those of a radial lens are of length 1.
  void set_directions(TileRun& run) const {
    if (lens_ != nullptr) return set_lens_directions(run);
    using Four = Eigen::Array4f;
    static_assert(kTile_px == Four::SizeAtCompileTime);
    const Vec3f right_world = R_world_camera_.col(0);
    for (std::size_t j = 0; j < kTile_px; ++j) {
      const float y = y_camera_[static_cast<std::size_t>(run.row) * kTile_px + j];
      const Vec3f row_world = R_world_camera_.col(2) + y * R_world_camera_.col(1);
      for (std::size_t tile = 0; tile < run.directions_world.size(); ++tile) {
        RayPacket& packet = run.directions_world[tile];
        const Four x(&x_camera_[(static_cast<std::size_t>(run.first) + tile) * kTile_px]);
        Four::Map(&packet.x[j * kTile_px]) = row_world.x() + x * right_world.x();
        Four::Map(&packet.y[j * kTile_px]) = row_world.y() + x * right_world.y();
        Four::Map(&packet.z[j * kTile_px]) = row_world.z() + x * right_world.z();
      }
    }
  }

  int width_px_;
  int height_px_;
  const Lens* lens_ = nullptr;  // of the camera
  Eigen::Matrix3f R_world_camera_;
  Eigen::Vector2f per_px_;       // of the plane z = 1, a pixel
  std::vector<float> x_camera_;  // of every column of the tiles
  std::vector<float> y_camera_;  // of every row of the tiles
};

}  // namespace gnbv
