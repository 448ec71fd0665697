// A mesh as OBJ and PLY files hold it: polygons of any number of corners, in the file's
// coordinates.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// Stands for a vertex that does not exist.
inline constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

/// For faces without a material and for materials without a colour.
inline constexpr std::string_view kDefaultMaterial = "DefaultMaterial";
inline constexpr std::array<float, 3> kDefaultColour = {0.6F, 0.6F, 0.6F};

struct PolygonMesh {
  std::vector<Vec3> vertices;            // (n, 3), as the file numbers them
  std::vector<std::uint32_t> corners;    // vertices of all faces, one face after the other
  std::vector<std::uint32_t> face_ends;  // (m), of each face among the corners, at least 3 apart
  std::vector<Material> materials = {
      Material{.name = std::string(kDefaultMaterial), .rgb = kDefaultColour}};
  std::vector<std::uint16_t> face_material;  // (m), index into materials; empty = all 0
  std::vector<std::uint32_t> vertex_rgb;     // (n), 0xrrggbb in sRGB, to colour the faces; or empty
  std::string not_finite;  // names the first coordinate that is NaN or infinite; empty without one
  std::size_t lost_faces = 0;                     // that could not be used
  std::vector<CornerLook> corner_looks = {};      // as corners; or empty
  std::vector<std::filesystem::path> files = {};  // beside it, that it was read from
};

/// Colours in sRGB. Levels end at `full`, but at `most` once a level is clearly beyond it: files
/// write 0 to 255 where 0 to 1 is meant, or where their type could hold more.
class LevelColours {
 public:
  LevelColours(double full, double most) : full_(full), most_(most) {}
  /// Red, green and blue; NaN counts as 0.
  void add(const Vec3& levels);

  std::vector<std::uint32_t> rgb = {};  // 0xrrggbb

 private:
  double full_, most_;
};

/// Reads the shape, the diffuse colours of its materials and their pictures; no normals.
/// Leaves out unreadable lines, faces of vertices that do not exist and surfaces that are no
/// polygons, and counts them in `warnings`. Throws BadInput naming the line where that could number
/// vertices wrongly: a line beside a vertex that begins with no keyword, with more vertices after
/// it. `keeps_uvs`: as read_mesh()'s.
PolygonMesh read_obj(const std::filesystem::path& path, std::vector<std::string>& warnings,
                     bool keeps_uvs = false);
/// The same of a text and that of its material library. Messages call the text `path`.
PolygonMesh read_obj_text(const std::filesystem::path& path, std::string_view obj,
                          std::string_view mtl, std::vector<std::string>& warnings);

/// Reads vertices (x, y, z), faces and triangle strips (vertex_indices, vertex_index or
/// vertex_indexes) and red, green, blue: of the faces, or else of the vertices. Faces of fewer than
/// three corners or of vertices that do not exist are left out and counted in `warnings`. Throws
/// BadInput naming what is wrong with a file that is no PLY, ends too early, lacks a coordinate,
/// has words left over in a row or holds what is no number where one is needed.
PolygonMesh read_ply(const std::filesystem::path& path, std::vector<std::string>& warnings);
/// The vertices alone, moved by the offset before they are rounded. Reads no further, but warns of
/// what follows them where nothing should.
std::vector<Vec3f> read_ply_points(const std::filesystem::path& path, const Vec3& offset_m,
                                   std::vector<std::string>& warnings);

/// Cuts a polygon of n corners into n - 2 triangles of the same sense, in the plane of its Newell
/// normal, by clipping ears from its second corner on: a convex polygon becomes a fan around its
/// first corner. A polygon that meets itself is cut as far as ears are found, then like a convex
/// one; one without area gives triangles without area. Vertices keep their numbers. A triangle has
/// the material of its polygon or, where there is `vertex_rgb`, the mean colour of its corners.
TriangleMesh triangulated(PolygonMesh polygons);

/// The triangles of one polygon, cut in the same way: places in `corners`.
std::vector<std::array<std::uint32_t, 3>> triangles_of(std::span<const std::uint32_t> corners,
                                                       const std::vector<Vec3>& vertices);

/// Materials for faces of these colours, 0xrrggbb in sRGB, in order of first use; beyond 256 of
/// them in 16 steps a channel.
void take_colours(std::span<const std::uint32_t> face_rgb, std::vector<Material>& materials,
                  std::vector<std::uint16_t>& face_material);

/// A number as an index. Throws BadInput naming the file when there are too many for an Index; the
/// last uint32 stands for none.
template <typename Index = std::uint32_t>
Index as_index(std::size_t number, const std::string& path, std::string_view of_what) {
  constexpr std::size_t kLast = std::numeric_limits<Index>::max();
  constexpr std::size_t kMost = sizeof(Index) == sizeof(std::uint32_t) ? kLast : kLast + 1;
  if (number >= kMost) throw BadInput("{}: more than {} {}", path, kMost, of_what);
  return static_cast<Index>(number);
}

}  // namespace gnbv
