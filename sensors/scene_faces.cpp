#include "sensors/scene_faces.hpp"

#include <algorithm>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr std::array<unsigned, SceneFaces::kParts> kMasks = {kStructureMask, kObstacleMask,
                                                             kTerrainMask};

/// Closest point of triangle abc to p: the region of p among vertices, edges and face decides
/// (Ericson, Real-Time Collision Detection 2005, section 5.1.5).
Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  if (d6 >= 0.0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  const double along_b = d4 - d3;
  const double along_c = d5 - d6;
  if (va <= 0.0 && along_b >= 0.0 && along_c >= 0.0) {
    return b + along_b / (along_b + along_c) * (c - b);
  }
  const double scale = 1.0 / (va + vb + vc);
  return a + vb * scale * ab + vc * scale * ac;
}

void need_indices(const TriangleMesh& mesh) {
  for (const auto& face : mesh.faces) {
    for (const std::uint32_t i : face) {
      GNBV_CHECK(i < mesh.vertices_m.size(), "face vertex {} of {}", i, mesh.vertices_m.size());
    }
  }
  GNBV_CHECK(mesh.face_material.empty() || mesh.face_material.size() == mesh.faces.size(),
             "{} materials of {} faces", mesh.face_material.size(), mesh.faces.size());
  for (const std::uint16_t i : mesh.face_material) {
    GNBV_CHECK(i < mesh.materials.size(), "material {} of {}", i, mesh.materials.size());
  }
  GNBV_CHECK(!mesh.materials.empty() || mesh.faces.empty(), "a mesh without materials");
}

}  // namespace

SceneFaces::SceneFaces(const World& world)
    : meshes_(world.structure), terrain_floor_z_m_(static_cast<float>(world.terrain_floor_z_m)) {
  need_indices(world.structure);
  add(1, world.obstacles);
  add(2, world.terrain);
}

void SceneFaces::add(std::size_t part, const TriangleMesh& mesh) {
  need_indices(mesh);
  first_face_[part] = static_cast<std::uint32_t>(meshes_.faces.size());
  if (!mesh.faces.empty()) append(meshes_, mesh);
}

bool SceneFaces::is_asked(std::size_t part, std::uint32_t face, unsigned masks) const {
  if ((masks & kMasks[part]) != 0) return true;
  if (kMasks[part] != kTerrainMask || (masks & kRisenTerrainMask) == 0) return false;
  const auto& corners = meshes_.faces[face];
  return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t vertex) {
    return meshes_.vertices_m[vertex].z() > terrain_floor_z_m_;
  });
}

double SceneFaces::distance_m(std::uint32_t face, const Vec3& p_world_m) const {
  const auto corner = [&](std::size_t i) -> Vec3 {
    return meshes_.vertices_m[meshes_.faces[face][i]].cast<double>();
  };
  return (closest_on_triangle(p_world_m, corner(0), corner(1), corner(2)) - p_world_m).norm();
}

Vec3f SceneFaces::normal_world(std::int32_t face) const {
  GNBV_CHECK(face >= 0, "the normal of nothing");
  const auto& [a, b, c] = meshes_.faces[static_cast<std::size_t>(face)];
  const std::vector<Vec3f>& p = meshes_.vertices_m;
  return (p[b] - p[a]).cross(p[c] - p[a]).stableNormalized();
}

const Material& SceneFaces::material(std::int32_t face) const {
  const std::vector<std::uint16_t>& of_face = meshes_.face_material;
  return meshes_.materials[of_face.empty() ? 0 : of_face[static_cast<std::size_t>(face)]];
}

}  // namespace gnbv
