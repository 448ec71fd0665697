// A structure: triangles with named materials, in world coordinates (metres, z up).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

struct Material {
  std::string name = "default";
  std::array<float, 3> rgb = {0.7F, 0.7F, 0.7F};  // linear, each in [0, 1]
};

struct TriangleMesh {
  std::vector<Vec3f> vertices_m;                    // (n, 3)
  std::vector<std::array<std::uint32_t, 3>> faces;  // (m, 3), counter-clockwise seen from outside
  std::vector<Material> materials = {Material{}};
  std::vector<std::uint16_t> face_material;  // (m), index into materials; empty = all 0
};

/// Smallest box around the vertices; empty for a mesh without vertices.
Box3 bounds_m(const TriangleMesh& mesh);

/// Sum of the triangles' areas, two-sided faces counted twice.
double surface_area_m2(const TriangleMesh& mesh);

}  // namespace gnbv
