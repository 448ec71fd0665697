// read_ply() of sim/mesh/polygon_file.hpp.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/error.hpp"
#include "sim/mesh/ply_reader.hpp"
#include "sim/mesh/polygon_file.hpp"

namespace gnbv {
namespace {

/// The colours of an element's items, if it has all three channels.
class Colours {
 public:
  explicit Colours(const PlyElement& element)
      : element_(element), columns_(element.columns({"red", "green", "blue"})) {}

  /// Appends 0xrrggbb.
  void add(const PlyItem& item, std::vector<std::uint32_t>& colours) const {
    if (!columns_[0] || !columns_[1] || !columns_[2]) return;
    std::uint32_t rgb = 0;
    for (const auto& column : columns_) {
      const PlyType& type = *element_.properties[*column].type;
      const double full = type.is_real ? 1.0 : std::ldexp(1.0, 8 * type.bytes) - 1.0;
      const double level = item.numbers[*column] / full;
      // NaN counts as 0
      rgb = rgb << 8 | static_cast<std::uint32_t>(
                           std::lround(255.0 * (level >= 0.0 ? std::min(level, 1.0) : 0.0)));
    }
    colours.push_back(rgb);
  }

 private:
  const PlyElement& element_;
  std::array<std::optional<std::size_t>, 3> columns_;
};

class PlyMeshReader {
 public:
  explicit PlyMeshReader(const std::filesystem::path& path) : path_(path.string()), ply_(path) {}

  PolygonMesh read(std::vector<std::string>& warnings) {
    for (const PlyElement& element : ply_.elements()) {
      if (element.properties.empty()) continue;
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        ply_.skip(element);
      }
    }
    const std::size_t dropped = drop_impossible_faces();
    if (dropped > 0) {
      warnings.push_back(
          fmt::format("{}: {} faces of vertices that do not exist left out", path_, dropped));
    }
    if (!face_rgb_.empty()) {
      take_colours(face_rgb_, out_.materials, out_.face_material);
      out_.vertex_rgb.clear();
    } else if (out_.vertex_rgb.size() != out_.vertices.size()) {
      out_.vertex_rgb.clear();
    }
    return std::move(out_);
  }

 private:
  static constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

  void read_vertices(const PlyElement& element) {
    const PlyPositions positions(element);
    const Colours colours(element);
    out_.vertices.reserve(out_.vertices.size() + ply_.most_items(element));
    PlyItem item;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      ply_.read_item(element, item);
      const Vec3 p = positions.of(item);
      if (!p.allFinite() && out_.not_finite.empty()) {
        out_.not_finite =
            fmt::format("{}: vertex {} is at ({}, {}, {})", path_, i, p.x(), p.y(), p.z());
      }
      as_index(out_.vertices.size(), path_);
      out_.vertices.push_back(p);
      colours.add(item, out_.vertex_rgb);
    }
  }

  void read_faces(const PlyElement& element) {
    const Colours colours(element);
    out_.face_ends.reserve(out_.face_ends.size() + ply_.most_items(element));
    out_.corners.reserve(out_.corners.size() + ply_.most_list_numbers(element));
    PlyItem item;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      ply_.read_item(element, item);
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        const PlyProperty& property = element.properties[k];
        const bool is_corners =
            property.count_type != nullptr &&
            (property.name == "vertex_indices" || property.name == "vertex_index");
        if (is_corners) add_face(item.lists[k]);
      }
      colours.add(item, face_rgb_);
    }
  }

  /// Takes vertices of any number: a file may list the vertices after the faces.
  void add_face(const std::vector<double>& vertices) {
    for (const double vertex : vertices) {
      const bool is_possible = vertex >= 0.0 && vertex < kNoVertex;
      out_.corners.push_back(is_possible ? static_cast<std::uint32_t>(vertex) : kNoVertex);
    }
    out_.face_ends.push_back(as_index(out_.corners.size(), path_));
  }

  std::size_t drop_impossible_faces() {
    if (face_rgb_.size() != out_.face_ends.size()) face_rgb_.clear();
    std::size_t faces = 0, corners = 0, begin = 0;  // of those that are kept
    for (std::size_t i = 0; i < out_.face_ends.size(); ++i) {
      const auto face = std::span(out_.corners).subspan(begin, out_.face_ends[i] - begin);
      begin = out_.face_ends[i];
      const bool is_possible =
          face.size() >= 3 && *std::max_element(face.begin(), face.end()) < out_.vertices.size();
      if (!is_possible) continue;
      std::copy(face.begin(), face.end(),
                out_.corners.begin() + static_cast<std::ptrdiff_t>(corners));
      corners += face.size();
      if (!face_rgb_.empty()) face_rgb_[faces] = face_rgb_[i];
      out_.face_ends[faces++] = static_cast<std::uint32_t>(corners);
    }
    const std::size_t dropped = out_.face_ends.size() - faces;
    out_.face_ends.resize(faces);
    out_.corners.resize(corners);
    if (!face_rgb_.empty()) face_rgb_.resize(faces);
    return dropped;
  }

  std::string path_;
  PlyReader ply_;
  PolygonMesh out_;
  std::vector<std::uint32_t> face_rgb_;  // 0xrrggbb in sRGB
};

}  // namespace

PolygonMesh read_ply(const std::filesystem::path& path, std::vector<std::string>& warnings) {
  return PlyMeshReader(path).read(warnings);
}

}  // namespace gnbv
