#include "sim/mesh/ply_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "sim/core/error.hpp"
#include "sim/core/srgb.hpp"

namespace gnbv {
namespace {

enum class Encoding { text, little_endian, big_endian };

struct NumberType {
  std::string_view name, other_name;
  std::size_t bytes;
  bool is_signed, is_real;
};
constexpr std::array kTypes = {
    NumberType{"char", "int8", 1, true, false},    NumberType{"uchar", "uint8", 1, false, false},
    NumberType{"short", "int16", 2, true, false},  NumberType{"ushort", "uint16", 2, false, false},
    NumberType{"int", "int32", 4, true, false},    NumberType{"uint", "uint32", 4, false, false},
    NumberType{"float", "float32", 4, true, true}, NumberType{"double", "float64", 8, true, true},
};

struct Property {
  std::string name;
  const NumberType* type = nullptr;
  const NumberType* count_type = nullptr;  // of a list; null for a single number
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin < line.size();) {
    begin = std::min(line.find_first_not_of(" \t\r", begin), line.size());
    const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
    if (end > begin) words.emplace_back(line.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

class PlyReader {
 public:
  PlyReader(const std::filesystem::path& path, std::string_view content)
      : path_(path), rest_(content) {}

  PlyFile read(std::vector<std::string>& warnings) {
    read_header();
    for (const Element& element : elements_) {
      if (element.properties.empty()) continue;
      for (std::size_t i = 0; i < element.count; ++i) read_item(element, i);
    }
    add_faces(warnings);
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw BadInput(fmt::format("{}: {}", path_.string(), what));
  }

  std::string_view take_line() {
    const std::string_view line = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
    return line;
  }

  const NumberType* type_of(const std::string& name) const {
    for (const NumberType& type : kTypes) {
      if (name == type.name || name == type.other_name) return &type;
    }
    fail(fmt::format("its header names the unknown type '{}'", name));
  }

  void read_header() {
    if (words_of(take_line()) != std::vector<std::string>{"ply"}) {
      fail("is no PLY file: its first line is not 'ply'");
    }
    while (true) {
      if (rest_.empty()) fail("its header has no end_header");
      const std::vector<std::string> words = words_of(take_line());
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") return;
      if (!read_declaration(words)) fail(fmt::format("its header has a bad '{}' line", words[0]));
    }
  }

  bool read_declaration(const std::vector<std::string>& words) {
    const std::size_t n = words.size();
    if (words[0] == "format" && n >= 2) {
      if (words[1] == "ascii")
        encoding_ = Encoding::text;
      else if (words[1] == "binary_little_endian")
        encoding_ = Encoding::little_endian;
      else if (words[1] == "binary_big_endian")
        encoding_ = Encoding::big_endian;
      else
        return false;
    } else if (words[0] == "element" && n == 3) {
      Element element;
      element.name = words[1];
      const char* const last = words[2].data() + words[2].size();
      const auto [end, error] = std::from_chars(words[2].data(), last, element.count);
      if (error != std::errc() || end != last) return false;
      elements_.push_back(std::move(element));
    } else if (words[0] == "property" && n == 3 && !elements_.empty()) {
      elements_.back().properties.push_back({words[2], type_of(words[1]), nullptr});
    } else if (words[0] == "property" && n == 5 && words[1] == "list" && !elements_.empty()) {
      elements_.back().properties.push_back({words[4], type_of(words[3]), type_of(words[2])});
    } else {
      return false;
    }
    return true;
  }

  double take_number(const NumberType& type) {
    return encoding_ == Encoding::text ? take_text_number() : take_bytes_number(type);
  }

  double take_text_number() {
    constexpr std::string_view kBlanks = " \t\r\n";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size()));
    std::string_view word = rest_.substr(0, rest_.find_first_of(kBlanks));
    if (word.empty()) fail("ends before all that its header announces");
    rest_.remove_prefix(word.size());
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size()) fail(fmt::format("'{}' is no number", word));
    if (error == std::errc::result_out_of_range) return std::numeric_limits<double>::infinity();
    return value;
  }

  double take_bytes_number(const NumberType& type) {
    if (rest_.size() < type.bytes) fail("ends before all that its header announces");
    std::array<unsigned char, 8> bytes{};
    std::memcpy(bytes.data(), rest_.data(), type.bytes);
    rest_.remove_prefix(type.bytes);
    if (encoding_ == Encoding::big_endian) std::reverse(bytes.begin(), bytes.begin() + type.bytes);
    std::uint64_t bits = 0;
    for (std::size_t i = type.bytes; i-- > 0;) bits = bits << 8 | bytes[i];
    if (type.is_real && type.bytes == 8) return std::bit_cast<double>(bits);
    if (type.is_real) {
      return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    }
    const auto value = static_cast<double>(bits);  // at most 32 bits
    const double range = std::ldexp(1.0, static_cast<int>(8 * type.bytes));
    return type.is_signed && value >= 0.5 * range ? value - range : value;
  }

