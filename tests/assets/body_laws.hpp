// How the closed bodies of a mesh lie to each other, by brute force, for the tests of structures.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "sim/mesh/triangle_mesh.hpp"
#include "tests/assets/mesh_laws.hpp"

namespace gnbv {

struct Triangle {
  Vec3 a, b, c;
  Vec3 area_vector() const { return 0.5 * (b - a).cross(c - a); }
  Vec3 middle() const { return (a + b + c) / 3.0; }
};

struct Body {
  Part part;
  Box3 box;
  Triangle triangle(std::size_t face) const {
    const auto& f = part.faces[face];
    return {part.points_m[f[0]], part.points_m[f[1]], part.points_m[f[2]]};
  }
};

/// The connected parts of a mesh, each with its own points.
inline std::vector<Body> bodies_of(const TriangleMesh& mesh) {
  std::vector<Body> bodies;
  for (const Faces& faces : connected_parts(mesh.faces, mesh.vertices_m.size())) {
    Body body;
    std::map<std::uint32_t, std::uint32_t> own;
    for (const auto& f : faces) {
      std::array<std::uint32_t, 3> face{};
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [at, is_new] =
            own.try_emplace(f[i], static_cast<std::uint32_t>(body.part.points_m.size()));
        if (is_new) body.part.points_m.push_back(mesh.vertices_m[f[i]].cast<double>());
        face[i] = at->second;
      }
      body.part.faces.push_back(face);
    }
    for (const Vec3& p : body.part.points_m) body.box.extend(p);
    bodies.push_back(std::move(body));
  }
  return bodies;
}

inline bool is_inside(const Body& body, const Vec3& p_m) {
  return body.box.contains(p_m) && winding_number(body.part, p_m) > 0.5;
}

/// Where the line from `origin` along `direction` meets the triangle, in lengths of `direction`
/// (Moeller and Trumbore 1997); nothing behind the origin.
inline std::optional<double> meets(const Triangle& t, const Vec3& origin, const Vec3& direction) {
  const Vec3 ab = t.b - t.a, ac = t.c - t.a, across = direction.cross(ac);
  const double det = ab.dot(across);
  if (std::abs(det) < 1e-14) return std::nullopt;
  const Vec3 from_a = origin - t.a, q = from_a.cross(ab);
  const double u = from_a.dot(across) / det, v = direction.dot(q) / det, s = ac.dot(q) / det;
  if (u < 0.0 || v < 0.0 || u + v > 1.0 || s < 0.0) return std::nullopt;
  return s;
}

/// Does an edge of `a` pass through a face of `b`?
inline bool edges_pierce(const Body& a, const Body& b) {
  for (const auto& f : a.part.faces)
    for (std::size_t i = 0; i < 3; ++i) {
      if (f[i] > f[(i + 1) % 3]) continue;  // every edge once
      const Vec3 &from = a.part.points_m[f[i]], &to = a.part.points_m[f[(i + 1) % 3]];
      Box3 edge(from);
      edge.extend(to);
      if (!edge.intersects(b.box)) continue;
      for (std::size_t face = 0; face < b.part.faces.size(); ++face)
        if (meets(b.triangle(face), from, to - from).value_or(2.0) <= 1.0) return true;
    }
  return false;
}

/// Shared area of two triangles in one plane: the one clipped by the other's sides.
inline double overlap_m2(const Triangle& s, const Triangle& t) {
  const Vec3 normal = t.area_vector().normalized();
  std::vector<Vec3> polygon = {s.a, s.b, s.c};
  for (const auto& [from, to] : {std::pair{t.a, t.b}, {t.b, t.c}, {t.c, t.a}}) {
    const Vec3 inward = normal.cross(to - from);
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const double dp = (p - from).dot(inward), dq = (q - from).dot(inward);
      if (dp >= 0.0) kept.push_back(p);
      if ((dp >= 0.0) != (dq >= 0.0)) kept.push_back(p + (q - p) * (dp / (dp - dq)));
    }
    polygon = std::move(kept);
  }
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += 0.5 * (polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]);
  return sum.norm();
}

inline double distance_m(const Triangle& t, const Vec3& p_m) {
  const Vec3 normal = t.area_vector().normalized();
  const double above_m = (p_m - t.a).dot(normal);
  bool is_over = true;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : {std::pair{t.a, t.b}, {t.b, t.c}, {t.c, t.a}}) {
    const Vec3 side = to - from, way = p_m - from;
    is_over = is_over && normal.cross(side).dot(way) >= 0.0;
    const double along = std::clamp(way.dot(side) / side.squaredNorm(), 0.0, 1.0);
    nearest_m = std::min(nearest_m, (way - along * side).norm());
  }
  return is_over ? std::abs(above_m) : nearest_m;
}

}  // namespace gnbv
