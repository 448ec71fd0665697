// Worlds whose every distance is known, and a ray tracer too simple to be wrong.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "sim/mesh/world.hpp"
#include "tests/bench/shapes.hpp"

namespace gnbv::test {

inline World world_of(TriangleMesh mesh, bool has_ground) { return {std::move(mesh), has_ground}; }

/// Wall in the plane x = x_m, over [y0, y1] x [z0, z1].
inline void add_wall(TriangleMesh& mesh, double x_m, double y0_m, double y1_m, double z0_m,
                     double z1_m) {
  add_sheet(mesh, {x_m, y0_m, z0_m}, {0, y1_m - y0_m, 0}, {0, 0, z1_m - z0_m});
}

/// By 128 parallels and twice as many meridians, vertices on the sphere: no point of it lies nearer
/// to the centre than 0.9998 of the radius.
inline TriangleMesh sphere(const Vec3& centre_m, double radius_m) {
  constexpr std::uint32_t kRings = 128, kAround = 2 * kRings;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i <= kRings; ++i) {
    const double polar_rad = kPi * i / kRings;
    for (std::uint32_t j = 0; j < kAround; ++j) {
      const double around_rad = kPi * j / kRings;
      const Vec3 unit(std::sin(polar_rad) * std::cos(around_rad),
                      std::sin(polar_rad) * std::sin(around_rad), std::cos(polar_rad));
      mesh.vertices_m.push_back((centre_m + radius_m * unit).cast<float>());
      if (i == kRings) continue;
      const std::uint32_t a = i * kAround + j, b = i * kAround + (j + 1) % kAround;
      mesh.faces.push_back({a, a + kAround, b + kAround});
      mesh.faces.push_back({a, b + kAround, b});
    }
  }
  return mesh;
}

/// Triangles of about 1 m thrown into [-extent, extent]^3 around `centre_m`.
inline TriangleMesh random_soup(int triangles, double extent_m, const Vec3& centre_m,
                                unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  const auto vector = [&] {
    const double x = coordinate(generator);
    const double y = coordinate(generator);
    return Vec3(x, y, coordinate(generator));
  };
  TriangleMesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const Vec3 middle = centre_m + extent_m * vector();
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (int k = 0; k < 3; ++k) mesh.vertices_m.push_back((middle + vector()).cast<float>());
    mesh.faces.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

struct BruteHit {
  double distance = std::numeric_limits<double>::infinity();  // in units of the direction
  int face = -1;
  bool is_near_edge = false;  // of some face, so that float may decide otherwise
};

/// First hit by Moeller and Trumbore 1997 in double, one triangle after another.
inline BruteHit brute_first_hit(const TriangleMesh& mesh, const Vec3& origin,
                                const Vec3& direction) {
  BruteHit best;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const auto [a, b, c] = face_corners_m(mesh, i);
    const Vec3 p = direction.cross(c - a);
    const double det = (b - a).dot(p);
    if (det == 0.0) continue;
    const double u = (origin - a).dot(p) / det;
    const Vec3 q = (origin - a).cross(b - a);
    const double v = direction.dot(q) / det;
    const double t = (c - a).dot(q) / det;
    const double inside = std::min({u, v, 1.0 - u - v});
    if (t > 0.0 && std::abs(inside) < 1e-4) best.is_near_edge = true;
    if (inside < 0.0 || !(t > 0.0)) continue;
    if (t < best.distance) {
      best.distance = t;
      best.face = static_cast<int>(i);
    }
  }
  return best;
}

}  // namespace gnbv::test
