// A structure: triangles with named materials, in world coordinates (metres, z up).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sim/core/image.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

/// Procedural textures, solid in space: they need no texture coordinates.
enum class Pattern {
  plain,    // rgb everywhere
  noise,    // clouds of rgb and rgb_2: paint, soil, concrete
  panels,   // sheets of rgb with joints of rgb_2, each sheet a little lighter or darker
  bricks,   // courses of rgb in mortar of rgb_2
  stripes,  // bands of rgb and rgb_2, stacked in z
  checker   // cubes of rgb and rgb_2
};

/// How a picture goes on beyond its borders.
enum class Wrap : std::uint8_t { repeat, mirror, clamp };

/// A picture on a surface.
struct Texture {
  std::string name = {};
  std::shared_ptr<const Image> image = {};  // materials share it; null: no texture
  std::array<Wrap, 2> wrap = {};            // along u and v
};

struct Material {
  std::string name = "default";
  std::array<float, 3> rgb = {0.7F, 0.7F, 0.7F};  // linear, each in [0, 1]
  Pattern pattern = Pattern::plain;
  std::array<float, 3> rgb_2 = {0.5F, 0.5F, 0.5F};  // linear; unused by `plain`
  float pattern_size_m = 1.0F;                      // of a sheet, brick, band, cube or cloud
  Texture texture = {};                             // times rgb
};

using Vec2f = Eigen::Vector2f;

/// What a corner of a face brings of looks.
struct CornerLook {
  static constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  Vec2f uv = {kNone, kNone};    // in its material's picture: (0, 0) upper left, (1, 1) lower right
  Rgb8 tint = {255, 255, 255};  // sRGB; times the material's colour
  std::uint8_t unused = 0;      // so that equal ones have equal bytes
};
using FaceLooks = std::vector<std::array<CornerLook, 3>>;

/// Linear colour at a place, each channel in [0, 1]. `normal_world` (unit) chooses the axes of
/// panels and bricks. Depends on its arguments alone: the same from every view.
std::array<float, 3> albedo(const Material& material, const Vec3f& p_world_m,
                            const Vec3f& normal_world);

struct TriangleMesh {
  std::vector<Vec3f> vertices_m;                    // (n, 3)
  std::vector<std::array<std::uint32_t, 3>> faces;  // (m, 3), counter-clockwise seen from outside
  std::vector<Material> materials = {Material{}};
  std::vector<std::uint16_t> face_material;  // (m), index into materials; empty = all 0
  FaceLooks face_looks = {};                 // (m); empty: no textures and no colours of corners
};

/// Linear colour of a picture at (u, v), by bilinear interpolation of linear light between the
/// centres of its pixels. Requires an image and finite u and v.
std::array<float, 3> colour_at(const Texture& texture, const Vec2f& uv);

/// Linear colour of a face at a place on it: what albedo() of its material gives, times its picture
/// and the colours of its corners, both by barycentric coordinates. Where a texture coordinate is
/// missing, without the picture.
std::array<float, 3> albedo(const TriangleMesh& mesh, std::size_t face, const Vec3f& p_world_m,
                            const Vec3f& normal_world);

/// Linear mean of a face's picture and corners, times its material's rgb: what the eye makes of it
/// from afar, by 16 samples.
std::array<float, 3> mean_colour(const TriangleMesh& mesh, std::size_t face);

/// The pictures of a mesh, each once, in order of first use; their pixels as they lie in memory.
std::vector<const Texture*> textures_of(const TriangleMesh& mesh);
std::size_t bytes_of(const std::vector<const Texture*>& textures);

/// The material's index.
inline std::size_t material_of(const TriangleMesh& mesh, std::size_t face) {
  return mesh.face_material.empty() ? 0 : mesh.face_material[face];
}

std::array<Vec3, 3> face_corners_m(const TriangleMesh& mesh, std::size_t face);
double face_area_m2(const TriangleMesh& mesh, std::size_t face);

/// Whether a face's corners lie on a line, to the rounding of float coordinates; false where one of
/// them is not finite.
bool is_flat(const TriangleMesh& mesh, std::size_t face);

/// Appends another mesh with its materials. Throws BadInput for more materials than 16 bits number.
void append(TriangleMesh& mesh, const TriangleMesh& more);

/// The closed surface of a box: 8 vertices, 12 faces.
TriangleMesh box_mesh(const Box3& box_m, const Material& material = {});

/// Smallest box around the vertices; empty for a mesh without vertices.
Box3 bounds_m(const TriangleMesh& mesh);

/// Sum of the faces' areas, two-sided faces counted twice.
double surface_area_m2(const TriangleMesh& mesh);

/// Gives equal positions (bit for bit, but -0 is 0) the same index. One with a NaN equals nothing.
class PositionIndices {
 public:
  /// The index of the position, which becomes `next` if it is new; whether it is.
  std::pair<std::uint32_t, bool> index_of(const Vec3f& p_m, std::uint32_t next) {
    if (p_m.hasNaN()) return {next, true};
    const Vec3f p = p_m + Vec3f::Zero();  // -0 becomes 0
    const auto [entry, is_new] = index_of_.try_emplace({p.x(), p.y(), p.z()}, next);
    return {entry->second, is_new};
  }

 private:
  struct Hash {
    std::size_t operator()(const std::array<float, 3>& p) const {
      return std::hash<std::string_view>{}({reinterpret_cast<const char*>(p.data()), sizeof p});
    }
  };
  std::unordered_map<std::array<float, 3>, std::uint32_t, Hash> index_of_;
};

}  // namespace gnbv
