#include "sim/mesh/collada_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/core/error.hpp"
#include "sim/mesh/hole_bridges.hpp"
#include "sim/mesh/plain_text.hpp"
#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {
namespace {

using Ring = HoleBridges::Ring;

/// A number as assimp read it: whole part, broken part and power of ten each in single precision.
/// So the paper's structures stay what they were, bit for bit. Where that loses millimetres, as
/// beside the offset of a map grid, it is read in double.
std::optional<double> read_single(std::string_view word) {
  const std::size_t e = std::min(word.find_first_of("eE"), word.size());
  const auto value = read_with_comma(word.substr(0, e));
  if (!value) return read_decimal(word);  // inf, for one
  constexpr double kFine = 16'384.0;
  if (std::abs(*value) >= kFine) return e == word.size() ? value : read_decimal(word);
  const double whole = std::trunc(*value);
  float out = static_cast<float>(whole) + static_cast<float>(*value - whole);
  if (e == word.size()) return out;
  const auto power = read_decimal(word.substr(e + 1));
  if (!power) return std::nullopt;
  return out * std::pow(10.0F, static_cast<float>(*power));
}

XmlElement array_of(const ColladaFile& file, const XmlElement& source) {
  const XmlElement array =
      file.named_by(source.child("technique_common").child("accessor"), "source");
  if (array && array.name() != "source") return array;
  const XmlElement floats = source.child("float_array");
  return floats ? floats : source.child("int_array");
}

/// The rows of texture coordinates that a <source> gives.
struct UvRows {
  std::size_t stride = 2;
  std::vector<double> values;

  UvRows(const ColladaFile& file, const XmlElement& source)
      : values(file.singles(array_of(file, source))) {
    const XmlElement accessor = source.child("technique_common").child("accessor");
    const auto given = read_decimal(trimmed(accessor.attribute("stride").value_or("")));
    if (given && !(*given >= 2.0 && *given < 1e9)) file.fail(source, "coordinates without a v");
    if (given) stride = static_cast<std::size_t>(*given);
  }
  const double* row(std::size_t i) const {
    return i < values.size() / stride ? values.data() + i * stride : nullptr;
  }
};

/// The positions that a <source> gives: its accessor says where each begins.
std::vector<Vec3> positions_of(const ColladaFile& file, const XmlElement& source) {
  const XmlElement accessor = source.child("technique_common").child("accessor");
  const std::vector<double> values = file.singles(array_of(file, source));
  const auto number = [&](const char* key, std::size_t fallback) {
    const auto value = read_decimal(trimmed(accessor.attribute(key).value_or("")));
    return value >= 0.0 && value < 1e9 ? static_cast<std::size_t>(*value) : fallback;
  };
  const std::size_t stride = number("stride", 3);
  const std::size_t offset = number("offset", 0);
  if (stride < 3) file.fail(source, "positions of fewer than three coordinates");
  std::array<std::size_t, 3> columns = {0, 1, 2};
  const std::vector<XmlElement> params = accessor.children("param");
  for (std::size_t k = 0; k < std::min(params.size(), stride); ++k) {
    const std::string name = params[k].attribute("name").value_or("");
    if (name.size() == 1 && name[0] >= 'X' && name[0] <= 'Z') {
      columns[static_cast<std::size_t>(name[0] - 'X')] = k;
    }
  }
  std::vector<Vec3> out;
  for (std::size_t at = offset; at + stride <= values.size(); at += stride) {
    out.emplace_back(values[at + columns[0]], values[at + columns[1]], values[at + columns[2]]);
  }
  const std::size_t announced = number("count", out.size());
  if (out.size() < announced) {
    file.fail(source, fmt::format("{} of the {} positions that its accessor announces", out.size(),
                                  announced));
  }
  out.resize(announced);
  return out;
}

/// One <triangles>, <polylist>, ...: its corners and what they make up.
class ColladaPrimitive {
 public:
  ColladaPrimitive(const ColladaFile& file, const XmlElement& element, const XmlElement& vertices,
                   bool wants_uvs, ColladaShape& shape)
      : file_(file), element_(element), shape_(shape) {
    std::vector<XmlElement> of_vertices;  // more than positions
    for (const XmlElement& input : element.children("input")) {
      const double offset =
          read_decimal(trimmed(input.attribute("offset").value_or("0"))).value_or(-1.0);
      if (!(offset >= 0.0 && offset < 1000.0)) file.fail(input, "an offset that is no count");
      stride_ = std::max(stride_, static_cast<std::size_t>(offset) + 1);
      const auto semantic = input.attribute("semantic");
      if (semantic == "VERTEX" || (semantic == "POSITION" && !has_corners_)) {
        offset_ = static_cast<std::size_t>(offset);
        has_corners_ = true;
        const bool is_at_once = semantic == "POSITION";
        of_vertices = is_at_once ? std::vector{input} : vertices.children("input");
        for (const XmlElement& of : of_vertices) {
          if (of.attribute("semantic") == "POSITION") source_ = file.named_by(of, "source");
        }
      } else {
        add_look(input, static_cast<std::size_t>(offset), wants_uvs);
      }
    }
    for (const XmlElement& of : of_vertices) add_look(of, offset_, wants_uvs);
    group_.material = element.attribute("material").value_or("");
  }

