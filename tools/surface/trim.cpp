#include "tools/surface/trim.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "bench/score/point_tree.hpp"
#include "sim/core/error.hpp"
#include "sim/mesh/mesh_lint.hpp"

namespace gnbv {
namespace {

using Face = std::array<std::uint32_t, 3>;

constexpr float kReach_spacings = 2.0F;
constexpr int kSmoothings = 3;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// How far a place is from a point of a surface: off its tangent plane farther than along it. A cap
/// that closes a tube lies off the planes of the tube's points, a hole in a wall along them.
float distance_from_surface_m(const Vec3f& p_m, const Vec3f& point_m, const Vec3f& normal) {
  constexpr float kOffPlane = 2.0F;  // times as far
  const Vec3f away_m = p_m - point_m;
  const float off_m = away_m.dot(normal);
  return std::sqrt(std::max(0.0F, away_m.squaredNorm() - off_m * off_m) +
                   kOffPlane * kOffPlane * off_m * off_m);
}

/// How far a place is from a point, in multiples of that point's reach.
float distance_in_reaches(const Vec3f& p_m, const OrientedCloud& cloud, std::size_t point,
                          const TrimSettings& settings) {
  const Vec3f& point_m = cloud.points_world_m[point];
  if (settings.reach_m > 0.0) return (p_m - point_m).norm() / static_cast<float>(settings.reach_m);
  const float reach_m =
      std::min(kReach_spacings * cloud.spacing_m[point], static_cast<float>(settings.reach_max_m));
  return distance_from_surface_m(p_m, point_m, cloud.normals_world[point]) / reach_m;
}

/// Of each vertex to that of the points around which is nearest by this measure.
std::vector<float> distances_in_reaches(const TriangleMesh& mesh, const OrientedCloud& cloud,
                                        const TrimSettings& settings, int threads) {
  constexpr std::size_t kAround = 6;
  const PointTree tree(cloud.points_world_m);
  std::vector<float> field(mesh.vertices_m.size(), std::numeric_limits<float>::max());
  for_each_point(threads, field.size(), [&](std::size_t i) {
    const Vec3f& p_m = mesh.vertices_m[i];
    std::array<Neighbour, kAround> around{};
    for (const Neighbour& found : tree.nearest(p_m, around)) {
      field[i] = std::min(field[i], distance_in_reaches(p_m, cloud, found.point, settings));
    }
  });
  return field;
}

/// Each vertex becomes the mean of itself and its neighbours along edges.
void smooth(const TriangleMesh& mesh, std::vector<float>& field) {
  std::vector<float> sum = field;
  std::vector<float> count(field.size(), 1.0F);
  for (const Face& face : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum[face[k]] += field[face[(k + 1) % 3]];  // the other way comes with the other face
      count[face[k]] += 1.0F;
    }
  }
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = sum[i] / count[i];
}

/// Vertices where edges cross the level, each edge's once.
class Crossings {
 public:
  Crossings(std::span<const float> field, float level, std::vector<Vec3f>& vertices_m)
      : field_(field), level_(level), vertices_m_(vertices_m) {}

  std::uint32_t on_edge(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);  // the same from both sides
    const auto [entry, is_new] = made_.try_emplace((std::uint64_t{a} << 32) | b, kNone);
    if (is_new) {
      const float t = (level_ - field_[a]) / (field_[b] - field_[a]);
      entry->second = static_cast<std::uint32_t>(vertices_m_.size());
      const Vec3f p_m = vertices_m_[a] + t * (vertices_m_[b] - vertices_m_[a]);
      vertices_m_.push_back(p_m);
    }
    return entry->second;
  }

 private:
  std::span<const float> field_;
  float level_;
  std::vector<Vec3f>& vertices_m_;
  std::unordered_map<std::uint64_t, std::uint32_t> made_;
};

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t vertex) {
  while (parent[vertex] != vertex) vertex = parent[vertex] = parent[parent[vertex]];
  return vertex;
}

