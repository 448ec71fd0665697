// Boxes and sheets whose voxels can be counted on paper.
#pragma once

#include "sim/mesh/world.hpp"

namespace gnbv::test {

/// Adds the rectangle corner, corner + a, corner + a + b, corner + b.
inline void add_sheet(TriangleMesh& mesh, const Vec3& corner, const Vec3& a, const Vec3& b) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (const Vec3& p : {corner, Vec3(corner + a), Vec3(corner + a + b), Vec3(corner + b)}) {
    mesh.vertices_m.push_back(p.cast<float>());
  }
  mesh.faces.push_back({first, first + 1, first + 2});
  mesh.faces.push_back({first, first + 2, first + 3});
}

/// Adds five or, with the lid, six sides of a box.
inline void add_box(TriangleMesh& mesh, const Vec3& min, const Vec3& size, bool with_lid = true) {
  const Vec3 x(size.x(), 0, 0);
  const Vec3 y(0, size.y(), 0);
  const Vec3 z(0, 0, size.z());
  add_sheet(mesh, min, y, x);
  if (with_lid) add_sheet(mesh, min + z, x, y);
  add_sheet(mesh, min, x, z);
  add_sheet(mesh, min + y, z, x);
  add_sheet(mesh, min, z, y);
  add_sheet(mesh, min + x, y, z);
}

}  // namespace gnbv::test