  void read() {
    if (!has_corners_ || !source_) file_.fail(element_, "faces without positions");
    group_.part.vertices = positions_of(file_, source_);
    const std::string_view kind = element_.name();
    if (kind == "polylist") {
      add_polylist();
    } else {
      for (const XmlElement& p : element_.children("p")) {
        start_corners();
        add(kind, corners_of(p));
      }
    }
    for (const XmlElement& ph : element_.children("ph")) add_with_holes(ph);
    shape_.groups.push_back(std::move(group_));
  }

 private:
  struct UvInput {
    std::size_t offset = 0;
    std::size_t set = 0;
    UvRows rows;
  };

  void add_look(const XmlElement& input, std::size_t offset, bool wants_uvs) {
    const auto semantic = input.attribute("semantic");
    if (semantic == "COLOR") {
      shape_.faults.push_back(
          fmt::format("{}: colours of vertices are not read: of COLLADA, those "
                      "of materials are",
                      file_.path().string()));
    }
    if (semantic != "TEXCOORD" || !wants_uvs) return;
    try {
      const double set = read_decimal(trimmed(input.attribute("set").value_or("0"))).value_or(0.0);
      UvInput uvs{offset, set > 0.0 && set < 1e9 ? static_cast<std::size_t>(set) : 0,
                  UvRows(file_, file_.named_by(input, "source"))};
      const bool is_new =
          std::ranges::none_of(uvs_, [&](const UvInput& other) { return other.set == uvs.set; });
      if (is_new) uvs_.push_back(std::move(uvs));
    } catch (const BadInput& error) {
      shape_.faults.emplace_back(error.what());
    }
  }

  /// Corners are numbered in the order of <p>, from where the last start_corners() was.
  void start_corners() { indices_.clear(); }
  Ring corners_of(const XmlElement& p) {
    const std::vector<double> values = file_.numbers(p);
    if (values.size() % stride_ != 0) {
      file_.fail(p, fmt::format("{} indices are no multiple of {}", values.size(), stride_));
    }
    const auto first = static_cast<std::uint32_t>(indices_.size() / stride_);
    indices_.insert(indices_.end(), values.begin(), values.end());
    Ring out(values.size() / stride_);
    std::iota(out.begin(), out.end(), first);
    return out;
  }
  double index_of(std::uint32_t corner, std::size_t offset) const {
    return indices_[corner * stride_ + offset];
  }
  std::uint32_t vertex_of(std::uint32_t corner) const {
    const double index = index_of(corner, offset_);
    const bool exists = index >= 0.0 && index < static_cast<double>(group_.part.vertices.size()) &&
                        index == std::floor(index);
    return exists ? static_cast<std::uint32_t>(index) : kNoVertex;
  }
  CornerLook look_of(std::uint32_t corner, const UvInput& uvs) const {
    const double index = index_of(corner, uvs.offset);
    const double* const uv =
        index >= 0.0 && index < 4e9 ? uvs.rows.row(static_cast<std::size_t>(index)) : nullptr;
    if (uv == nullptr) return {};
    return {.uv = {static_cast<float>(uv[0]), static_cast<float>(1.0 - uv[1])}};
  }

  void add(std::string_view kind, const Ring& corners) {
    if (kind == "polygons") return add_face(corners);
    const bool are_apart = kind == "triangles", is_fan = kind == "trifans";
    if (are_apart && corners.size() % 3 != 0) ++shape_.impossible_faces;
    for (std::size_t i = 0; i + 2 < corners.size(); i += are_apart ? 3 : 1) {
      const bool is_odd = !are_apart && !is_fan && i % 2 == 1;
      const std::uint32_t a = corners[is_fan ? 0 : i + (is_odd ? 1 : 0)];
      const std::uint32_t b = corners[is_odd ? i : i + 1];
      add_face(std::array{a, b, corners[i + 2]});
    }
  }

  void add_polylist() {
    const std::vector<double> counts = file_.numbers(element_.child("vcount"));
    const Ring corners = corners_of(element_.child("p"));
    std::size_t begin = 0;
    for (const double count : counts) {
      const auto left = static_cast<double>(corners.size() - begin);
      if (!(count >= 0.0 && count <= left)) {
        file_.fail(element_, "a vcount that asks for more corners than there are");
      }
      const auto n = static_cast<std::size_t>(count);
      add_face(std::span(corners).subspan(begin, n));
      begin += n;
    }
    if (begin < corners.size()) file_.fail(element_, "corners that no vcount asks for");
  }

