// A mesh as files hold it: polygons of any number of corners, in the coordinates of the file.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// Of faces to which their file gives no material, and the colour of materials that it does not
/// tell.
inline constexpr std::string_view kUntoldMaterial = "DefaultMaterial";
inline constexpr std::array<float, 3> kUntoldColour = {0.6F, 0.6F, 0.6F};

struct PolygonMesh {
  std::vector<Vec3> vertices;            // (n, 3), as the file numbers them
  std::vector<std::uint32_t> corners;    // vertices of all faces, one face after the other
  std::vector<std::uint32_t> face_ends;  // (m), of each face among the corners, at least 3 apart
  std::vector<Material> materials = {
      Material{.name = std::string(kUntoldMaterial), .rgb = kUntoldColour}};
  std::vector<std::uint16_t> face_material;  // (m), index into materials; empty = all 0
  std::vector<std::uint32_t> vertex_rgb;     // (n), 0xrrggbb in sRGB, to colour the faces; or empty
  std::string not_finite;  // names the first coordinate that is NaN or infinite; empty without one
};

/// A number of vertices or corners as an index. Throws BadInput naming the file when there are more
/// than 32 bits can number.
std::uint32_t as_index(std::size_t count, const std::string& path);

/// Cuts a polygon of n corners into n - 2 triangles of the same sense, in the plane of its Newell
/// normal, by clipping ears from its second corner on: a convex polygon becomes a fan around its
/// first corner, a triangle stays what it is. One that meets itself is cut as far as ears are
/// found, then like a convex one; where it has no area, neither have its triangles. Vertices keep
/// their numbers, used or not. A face has its own material or, where there is `vertex_rgb`, each
/// triangle the mean colour of its corners.
TriangleMesh triangulated(PolygonMesh polygons);

/// Materials for faces of these colours, 0xrrggbb in sRGB, in order of first use; beyond 256 of
/// them in 16 steps a channel.
void take_colours(std::span<const std::uint32_t> face_rgb, std::vector<Material>& materials,
                  std::vector<std::uint16_t>& face_material);

}  // namespace gnbv
