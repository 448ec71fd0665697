#include "sim/mesh/triangle_mesh.hpp"

#include "sim/core/error.hpp"

namespace gnbv {

std::array<Vec3, 3> face_corners_m(const TriangleMesh& mesh, std::size_t face) {
  const auto& [a, b, c] = mesh.faces[face];
  return {mesh.vertices_m[a].cast<double>(), mesh.vertices_m[b].cast<double>(),
          mesh.vertices_m[c].cast<double>()};
}

double face_area_m2(const TriangleMesh& mesh, std::size_t face) {
  const auto [a, b, c] = face_corners_m(mesh, face);
  return 0.5 * (b - a).cross(c - a).norm();
}

bool is_flat(const TriangleMesh& mesh, std::size_t face) {
  const auto [a, b, c] = face_corners_m(mesh, face);
  const double longest2 =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return (b - a).cross(c - a).norm() <= 1e-7 * longest2;
}

void append(TriangleMesh& mesh, const TriangleMesh& more) {
  constexpr std::size_t kMostMaterials = std::numeric_limits<std::uint16_t>::max() + std::size_t{1};
  if (mesh.materials.size() + more.materials.size() > kMostMaterials) {
    throw BadInput("the meshes have more than {} materials together", kMostMaterials);
  }
  const auto first_vertex = static_cast<std::uint32_t>(mesh.vertices_m.size());
  const std::size_t first_material = mesh.materials.size();
  if (!mesh.face_looks.empty() || !more.face_looks.empty()) {
    mesh.face_looks.resize(mesh.faces.size());
    mesh.face_looks.insert(mesh.face_looks.end(), more.face_looks.begin(), more.face_looks.end());
    mesh.face_looks.resize(mesh.faces.size() + more.faces.size());
  }
  mesh.face_material.resize(mesh.faces.size(), 0);
  mesh.vertices_m.insert(mesh.vertices_m.end(), more.vertices_m.begin(), more.vertices_m.end());
  mesh.materials.insert(mesh.materials.end(), more.materials.begin(), more.materials.end());
  for (std::size_t i = 0; i < more.faces.size(); ++i) {
    const auto& [a, b, c] = more.faces[i];
    mesh.faces.push_back({first_vertex + a, first_vertex + b, first_vertex + c});
    mesh.face_material.push_back(static_cast<std::uint16_t>(first_material + material_of(more, i)));
  }
}

TriangleMesh box_mesh(const Box3& box_m, const Material& material) {
  TriangleMesh mesh;
  mesh.materials = {material};
  for (int corner = 0; corner < 8; ++corner) {  // bit 0: high x, bit 1: high y, bit 2: high z
    mesh.vertices_m.push_back(box_m.corner(static_cast<Box3::CornerType>(corner)).cast<float>());
  }
  mesh.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  mesh.face_material.assign(mesh.faces.size(), 0);
  return mesh;
}

Box3 bounds_m(const TriangleMesh& mesh) {
  Box3 box;
  for (const Vec3f& v : mesh.vertices_m) box.extend(v.cast<double>());
  return box;
}

double surface_area_m2(const TriangleMesh& mesh) {
  double area_m2 = 0.0;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) area_m2 += face_area_m2(mesh, i);
  return area_m2;
}

}  // namespace gnbv