  void add_with_holes(const XmlElement& ph) {
    start_corners();
    const Ring outer = corners_of(ph.child("p"));
    std::vector<Ring> holes;
    for (const XmlElement& h : ph.children("h")) holes.push_back(corners_of(h));
    const bool is_whole =
        is_possible(outer) && std::all_of(holes.begin(), holes.end(),
                                          [&](const Ring& hole) { return is_possible(hole); });
    if (!is_whole) {
      ++shape_.impossible_faces;
    } else {
      std::vector<Vec3> points;
      for (std::uint32_t corner = 0; corner < indices_.size() / stride_; ++corner) {
        points.push_back(group_.part.vertices[vertex_of(corner)]);
      }
      add_face(HoleBridges(std::move(points), outer).joined(outer, std::move(holes)));
    }
  }

  bool is_possible(std::span<const std::uint32_t> face) const {
    return face.size() >= 3 && std::none_of(face.begin(), face.end(), [&](std::uint32_t corner) {
             return vertex_of(corner) == kNoVertex;
           });
  }
  void add_face(std::span<const std::uint32_t> face) {
    if (!is_possible(face)) {
      ++shape_.impossible_faces;
      return;
    }
    ring_.clear();
    for (const std::uint32_t corner : face) ring_.push_back(vertex_of(corner));
    for (const auto& [a, b, c] : triangles_of(ring_, group_.part.vertices)) {
      group_.part.faces.push_back({ring_[a], ring_[b], ring_[c]});
      for (const UvInput& uvs : uvs_) {
        group_.part.looks[uvs.set].push_back(
            {look_of(face[a], uvs), look_of(face[b], uvs), look_of(face[c], uvs)});
      }
    }
  }

  const ColladaFile& file_;
  XmlElement element_;
  ColladaShape& shape_;
  ColladaShape::Group group_;
  XmlElement source_;
  std::vector<UvInput> uvs_;
  std::vector<double> indices_;  // of the corners, stride_ for each
  Ring ring_;                    // the vertices of one face
  std::size_t stride_ = 1, offset_ = 0;
  bool has_corners_ = false;
};

}  // namespace

ColladaFile::ColladaFile(const std::filesystem::path& path, std::vector<std::string>& warnings)
    : path_(path), tree_(path, warnings) {
  if (root().name() != "COLLADA") {
    fail(root(), fmt::format("is no COLLADA file: its root is <{}>", root().name().substr(0, 60)));
  }
  tree_.for_each([&](const XmlElement& element) {
    if (auto id = element.attribute("id")) by_id_.try_emplace(*id, element);
    has_images_ = has_images_ || element.name() == "image";
  });
}

XmlElement ColladaFile::named_by(const XmlElement& from, const char* attribute) const {
  return by_id(trimmed(from.attribute(attribute).value_or("")));
}

XmlElement ColladaFile::by_id(std::string url) const {
  const std::size_t hash = url.find('#');
  if (hash != url.npos && hash > 0) return {};  // in another file
  url.erase(0, hash == 0 ? 1 : 0);
  auto found = by_id_.find(url);
  if (found == by_id_.end()) found = by_id_.find(percent_decoded(url));
  return found != by_id_.end() ? found->second : XmlElement();
}

std::optional<double> read_with_comma(std::string_view word) {
  const std::size_t comma = word.find(',');
  if (comma == word.npos) return read_decimal(word);
  std::string pointed(word);
  pointed[comma] = '.';
  return read_decimal(pointed);
}

template <typename Read>
std::vector<double> ColladaFile::words(const XmlElement& element, const Read& read) const {
  std::vector<double> out;
  const std::string text = element.text();
  std::string_view rest = text;
  for (auto word = take_word(rest); !word.empty(); word = take_word(rest)) {
    const auto value = read(word);
    if (!value) {
      fail(element, fmt::format("'{}' in <{}> is no number", word.substr(0, 60), element.name()));
    }
    out.push_back(*value);
  }
  return out;
}

std::vector<double> ColladaFile::numbers(const XmlElement& element) const {
  return words(element, read_decimal);
}

std::vector<double> ColladaFile::singles(const XmlElement& element) const {
  return words(element, read_single);
}

void ColladaFile::fail(const XmlElement& at, const std::string& what) const {
  throw BadInput("{}:{}: {}", path_.string(), at.line(), what);
}

ColladaShape collada_shape(const ColladaFile& file, const XmlElement& geometry, bool wants_uvs) {
  ColladaShape shape;
  for (const XmlElement& body : geometry.children()) {
    const std::string_view kind = body.name();
    if (kind == "spline" || kind == "brep") ++shape.unread;
    if (kind != "mesh" && kind != "convex_mesh") continue;
    if (body.attribute("convex_hull_of")) ++shape.unread;
    for (const XmlElement& element : body.children()) {
      const std::string_view name = element.name();
      if (name == "triangles" || name == "polylist" || name == "polygons" || name == "tristrips" ||
          name == "trifans") {
        ColladaPrimitive(file, element, body.child("vertices"), wants_uvs, shape).read();
      }
    }
  }
  return shape;
}

}  // namespace gnbv
