// write_surface() and read_surface() of textured_mesh.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"
#include "sim/mesh/plain_text.hpp"
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

/// Counted from 1 in the file, of so many.
std::optional<std::uint32_t> read_index(std::string_view word, std::size_t count) {
  const auto index = number_in<std::uint32_t>(word);
  return index && *index >= 1 && *index <= count ? std::optional(*index - 1) : std::nullopt;
}

/// The numbers of a line, behind its keyword; nothing unless they are so many, and finite.
std::optional<std::vector<double>> read_numbers(Words words, std::size_t count) {
  std::vector<double> numbers;
  for (const std::string_view word : words.subspan(1)) {
    const std::optional<double> x = read_decimal(word);
    if (!x || !std::isfinite(*x)) return std::nullopt;
    numbers.push_back(*x);
  }
  if (numbers.size() != count) return std::nullopt;
  return numbers;
}

bool is_share(double x) { return x >= 0.0 && x <= 1.0; }

/// One line after the other of what obj_of() writes.
class SurfaceReader {
 public:
  explicit SurfaceReader(Image atlas) { mesh_.atlas = std::move(atlas); }

  /// Whether it is a line of such a file.
  bool read(std::string_view line) {
    split(line, words_);
    if (words_.empty()) return true;
    const std::string_view kind = words_.front();
    if (kind == "v") return read_vertex();
    if (kind == "vt") return read_uv();
    if (kind == "f") return words_.size() == 4 && read_face();
    return kind == "#" || kind == "mtllib" || kind == "usemtl";
  }

  TexturedMesh take() { return std::move(mesh_); }

 private:
  bool has_texture() const { return !mesh_.atlas.rgb.empty(); }

  bool read_vertex() {
    const auto numbers = read_numbers(words_, has_texture() ? 3 : 6);
    if (!numbers || !std::all_of(numbers->begin() + 3, numbers->end(), is_share)) return false;
    mesh_.shape.vertices_m.push_back(Vec3(numbers->data()).cast<float>());
    Rgb8& rgb = mesh_.vertex_rgb.emplace_back();
    for (std::size_t k = 3; k < numbers->size(); ++k) {
      rgb[k - 3] = static_cast<std::uint8_t>(std::lround(255.0 * (*numbers)[k]));
    }
    return true;
  }

  bool read_uv() {
    const auto numbers = read_numbers(words_, 2);  // v upwards
    if (!numbers || !std::all_of(numbers->begin(), numbers->end(), is_share)) return false;
    const Vec2f uv = Eigen::Vector2d((*numbers)[0], 1.0 - (*numbers)[1]).cast<float>();
    uv_.push_back(uv.cwiseProduct(Vec2f(static_cast<float>(mesh_.atlas.width_px),
                                        static_cast<float>(mesh_.atlas.height_px))));
    return true;
  }

  bool read_face() {
    std::array<std::uint32_t, 3> face{};
    FaceUv uv;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string_view corner = words_[1 + k];
      const std::size_t slash = std::min(corner.find('/'), corner.size());
      const auto vertex = read_index(corner.substr(0, slash), mesh_.shape.vertices_m.size());
      if (!vertex || (slash < corner.size()) != has_texture()) return false;
      face[k] = *vertex;
      if (!has_texture()) continue;
      const auto at = read_index(corner.substr(slash + 1), uv_.size());
      if (!at) return false;
      uv[k] = uv_[*at];
    }
    mesh_.shape.faces.push_back(face);
    if (has_texture()) mesh_.face_uv.push_back(uv);
    return true;
  }

  TexturedMesh mesh_;
  std::vector<Vec2f> uv_;  // texels, as face_uv
  std::vector<std::string_view> words_;
};

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

TexturedMesh read_surface(const fs::path& folder) {
  const fs::path path = folder / "surface.obj";
  const std::string text = read_file(path);
  const bool has_texture = text.find("\nusemtl ") != std::string::npos;
  SurfaceReader reader(has_texture ? read_png(folder / "surface.png") : Image{});
  std::size_t number = 1;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (!reader.read(std::string_view(text).substr(begin, end - begin))) {
      throw BadInput("{}:{}: no line of a file that gnbv surface writes", path.string(), number);
    }
    begin = end + 1;
  }
  return reader.take();
}

}  // namespace gnbv