/// For each face the lowest vertex of its part.
std::vector<std::uint32_t> parts_of(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertices_m.size());
  std::iota(parent.begin(), parent.end(), 0U);
  for (const Face& face : mesh.faces) {
    for (std::size_t k = 1; k < 3; ++k) {
      const std::uint32_t a = root_of(parent, face[0]);
      const std::uint32_t b = root_of(parent, face[k]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<std::uint32_t> parts;
  parts.reserve(mesh.faces.size());
  for (const Face& face : mesh.faces) parts.push_back(root_of(parent, face[0]));
  return parts;
}

}  // namespace

TriangleMesh cut_at_level(const TriangleMesh& mesh, std::span<const float> field, float level) {
  GNBV_CHECK(field.size() == mesh.vertices_m.size(), "{} values", field.size());
  TriangleMesh cut;
  cut.vertices_m = mesh.vertices_m;
  Crossings crossings(field, level, cut.vertices_m);
  for (const Face& face : mesh.faces) {
    const auto is_below = [&](std::size_t k) { return field[face[k % 3]] < level; };
    const int below = is_below(0) + is_below(1) + is_below(2);
    if (below == 3) cut.faces.push_back(face);
    if (below == 0 || below == 3) continue;
    std::size_t odd = 0;  // the corner that is alone on its side
    while (is_below(odd) != (below == 1)) ++odd;
    const std::uint32_t a = face[odd];
    const std::uint32_t b = face[(odd + 1) % 3];
    const std::uint32_t c = face[(odd + 2) % 3];
    const std::uint32_t ab = crossings.on_edge(a, b);
    const std::uint32_t ca = crossings.on_edge(c, a);
    if (below == 1) {
      cut.faces.push_back({a, ab, ca});
    } else {
      cut.faces.push_back({ab, b, c});
      cut.faces.push_back({ab, c, ca});
    }
  }
  return cut;
}

TriangleMesh without_scraps(const TriangleMesh& mesh, double part_min_m2) {
  const std::vector<std::uint32_t> parts = parts_of(mesh);
  std::vector<double> part_m2(mesh.vertices_m.size(), 0.0);
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    part_m2[parts[i]] += face_area_m2(mesh, i);
  }
  TriangleMesh kept;
  std::vector<std::uint32_t> new_index(mesh.vertices_m.size(), kNone);
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    if (part_m2[parts[i]] < part_min_m2 || !(face_area_m2(mesh, i) > 0.0)) continue;
    kept.faces.push_back(mesh.faces[i]);
    for (const std::uint32_t vertex : mesh.faces[i]) new_index[vertex] = 0;
  }
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
    if (new_index[i] == kNone) continue;
    new_index[i] = static_cast<std::uint32_t>(kept.vertices_m.size());
    kept.vertices_m.push_back(mesh.vertices_m[i]);
  }
  for (Face& face : kept.faces) {
    for (std::uint32_t& vertex : face) vertex = new_index[vertex];
  }
  return kept;
}

TriangleMesh trimmed(const TriangleMesh& closed, const OrientedCloud& cloud,
                     const TrimSettings& settings, int threads) {
  GNBV_CHECK(!cloud.points_world_m.empty(), "no points");
  std::vector<float> field = distances_in_reaches(closed, cloud, settings, threads);
  for (int i = 0; i < kSmoothings; ++i) smooth(closed, field);
  return without_scraps(cut_at_level(closed, field, 1.0F), 0.0);
}

TriangleMesh decimated(const TriangleMesh& mesh, double tolerance_m) {
  if (mesh.faces.empty() || !(tolerance_m > 0.0)) return mesh;
  static_assert(sizeof(Vec3f) == 3 * sizeof(float));
  const float* const positions_m = mesh.vertices_m.front().data();
  const std::size_t vertices = mesh.vertices_m.size();
  const float extent_m = meshopt_simplifyScale(positions_m, vertices, sizeof(Vec3f));
  TriangleMesh fewer;
  fewer.vertices_m = mesh.vertices_m;
  fewer.faces.resize(mesh.faces.size());
  const std::size_t indices = meshopt_simplify(
      fewer.faces.front().data(), mesh.faces.front().data(), 3 * mesh.faces.size(), positions_m,
      vertices, sizeof(Vec3f), 0, static_cast<float>(tolerance_m) / extent_m, 0, nullptr);
  fewer.faces.resize(indices / 3);
  return without_scraps(fewer, 0.0);
}

}  // namespace gnbv
