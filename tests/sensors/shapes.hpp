// Worlds whose every distance is known, and a ray tracer too simple to be wrong.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>

#include "sim/mesh/world.hpp"

namespace gnbv::test {

inline World world_of(TriangleMesh mesh, bool has_ground) { return {std::move(mesh), has_ground}; }

/// Adds the rectangle corner, corner + a, corner + a + b, corner + b.
inline void add_rectangle(TriangleMesh& mesh, const Vec3& corner, const Vec3& a, const Vec3& b) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (const Vec3& p : {corner, Vec3(corner + a), Vec3(corner + a + b), Vec3(corner + b)}) {
    mesh.vertices_m.push_back(p.cast<float>());
  }
  mesh.faces.push_back({first, first + 1, first + 2});
  mesh.faces.push_back({first, first + 2, first + 3});
}

/// Wall in the plane x = x_m, over [y0, y1] x [z0, z1].
inline void add_wall(TriangleMesh& mesh, double x_m, double y0_m, double y1_m, double z0_m,
                     double z1_m) {
  add_rectangle(mesh, {x_m, y0_m, z0_m}, {0, y1_m - y0_m, 0}, {0, 0, z1_m - z0_m});
}

/// Icosahedron, each face split in four `splits` times, vertices on the sphere.
inline TriangleMesh sphere(const Vec3& centre_m, double radius_m, int splits) {
  const double t = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vec3> unit = {{-1, t, 0}, {1, t, 0}, {-1, -t, 0}, {1, -t, 0},
                            {0, -1, t}, {0, 1, t}, {0, -1, -t}, {0, 1, -t},
                            {t, 0, -1}, {t, 0, 1}, {-t, 0, -1}, {-t, 0, 1}};
  for (Vec3& v : unit) v.normalize();
  TriangleMesh mesh;
  mesh.faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int i = 0; i < splits; ++i) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(unit.size()));
      if (is_new) unit.push_back((unit[a] + unit[b]).normalized());
      return entry->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : mesh.faces) {
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.faces = std::move(finer);
  }
  for (const Vec3& v : unit) mesh.vertices_m.push_back((centre_m + radius_m * v).cast<float>());
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

inline std::array<Vec3, 3> corners(const TriangleMesh& mesh, std::size_t face) {
  const auto& [a, b, c] = mesh.faces[face];
  return {mesh.vertices_m[a].cast<double>(), mesh.vertices_m[b].cast<double>(),
          mesh.vertices_m[c].cast<double>()};
}

struct BruteHit {
  double distance = std::numeric_limits<double>::infinity();  // in units of the direction
  int face = -1;
  bool is_near_edge =
      false;  // some face is met so close to its rim that float may decide otherwise
};

/// First hit by Moeller and Trumbore 1997 in double, one triangle after another.
inline BruteHit brute_first_hit(const TriangleMesh& mesh, const Vec3& origin,
                                const Vec3& direction) {
  BruteHit best;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const auto [a, b, c] = corners(mesh, i);
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