  void read_item(const Element& element, std::size_t number) {
    const bool is_vertex = element.name == "vertex";
    const bool is_face = element.name == "face";
    Vec3 p = Vec3::Zero();
    std::array<std::optional<double>, 3> colour;
    for (const Property& property : element.properties) {
      if (property.count_type != nullptr) {
        const bool is_corners =
            is_face && (property.name == "vertex_indices" || property.name == "vertex_index");
        if (is_corners) corners_.emplace_back();
        const double count = take_number(*property.count_type);
        for (double k = 0.0; k < count; k += 1.0) {
          const double value = take_number(*property.type);
          if (is_corners) corners_.back().push_back(value);
        }
        continue;
      }
      const double value = take_number(*property.type);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (property.name == kAxes[axis]) p[static_cast<Eigen::Index>(axis)] = value;
        if (property.name != kColours[axis]) continue;
        colour[axis] =
            property.type->is_real
                ? value
                : value / (std::ldexp(1.0, static_cast<int>(8 * property.type->bytes)) - 1.0);
      }
    }
    if (is_vertex) add_vertex(p, number);
    if (!colour[0] || !colour[1] || !colour[2] || !(is_vertex || is_face)) return;
    std::uint32_t rgb = 0;
    for (const auto& channel : colour) {
      rgb = rgb << 8 | static_cast<std::uint32_t>(
                           std::lround(255.0 * (*channel >= 0.0 ? std::min(*channel, 1.0) : 0.0)));
    }
    (is_vertex ? out_.vertex_rgb : face_rgb_).push_back(rgb);
  }

  void add_vertex(const Vec3& p, std::size_t number) {
    if (!p.allFinite() && out_.shape.not_finite.empty()) {
      out_.shape.not_finite = fmt::format("{}: vertex {} is at ({}, {}, {})", path_.string(),
                                          number, p.x(), p.y(), p.z());
    }
    append_vertex(out_.shape, p);
  }

  /// Once all vertices are known, since a file may put them last.
  void add_faces(std::vector<std::string>& warnings) {
    const auto vertex_count = static_cast<double>(out_.shape.vertices.size());
    std::size_t dropped = 0;
    bool are_triangles = true;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const bool is_possible = corners_[i].size() >= 3 &&
                               std::all_of(corners_[i].begin(), corners_[i].end(),
                                           [&](double v) { return v >= 0.0 && v < vertex_count; });
      if (!is_possible) {
        ++dropped;
        continue;
      }
      append_face(out_.shape, std::vector<std::size_t>(corners_[i].begin(), corners_[i].end()));
      are_triangles = are_triangles && corners_[i].size() == 3;
      if (face_rgb_.size() == corners_.size()) out_.face_rgb.push_back(face_rgb_[i]);
    }
    if (!are_triangles) out_.face_rgb.clear();
    if (dropped == 0) return;
    warnings.push_back(fmt::format("{}: {} faces of vertices that do not exist left out",
                                   path_.string(), dropped));
  }

  static constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
  static constexpr std::array<std::string_view, 3> kColours = {"red", "green", "blue"};

  std::filesystem::path path_;
  std::string_view rest_;
  Encoding encoding_ = Encoding::text;
  std::vector<Element> elements_;
  std::vector<std::vector<double>> corners_;
  std::vector<std::uint32_t> face_rgb_;
  PlyFile out_;
};

std::uint32_t channel_of(std::uint32_t rgb, unsigned shift) { return (rgb >> shift) & 0xffU; }

std::uint32_t mean_rgb(const PlyFile& ply, const std::array<std::uint32_t, 3>& face) {
  std::uint32_t mean = 0;
  for (const unsigned shift : {16U, 8U, 0U}) {
    std::uint32_t sum = 1;  // rounds the third of it
    for (const std::uint32_t v : face) sum += channel_of(ply.vertex_rgb[v], shift);
    mean |= sum / 3 << shift;
  }
  return mean;
}

std::uint32_t in_steps(std::uint32_t rgb) {
  std::uint32_t out = 0;
  for (const unsigned shift : {16U, 8U, 0U}) out |= (channel_of(rgb, shift) + 8) / 17 * 17 << shift;
  return out;
}

Material material_of(std::uint32_t rgb) {
  const auto linear = [&](unsigned shift) {
    return srgb_to_linear(static_cast<float>(channel_of(rgb, shift)) / 255.0F);
  };
  return {.name = fmt::format("colour_{:06x}", rgb), .rgb = {linear(16), linear(8), linear(0)}};
}

}  // namespace

PlyFile read_ply(const std::filesystem::path& path, std::string_view content,
                 std::vector<std::string>& warnings) {
  return PlyReader(path, content).read(warnings);
}

void paint(const PlyFile& ply, TriangleMesh& mesh) {
  std::vector<std::uint32_t> rgb;
  if (!ply.face_rgb.empty() && ply.face_rgb.size() == mesh.faces.size()) {
    rgb = ply.face_rgb;
  } else if (ply.vertex_rgb.size() == mesh.vertices_m.size()) {
    for (const auto& face : mesh.faces) rgb.push_back(mean_rgb(ply, face));
  }
  if (rgb.empty()) return;
  constexpr std::size_t kExactColours = 256;
  if (std::set<std::uint32_t>(rgb.begin(), rgb.end()).size() > kExactColours) {
    std::transform(rgb.begin(), rgb.end(), rgb.begin(), in_steps);
  }
  mesh.materials.clear();
  std::map<std::uint32_t, std::size_t> index_of;
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const auto [entry, is_new] = index_of.try_emplace(rgb[i], mesh.materials.size());
    if (is_new) mesh.materials.push_back(material_of(rgb[i]));
    mesh.face_material[i] = static_cast<std::uint16_t>(entry->second);
  }
}

}  // namespace gnbv
