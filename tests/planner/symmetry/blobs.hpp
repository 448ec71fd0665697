// Heaps of spheres: structures whose symmetry is known in closed form.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/symmetry/symmetry.hpp"
#include "tests/planner/map/random_points.hpp"

namespace gnbv::test {

struct Sphere {
  Vec3 center_m;
  double radius_m;
};
using Blobs = std::vector<Sphere>;

const Box3 kBlobSpace(Vec3(-12, -12, 0), Vec3(12, 12, 6));

/// Spheres along an L in plan, all in x > 0.5, of random sizes and heights.
inline Blobs l_shaped_half(std::uint64_t seed) {
  Random random(seed);
  Blobs blobs;
  const auto add = [&](double x_m, double y_m) {
    const double radius_m = random.uniform(0.5, 1.1);
    blobs.push_back({{x_m + random.uniform(-0.3, 0.3), y_m + random.uniform(-0.3, 0.3),
                      radius_m + random.uniform(0.2, 2.5)},
                     radius_m});
  };
  for (int i = 0; i < 6; ++i) add(1.8, -6.0 + 1.4 * i);
  for (int i = 0; i < 4; ++i) add(3.2 + 1.4 * i, -6.0);
  return blobs;
}

/// The blobs, and behind them their images.
template <typename Map>
Blobs with_images(Blobs blobs, const Map& map) {
  const std::size_t count = blobs.size();
  for (std::size_t i = 0; i < count; ++i) {
    blobs.push_back({map(blobs[i].center_m), blobs[i].radius_m});
  }
  return blobs;
}

inline bool is_inside(const Blobs& blobs, const Vec3& p_m, double margin_m) {
  return std::any_of(blobs.begin(), blobs.end(), [&](const Sphere& sphere) {
    return (p_m - sphere.center_m).norm() < sphere.radius_m + margin_m;
  });
}

/// Points of the outer surface, evenly by a golden spiral, about one in a square of `spacing_m`.
inline std::vector<Vec3f> surface_points_m(const Blobs& blobs, double spacing_m) {
  std::vector<Vec3f> points;
  for (const Sphere& sphere : blobs) {
    const double area_m2 = 4.0 * kPi * sphere.radius_m * sphere.radius_m;
    const int count = static_cast<int>(area_m2 / (spacing_m * spacing_m));
    for (int i = 0; i < count; ++i) {
      const double z = 1.0 - (2.0 * i + 1.0) / count;
      const double azimuth_rad = kPi * (3.0 - std::sqrt(5.0)) * i;
      const double r = std::sqrt(1.0 - z * z);
      const Vec3 p_m = sphere.center_m + sphere.radius_m * Vec3(r * std::cos(azimuth_rad),
                                                                r * std::sin(azimuth_rad), z);
      if (!is_inside(blobs, p_m, -1e-6)) points.push_back(p_m.cast<float>());
    }
  }
  return points;
}

/// What a perfect sensor makes of them where `is_known`: points' voxels occupied, all outside the
/// spheres free, the inside unmeasured.
template <typename IsKnown>
OccupancyGrid measured_grid(const Blobs& blobs, const std::vector<Vec3f>& points_m,
                            const IsKnown& is_known) {
  OccupancyGrid grid({}, kBlobSpace);
  const GridGeometry& geometry = grid.geometry();
  ScanUpdate update;
  std::vector<bool> has_point(geometry.voxel_count());
  for (const Vec3f& p_m : points_m) has_point[geometry.index_of(geometry.key_of(p_m))] = true;
  for (VoxelIndex v = 0; v < geometry.voxel_count(); ++v) {
    const Vec3 center_m = geometry.center_m(geometry.key_at(v));
    if (has_point[v]) {
      update.occupied.push_back(v);
    } else if (is_known(center_m) && !is_inside(blobs, center_m, 0.0)) {
      update.free.push_back(v);
    }
  }
  grid.apply(update);
  return grid;
}

}  // namespace gnbv::test
