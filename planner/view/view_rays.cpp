#include "planner/view/view_rays.hpp"

#include <algorithm>
#include <cmath>

#include "planner/view/view_kernels.hpp"

namespace gnbv {
namespace {

/// Columns and rows of a camera's lattice; the spacing is one voxel.
struct Lattice {
  int columns;
  int rows;
  double depth_m;
  double spacing_m;

  /// Centred: the lattice rarely fits the plane exactly.
  Vec3 end_camera_m(int column, int row) const {
    return {(column - 0.5 * (columns - 1)) * spacing_m, (row - 0.5 * (rows - 1)) * spacing_m,
            depth_m};
  }
};

Lattice make_lattice(const CameraConfig& camera, double spacing_m) {
  const auto points = [&](double fov_rad) {
    const double half_m = camera.range_max_m * std::tan(0.5 * fov_rad);
    return static_cast<int>(2.0 * half_m / spacing_m) + 1;
  };
  return {points(camera.fov_x_rad), points(camera.fov_y_rad), camera.range_max_m, spacing_m};
}

/// Appends the ends in tiles.
void append_ends(const Lattice& lattice, const Isometry& T_body_camera, ViewRays& rays) {
  constexpr int kTile = 4;
  for (int top = 0; top < lattice.rows; top += kTile) {
    for (int left = 0; left < lattice.columns; left += kTile) {
      for (int row = top; row < std::min(top + kTile, lattice.rows); ++row) {
        for (int column = left; column < std::min(left + kTile, lattice.columns); ++column) {
          const Vec3 end_body_m = T_body_camera * lattice.end_camera_m(column, row);
          for (std::size_t a = 0; a < 3; ++a) {
            rays.end_body_m[a].push_back(end_body_m[static_cast<Eigen::Index>(a)]);
          }
        }
      }
    }
  }
}

}  // namespace

ViewRays make_view_rays(std::span<const CameraModel> cameras, double resolution_m) {
  ViewRays rays;
  rays.resolution_m = resolution_m;
  for (const CameraModel& model : cameras) {
    const Lattice lattice = make_lattice(model.config, resolution_m);
    ViewRays::Camera camera;
    camera.origin_body_m = model.T_body_camera.translation();
    camera.pyramid_m3 = lattice.spacing_m * lattice.spacing_m * lattice.depth_m / 3.0;
    camera.first = rays.end_body_m[0].size();
    append_ends(lattice, model.T_body_camera, rays);
    camera.count = rays.end_body_m[0].size() - camera.first;
    const std::size_t padded = (camera.count + kRayPadding - 1) / kRayPadding * kRayPadding;
    for (std::vector<double>& column : rays.end_body_m) column.resize(camera.first + padded, 0.0);
    for (int corner = 0; corner < 4; ++corner) {
      camera.corners_body_m[static_cast<std::size_t>(corner)] =
          model.T_body_camera *
          lattice.end_camera_m(corner % 2 * (lattice.columns - 1), corner / 2 * (lattice.rows - 1));
    }
    rays.cameras.push_back(camera);
  }
  return rays;
}

std::size_t ViewRays::count() const {
  std::size_t rays = 0;
  for (const Camera& camera : cameras) rays += camera.count;
  return rays;
}

}  // namespace gnbv
