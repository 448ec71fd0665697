// read_surface() of textured_mesh.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/surface/textured_mesh.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// The words of a line, one after the other.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  std::string_view next() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \r"), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(" \r"));
    rest_.remove_prefix(word.size());
    return word;
  }

 private:
  std::string_view rest_;
};

template <typename Number>
bool is_number(std::string_view word, Number& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

/// One line after the other of what obj_of() of surface_files.cpp writes.
class SurfaceReader {
 public:
  explicit SurfaceReader(Image atlas) { mesh_.atlas = std::move(atlas); }

  /// Whether it is a line of such a file.
  bool read(std::string_view line) {
    Words words(line);
    const std::string_view kind = words.next();
    if (kind == "v") return read_vertex(words);
    if (kind == "vt") return read_uv(words);
    if (kind == "f") return read_face(words);
    return kind.empty() || kind == "#" || kind == "mtllib" || kind == "usemtl";
  }

  TexturedMesh take() { return std::move(mesh_); }

 private:
  bool has_texture() const { return !mesh_.atlas.rgb.empty(); }

  bool read_vertex(Words& words) {
    Vec3f p_m;
    for (float& x : p_m) {
      if (!is_number(words.next(), x) || !std::isfinite(x)) return false;
    }
    mesh_.shape.vertices_m.push_back(p_m);
    Rgb8& rgb = mesh_.vertex_rgb.emplace_back();
    for (std::uint8_t& level : rgb) {
      float share = 0.0F;
      if (has_texture()) continue;
      if (!is_number(words.next(), share) || !(share >= 0.0F && share <= 1.0F)) return false;
      level = static_cast<std::uint8_t>(std::lround(255.0F * share));
    }
    return true;
  }

  bool read_uv(Words& words) {
    float u = 0.0F;
    float v = 0.0F;
    if (!is_number(words.next(), u) || !is_number(words.next(), v)) return false;
    if (!(u >= 0.0F && u <= 1.0F && v >= 0.0F && v <= 1.0F)) return false;
    uv_.emplace_back(u * static_cast<float>(mesh_.atlas.width_px),
                     (1.0F - v) * static_cast<float>(mesh_.atlas.height_px));
    return true;
  }

  bool read_face(Words& words) {
    std::array<std::uint32_t, 3> face{};
    FaceUv uv;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string_view corner = words.next();
      const std::size_t slash = corner.find('/');
      if (!is_index(corner.substr(0, slash), mesh_.shape.vertices_m.size(), face[k])) return false;
      if ((slash != std::string_view::npos) != has_texture()) return false;
      if (!has_texture()) continue;
      std::uint32_t at = 0;
      if (!is_index(corner.substr(slash + 1), uv_.size(), at)) return false;
      uv[k] = uv_[at];
    }
    mesh_.shape.faces.push_back(face);
    if (has_texture()) mesh_.face_uv.push_back(uv);
    return true;
  }

  /// Counted from 1 in the file, of so many.
  static bool is_index(std::string_view word, std::size_t count, std::uint32_t& index) {
    if (!is_number(word, index) || index < 1 || index > count) return false;
    --index;
    return true;
  }

  TexturedMesh mesh_;
  std::vector<Vec2f> uv_;
};

}  // namespace

TexturedMesh read_surface(const fs::path& folder) {
  const fs::path path = folder / "surface.obj";
  const std::string text = read_file(path);
  const bool has_texture = text.find("\nusemtl ") != std::string::npos;
  SurfaceReader reader(has_texture ? read_png(folder / "surface.png") : Image{});
  std::size_t number = 1;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (!reader.read(std::string_view(text).substr(begin, end - begin))) {
      throw BadInput(
          fmt::format("{}:{}: no line of a file that gnbv surface writes", path.string(), number));
    }
    begin = end + 1;
  }
  return reader.take();
}

}  // namespace gnbv
