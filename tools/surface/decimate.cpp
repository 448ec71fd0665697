#include "tools/surface/decimate.hpp"

#include <meshoptimizer.h>

#include "tools/surface/trim.hpp"

namespace gnbv {

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
