#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

Box3 bounds_m(const TriangleMesh& mesh) {
  Box3 box;
  for (const Vec3f& v : mesh.vertices_m) box.extend(v.cast<double>());
  return box;
}

double surface_area_m2(const TriangleMesh& mesh) {
  double area_m2 = 0.0;
  for (const auto& face : mesh.faces) {
    const Vec3 a = mesh.vertices_m[face[0]].cast<double>();
    const Vec3 b = mesh.vertices_m[face[1]].cast<double>();
    const Vec3 c = mesh.vertices_m[face[2]].cast<double>();
    area_m2 += 0.5 * (b - a).cross(c - a).norm();
  }
  return area_m2;
}

}  // namespace gnbv
