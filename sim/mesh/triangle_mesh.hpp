// A structure: triangles with named materials, in world coordinates (metres, z up).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// Procedural textures, solid in space, so that they need no texture coordinates
/// (sim/mesh/texture.hpp).
enum class Pattern {
  plain,    // rgb everywhere
  noise,    // clouds of rgb and rgb_2: paint, soil, concrete
  panels,   // sheets of rgb with joints of rgb_2, each sheet a little lighter or darker
  bricks,   // courses of rgb in mortar of rgb_2
  stripes,  // bands of rgb and rgb_2, stacked in z
  checker   // cubes of rgb and rgb_2
};

struct Material {
  std::string name = "default";
  std::array<float, 3> rgb = {0.7F, 0.7F, 0.7F};  // linear, each in [0, 1]
  Pattern pattern = Pattern::plain;
  std::array<float, 3> rgb_2 = {0.5F, 0.5F, 0.5F};  // linear; unused by `plain`
  float pattern_size_m = 1.0F;                      // of a sheet, brick, band, cube or cloud
};

struct TriangleMesh {
  std::vector<Vec3f> vertices_m;                    // (n, 3)
  std::vector<std::array<std::uint32_t, 3>> faces;  // (m, 3), counter-clockwise seen from outside
  std::vector<Material> materials = {Material{}};
  std::vector<std::uint16_t> face_material;  // (m), index into materials; empty = all 0
};

/// Adds another mesh with its materials, behind what is there: the first vertices, faces and
/// materials keep their numbers. Throws BadInput where the materials become too many to number.
void append(TriangleMesh& mesh, const TriangleMesh& more);

/// The closed surface of a box: 8 vertices, 12 faces.
TriangleMesh box_mesh(const Box3& box_m, const Material& material = {});

/// Smallest box around the vertices; empty for a mesh without vertices.
Box3 bounds_m(const TriangleMesh& mesh);

/// Sum of the triangles' areas, two-sided faces counted twice.
double surface_area_m2(const TriangleMesh& mesh);

}  // namespace gnbv
