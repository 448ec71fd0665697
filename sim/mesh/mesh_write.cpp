// write_mesh() of sim/mesh/mesh_file.hpp.
#include <iterator>
#include <unordered_map>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/image.hpp"
#include "sim/mesh/glb_write.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "sim/mesh/ply_write.hpp"

namespace gnbv {
namespace {

/// A material without a name gets one by its number.
std::string obj_name_of_material(const TriangleMesh& mesh, std::size_t index) {
  const std::string& name = mesh.materials[index].name;
  return name.empty() ? fmt::format("material_{}", index) : name;
}

std::string mtl_text_of(const TriangleMesh& mesh) {
  std::string out;
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    const auto& [r, g, b] = mesh.materials[i].rgb;
    out += fmt::format("newmtl {}\nKd {} {} {}\n", obj_name_of_material(mesh, i), r, g, b);
  }
  return out;
}

std::string obj_text_of(const TriangleMesh& mesh, const std::string& mtl_name) {
  std::string out = fmt::format("mtllib {}\n", mtl_name);
  const auto at = std::back_inserter(out);
  for (const Vec3f& v : mesh.vertices_m) {
    fmt::format_to(at, "v {} {} {}\n", v.x(), v.y(), v.z());
  }
  std::size_t current = mesh.materials.size();
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const std::size_t material = material_of(mesh, i);
    if (material != current)
      out += fmt::format("usemtl {}\n", obj_name_of_material(mesh, material));
    current = material;
    const auto& [a, b, c] = mesh.faces[i];
    fmt::format_to(at, "f {} {} {}\n", a + 1, b + 1, c + 1);
  }
  return out;
}

/// Each face has the sRGB bytes of its material, of its picture the mean, as MeshLab shows them.
std::string ply_bytes_of(const TriangleMesh& mesh) {
  std::vector<Rgb8> colours;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const auto [r, g, b] = mean_colour(mesh, i);
    colours.push_back({srgb_byte(r), srgb_byte(g), srgb_byte(b)});
  }
  return ply_bytes({.places_world_m = mesh.vertices_m},
                   PlyFaces{.corners = mesh.faces, .colours = colours});
}

/// A primitive of the faces of one material, their vertices numbered in order of first use; null
/// without faces.
GlbBuffer::Json glb_part(const TriangleMesh& mesh, std::size_t material, GlbBuffer& buffer) {
  std::unordered_map<std::uint32_t, std::uint32_t> index_of;
  std::vector<std::uint32_t> used, corners;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    if (material_of(mesh, i) != material) continue;
    for (const std::uint32_t vertex : mesh.faces[i]) {
      const auto [entry, is_new] =
          index_of.try_emplace(vertex, static_cast<std::uint32_t>(used.size()));
      if (is_new) used.push_back(vertex);
      corners.push_back(entry->second);
    }
  }
  if (corners.empty()) return nullptr;
  const std::size_t positions = buffer.add_positions(
      used.size(), [&](std::size_t i) { return y_up(mesh.vertices_m[used[i]]); });
  const std::size_t indices =
      buffer.add(corners.size(), "SCALAR", GlbBuffer::kUnsignedInt,
                 [&](std::size_t i) { append_bytes(buffer.bytes, corners[i]); });
  return {{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", material}};
}

std::string glb_bytes_of(const TriangleMesh& mesh) {
  GlbBuffer buffer;
  auto materials = GlbBuffer::Json::array(), primitives = GlbBuffer::Json::array();
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    const auto& [r, g, b] = mesh.materials[i].rgb;
    materials.push_back({{"name", mesh.materials[i].name},
                         {"pbrMetallicRoughness",
                          {{"baseColorFactor", {r, g, b, 1.0F}}, {"metallicFactor", 0.0}}}});
    if (const auto part = glb_part(mesh, i, buffer); !part.is_null()) primitives.push_back(part);
  }
  return glb_bytes({{"asset", {{"version", "2.0"}, {"generator", "gnbv"}}},
                    {"scene", 0},
                    {"scenes", {{{"nodes", {0}}}}},
                    {"nodes", {{{"name", "structure"}, {"mesh", 0}}}},
                    {"meshes", {{{"name", "structure"}, {"primitives", primitives}}}},
                    {"materials", materials}},
                   buffer);
}

}  // namespace

void write_mesh(const TriangleMesh& mesh, const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension == ".obj") {
    const std::filesystem::path mtl = std::filesystem::path(path).replace_extension(".mtl");
    write_file_atomically(mtl, mtl_text_of(mesh));
    write_file_atomically(path, obj_text_of(mesh, mtl.filename().string()));
  } else if (extension == ".ply") {
    write_file_atomically(path, ply_bytes_of(mesh));
  } else if (extension == ".glb") {
    write_file_atomically(path, glb_bytes_of(mesh));
  } else {
    throw BadInput("{}: meshes are written as .obj, .ply or .glb, not '{}'", path.string(),
                   extension);
  }
}

}  // namespace gnbv
