// write_surface() of textured_mesh.hpp.
#include <fmt/format.h>

#include "sim/core/file.hpp"
#include "sim/mesh/ply_write.hpp"
#include "tools/surface/textured_mesh.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// With a texture, `v` and `vt` of each distinct corner; without, colours behind the positions, as
/// MeshLab and Blender read them.
std::string obj_of(const TexturedMesh& mesh) {
  std::string out = "# gnbv, world ENU, metres\n";
  auto to = std::back_inserter(out);
  const bool has_texture = !mesh.face_uv.empty();
  if (has_texture) out += "mtllib surface.mtl\nusemtl surface\n";
  for (std::size_t i = 0; i < mesh.shape.vertices_m.size(); ++i) {
    const Vec3f& p_m = mesh.shape.vertices_m[i];
    fmt::format_to(to, "v {:.5f} {:.5f} {:.5f}", p_m.x(), p_m.y(), p_m.z());
    if (!has_texture) {
      const Rgb8& c = mesh.vertex_rgb[i];
      fmt::format_to(to, " {:.4f} {:.4f} {:.4f}", c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
    }
    out += '\n';
  }
  if (!has_texture) {
    for (const auto& f : mesh.shape.faces) {
      fmt::format_to(to, "f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1);
    }
    return out;
  }
  const DistinctCorners corners = distinct_corners(mesh);
  for (const Vec2f& uv : corners.uv) {  // v upwards
    fmt::format_to(to, "vt {:.6f} {:.6f}\n", uv.x() / static_cast<float>(mesh.atlas.width_px),
                   1.0F - uv.y() / static_cast<float>(mesh.atlas.height_px));
  }
  for (const auto& f : corners.faces) {
    fmt::format_to(to, "f {}/{} {}/{} {}/{}\n", corners.vertex[f[0]] + 1, f[0] + 1,
                   corners.vertex[f[1]] + 1, f[1] + 1, corners.vertex[f[2]] + 1, f[2] + 1);
  }
  return out;
}

}  // namespace

std::vector<fs::path> write_surface(const TexturedMesh& mesh, const fs::path& folder) {
  std::vector<fs::path> paths;
  const auto write = [&](const char* name, const std::string& content) {
    write_file_atomically(folder / name, content);
    paths.push_back(folder / name);
  };
  std::string png;
  if (!mesh.face_uv.empty()) {
    write_png(mesh.atlas, folder / "surface.png");
    paths.push_back(folder / "surface.png");
    png = read_file(folder / "surface.png");
    write("surface.mtl",
          "newmtl surface\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd surface.png\n");
  } else {  // nothing of an earlier call that no longer belongs to the rest
    std::error_code ignored;
    for (const char* stale : {"surface.png", "surface.mtl"}) fs::remove(folder / stale, ignored);
  }
  write("surface.obj", obj_of(mesh));
  const std::vector<Vec3f> normals = vertex_normals(mesh.shape);
  write("surface.ply", ply_bytes({.places_world_m = mesh.shape.vertices_m,
                                  .normals = normals,
                                  .colours = mesh.vertex_rgb},
                                 PlyFaces{.corners = mesh.shape.faces}));
  write("surface.glb", glb_of(mesh, png));
  return paths;
}

}  // namespace gnbv
