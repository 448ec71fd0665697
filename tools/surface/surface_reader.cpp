// read_surface() of textured_mesh.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/mesh/plain_text.hpp"
#include "tools/surface/textured_mesh.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

/// Counted from 1 in the file, of so many.
std::optional<std::uint32_t> read_index(std::string_view word, std::size_t count) {
  std::uint32_t index = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  if (index < 1 || index > count) return std::nullopt;
  return index - 1;
}

std::optional<float> read_share(std::string_view word) {
  const std::optional<double> share = read_decimal(word);
  if (!share || !(*share >= 0.0 && *share <= 1.0)) return std::nullopt;
  return static_cast<float>(*share);
}

/// One line after the other of what obj_of() of surface_files.cpp writes.
class SurfaceReader {
 public:
  explicit SurfaceReader(Image atlas) { mesh_.atlas = std::move(atlas); }

  /// Whether it is a line of such a file.
  bool read(std::string_view line) {
    split(line, words_);
    if (words_.empty()) return true;
    const std::string_view kind = words_.front();
    if (kind == "v") return words_.size() == (has_texture() ? 4U : 7U) && read_vertex();
    if (kind == "vt") return words_.size() == 3 && read_uv();
    if (kind == "f") return words_.size() == 4 && read_face();
    return kind == "#" || kind == "mtllib" || kind == "usemtl";
  }

  TexturedMesh take() { return std::move(mesh_); }

 private:
  bool has_texture() const { return !mesh_.atlas.rgb.empty(); }

  bool read_vertex() {
    Vec3f p_m;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::optional<double> x_m = read_decimal(words_[1 + k]);
      if (!x_m || !std::isfinite(*x_m)) return false;
      p_m[static_cast<Eigen::Index>(k)] = static_cast<float>(*x_m);
    }
    Rgb8 rgb{};
    for (std::size_t k = 0; k < 3 && !has_texture(); ++k) {
      const std::optional<float> share = read_share(words_[4 + k]);
      if (!share) return false;
      rgb[k] = static_cast<std::uint8_t>(std::lround(255.0F * *share));
    }
    mesh_.shape.vertices_m.push_back(p_m);
    mesh_.vertex_rgb.push_back(rgb);
    return true;
  }

  bool read_uv() {
    const std::optional<float> u = read_share(words_[1]);
    const std::optional<float> v = read_share(words_[2]);  // upwards
    if (!u || !v) return false;
    uv_.emplace_back(*u * static_cast<float>(mesh_.atlas.width_px),
                     (1.0F - *v) * static_cast<float>(mesh_.atlas.height_px));
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
