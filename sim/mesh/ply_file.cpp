// The PLY readers of sim/mesh/polygon_mesh.hpp. Our own, since assimp's (5.2.4) crashes on sound
// binary files and does not know the colours of faces.
#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

#include "sim/core/file.hpp"
#include "sim/mesh/plain_text.hpp"
#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {
namespace {

struct PlyType {
  std::string_view name, other_name;
  std::size_t bytes;
  double full;  // level of a colour channel
  double (*number_at)(const char* bytes);
};

constexpr std::array kTypes = {
    PlyType{"char", "int8", 1, 255.0,
            [](const char* at) { return static_cast<double>(number_at<std::int8_t>(at)); }},
    PlyType{"uchar", "uint8", 1, 255.0,
            [](const char* at) { return static_cast<double>(number_at<std::uint8_t>(at)); }},
    PlyType{"short", "int16", 2, 65535.0,
            [](const char* at) { return static_cast<double>(number_at<std::int16_t>(at)); }},
    PlyType{"ushort", "uint16", 2, 65535.0,
            [](const char* at) { return static_cast<double>(number_at<std::uint16_t>(at)); }},
    PlyType{"int", "int32", 4, 4294967295.0,
            [](const char* at) { return static_cast<double>(number_at<std::int32_t>(at)); }},
    PlyType{"uint", "uint32", 4, 4294967295.0,
            [](const char* at) { return static_cast<double>(number_at<std::uint32_t>(at)); }},
    PlyType{"float", "float32", 4, 1.0,
            [](const char* at) { return static_cast<double>(number_at<float>(at)); }},
    PlyType{"double", "float64", 8, 1.0,
            [](const char* at) { return static_cast<double>(number_at<double>(at)); }},
};

struct PlyProperty {
  std::string name;
  const PlyType* type = nullptr;
  const PlyType* count_type = nullptr;  // of a list; null for a single number

  bool is_corners() const { return count_type != nullptr && name.starts_with("vertex_ind"); }
  /// Without it there is no shape: it must be a number.
  bool is_needed() const { return is_corners() || name == "x" || name == "y" || name == "z"; }
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

using PlyItem = std::vector<std::vector<double>>;  // the numbers of each property, and one 0 more
using Columns = std::array<std::size_t, 3>;        // into it

/// The properties of these names that are no lists, the last of each name; or the 0.
Columns columns_of(const PlyElement& element, const std::array<std::string_view, 3>& names) {
  const std::size_t count = element.properties.size();
  Columns found = {count, count, count};
  for (std::size_t i = 0; i < count; ++i) {
    const PlyProperty& property = element.properties[i];
    for (std::size_t k = 0; k < 3; ++k) {
      if (property.count_type == nullptr && property.name == names[k]) found[k] = i;
    }
  }
  return found;
}

Vec3 position_of(const PlyItem& item, const Columns& xyz) {
  return {item[xyz[0]][0], item[xyz[1]][0], item[xyz[2]][0]};
}

/// Appends 0xrrggbb, if the element has all three channels.
void add_colour(const PlyItem& item, const PlyElement& element, const Columns& columns,
                std::vector<std::uint32_t>& colours) {
  std::uint32_t rgb = 0;
  for (const std::size_t column : columns) {
    if (column == element.properties.size()) return;
    const double level = item[column][0] / element.properties[column].type->full;
    // NaN counts as 0
    rgb = rgb << 8 | static_cast<std::uint32_t>(
                         std::lround(255.0 * (level >= 0.0 ? std::min(level, 1.0) : 0.0)));
  }
  colours.push_back(rgb);
}

/// A PLY file: a header, and the items of the elements that it announces, in text or in bytes of
/// either order.
class PlyFile {
 public:
  /// Reads the header.
  explicit PlyFile(const std::filesystem::path& path) : path_(path.string()), in_(open_file(path)) {
    static_assert(std::endian::native == std::endian::little);
    std::error_code ignored;  // of a pipe
    const auto size = std::filesystem::file_size(path, ignored);
    if (!ignored) bytes_ = size;
    read_header();
  }

  const std::string& path() const { return path_; }
  const std::vector<PlyElement>& elements() const { return elements_; }

  /// Calls use(item) for each item of the next element.
  template <typename Use>
  void for_each_item(const PlyElement& element, const Use& use) {
    const std::size_t properties = element.properties.size();
    if (properties == 0) return;
    PlyItem item(properties + 1, {0.0});
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t k = 0; k < properties; ++k) {
        const PlyProperty& property = element.properties[k];
        double count = 1.0;
        if (property.count_type != nullptr) {
          take_numbers(*property.count_type, 1.0, true, item[k]);
          count = item[k][0];
        }
        take_numbers(*property.type, count, property.is_needed(), item[k]);
      }
      end_row(element);
      use(item);
    }
  }

  /// Whether a row does not end with its line, so that only the end tells of words left over.
  bool is_free() const { return is_free_.value_or(false); }

  /// Warns of what stands after all that the header announces; how many faces that may be.
  std::size_t warn_of_rest(std::vector<std::string>& warnings) {
    std::size_t count = 0;
    if (is_text_) {
      do {
        count += take_word(rest_).empty() ? 0 : 1;
        if (is_free() && count > 0) fail_in_row("more words than its header announces");
      } while (lines_->next(rest_));
    } else {
      in().ignore(std::numeric_limits<std::streamsize>::max());
      count = static_cast<std::size_t>(in().gcount());
    }
    constexpr std::size_t kBlanks = 2, kFace = 13;  // bytes
    if (count <= (is_text_ ? 0 : kBlanks)) return 0;
    warnings.push_back(fmt::format("{}: {} {} after all that its header announces left out", path_,
                                   count, is_text_ ? "rows" : "bytes"));
    return is_text_ ? count : count / kFace;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw BadInput(fmt::format("{}: {}", path_, what));
  }

  /// How many items are worth reserving, whatever the header says.
  std::size_t most_items(const PlyElement& element) const {
    return std::min<std::uint64_t>(element.count,
                                   bytes_ / std::max<std::size_t>(element.properties.size(), 1));
  }

 private:
  [[noreturn]] void fail_in_row(const std::string& what) const {
    throw BadInput(fmt::format("{}:{}: {}", path_, header_lines_ + lines_->number(), what));
  }

  /// The first row of a text says whether rows end with their lines.
  void end_row(const PlyElement& element) {
    std::string_view left = rest_;
    const std::string_view word = is_text_ ? take_word(left) : "";
    if (!is_free_) is_free_ = !word.empty();
    if (word.empty() || *is_free_) return;
    fail_in_row(fmt::format("a row of '{}' has more words than the header says, from '{}' on",
                            element.name, word.substr(0, 60)));
  }

  std::istream& in() { return converted_ ? static_cast<std::istream&>(*converted_) : in_; }

  /// A line of the header. Bytes may follow the last one at once: a line feed after a carriage
  /// return belongs to it where that is so in the first line.
  bool next_header_line() {
    line_.clear();
    ++header_lines_;
    for (char c = '\0'; in().get(c); line_ += c) {
      if (c == '\r' && (header_lines_ == 1 || !ends_in_cr_) && in().peek() == '\n') in().get(c);
      if (c != '\n' && c != '\r') continue;
      if (header_lines_ == 1) ends_in_cr_ = c == '\r';
      return true;
    }
    return !line_.empty();
  }

  void read_header() {
    std::vector<std::string_view> words;
    next_header_line();
    if (is_utf16(line_)) {
      line_ += ends_in_cr_ ? '\r' : '\n';
      line_.append(std::istreambuf_iterator<char>(in_), {});
      converted_.emplace(as_utf8(std::move(line_)));
      header_lines_ = 0;
      next_header_line();
    }
    line_ = as_utf8(std::move(line_));
    need_whole(in_, path_);
    split(line_, words);
    if (words.size() != 1 || words[0] != "ply") fail("is no PLY file: its first line is not 'ply'");
    while (next_header_line()) {
      split(line_, words);
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") {
        lines_.emplace(in());
        return;
      }
      if (!read_declaration(words)) fail(fmt::format("its header has a bad '{}' line", words[0]));
    }
    need_whole(in_, path_);
    fail("its header has no end_header");
  }

  bool read_declaration(Words words) {
    const std::size_t n = words.size();
    if (words[0] == "format" && n >= 2) {
      is_text_ = words[1] == "ascii";
      is_big_endian_ = words[1] == "binary_big_endian";
      return is_text_ || is_big_endian_ || words[1] == "binary_little_endian";
    }
    if (words[0] == "element" && n == 3) {
      PlyElement& element = elements_.emplace_back();
      element.name = in_lower_case(words[1]);
      const char* const last = words[2].data() + words[2].size();
      const auto [end, error] = std::from_chars(words[2].data(), last, element.count);
      return error == std::errc() && end == last;
    }
    if (words[0] != "property" || elements_.empty()) return false;
    const bool is_list = n == 5 && words[1] == "list";
    if (n != 3 && !is_list) return false;
    elements_.back().properties.push_back({in_lower_case(words[n - 1]), type_of(words[n - 2]),
                                           is_list ? type_of(words[2]) : nullptr});
    return true;
  }

  const PlyType* type_of(std::string_view name) const {
    for (const PlyType& type : kTypes) {
      if (name == type.name || name == type.other_name) return &type;
    }
    fail(fmt::format("its header names the unknown type '{}'", name));
  }

  /// Reads in pieces, since a wrong count may be of any size.
  void take_numbers(const PlyType& type, double count, bool is_needed,
                    std::vector<double>& numbers) {
    std::array<char, 16 * sizeof(double)> bytes;
    numbers.clear();
    std::size_t piece = 1;
    auto left = static_cast<std::size_t>(std::ceil(count > 0.0 ? std::min(count, 1e18) : 0.0));
    for (; left > 0; left -= piece) {
      if (is_text_) {
        numbers.push_back(take_number(is_needed));
        continue;
      }
      piece = std::min<std::size_t>(left, 16);
      if (!in().read(bytes.data(), static_cast<std::streamsize>(piece * type.bytes))) end_early();
      for (std::size_t i = 0; i < piece; ++i) {
        char* const first = bytes.data() + i * type.bytes;
        if (is_big_endian_) std::reverse(first, first + type.bytes);
        numbers.push_back(type.number_at(first));
      }
    }
  }

  double take_number(bool is_needed) {
    std::string_view word;
    while ((word = take_word(rest_)).empty()) {
      if (!lines_->next(rest_)) end_early();
    }
    const auto value = read_decimal(word);
    if (!value && is_needed) fail_in_row(fmt::format("'{}' is no number", word.substr(0, 60)));
    return value.value_or(std::numeric_limits<double>::quiet_NaN());
  }

  [[noreturn]] void end_early() const {
    need_whole(in_, path_);
    fail("ends before all that its header announces");
  }

  std::string path_;
  std::ifstream in_;
  std::optional<std::istringstream> converted_;  // from UTF-16
  std::uint64_t bytes_ = 0;                      // of the file
  std::string line_;                             // of the header
  std::size_t header_lines_ = 0;
  bool ends_in_cr_ = false;          // its first line
  std::optional<bool> is_free_;      // a text, of rows that do not end with their lines
  std::optional<LineReader> lines_;  // after it
  std::string_view rest_;            // of a line of those
  bool is_text_ = true, is_big_endian_ = false;
  std::vector<PlyElement> elements_;
};

Columns xyz_of(const PlyFile& ply, const PlyElement& element) {
  constexpr std::array<std::string_view, 3> kNames = {"x", "y", "z"};
  const Columns xyz = columns_of(element, kNames);
  for (std::size_t k = 0; k < 3; ++k) {
    if (xyz[k] == element.properties.size()) {
      ply.fail(fmt::format("its vertices have no property '{}'", kNames[k]));
    }
  }
  return xyz;
}

void read_vertices(PlyFile& ply, const PlyElement& element, PolygonMesh& out) {
  const Columns xyz = xyz_of(ply, element);
  const Columns rgb = columns_of(element, {"red", "green", "blue"});
  out.vertices.reserve(out.vertices.size() + ply.most_items(element));
  std::uint64_t i = 0;  // within the element
  ply.for_each_item(element, [&](const PlyItem& item) {
    const Vec3 p = position_of(item, xyz);
    if (!p.allFinite() && out.not_finite.empty()) {
      out.not_finite =
          fmt::format("{}: vertex {} is at ({}, {}, {})", ply.path(), i, p.x(), p.y(), p.z());
    }
    ++i;
    as_index(out.vertices.size(), ply.path(), "vertices");
    out.vertices.push_back(p);
    add_colour(item, element, rgb, out.vertex_rgb);
  });
}

std::uint32_t corner_from(double vertex) {
  return vertex >= 0.0 && vertex < kNoVertex ? static_cast<std::uint32_t>(vertex) : kNoVertex;
}

/// Which of an element's properties list corners. Refuses an element whose lists do not.
std::vector<std::size_t> corner_lists_of(const PlyFile& ply, const PlyElement& element) {
  std::vector<std::size_t> lists;
  std::string others;
  for (std::size_t k = 0; k < element.properties.size(); ++k) {
    const PlyProperty& property = element.properties[k];
    if (property.is_corners()) lists.push_back(k);
    if (property.count_type != nullptr) others += fmt::format(" '{}'", property.name);
  }
  if (lists.empty() && element.count > 0) {
    ply.fail(fmt::format("its element '{}' lists{}, not vertex_indices", element.name,
                         others.empty() ? " nothing" : others));
  }
  return lists;
}

/// Each strip's triangles turn in the same sense; -1 begins another strip.
void read_strips(PlyFile& ply, const PlyElement& element, PolygonMesh& out) {
  const std::vector<std::size_t> lists = corner_lists_of(ply, element);
  ply.for_each_item(element, [&](const PlyItem& item) {
    for (const std::size_t k : lists) {
      std::size_t length = 0;
      for (std::size_t i = 0; i < item[k].size(); ++i) {
        length = item[k][i] == -1.0 ? 0 : length + 1;
        if (length < 3) continue;
        const bool is_odd = length % 2 == 0;
        for (const std::size_t back : {is_odd ? 1U : 2U, is_odd ? 2U : 1U, 0U}) {
          out.corners.push_back(corner_from(item[k][i - back]));
        }
        out.face_ends.push_back(as_index(out.corners.size(), ply.path(), "corners"));
      }
    }
  });
}

/// Takes vertices of any number: a file may list the vertices after the faces.
void read_faces(PlyFile& ply, const PlyElement& element, PolygonMesh& out,
                std::vector<std::uint32_t>& face_rgb) {
  const Columns rgb = columns_of(element, {"red", "green", "blue"});
  const std::vector<std::size_t> lists = corner_lists_of(ply, element);
  out.face_ends.reserve(out.face_ends.size() + ply.most_items(element));
  out.corners.reserve(out.corners.size() + 3 * ply.most_items(element));
  ply.for_each_item(element, [&](const PlyItem& item) {
    for (const std::size_t k : lists) {
      for (const double vertex : item[k]) out.corners.push_back(corner_from(vertex));
      out.face_ends.push_back(as_index(out.corners.size(), ply.path(), "corners"));
    }
    add_colour(item, element, rgb, face_rgb);
  });
}

/// Drops faces of fewer than three corners or of vertices that do not exist, with their colours.
/// Returns how many.
std::size_t drop_impossible_faces(PolygonMesh& mesh, std::vector<std::uint32_t>& face_rgb) {
  std::size_t faces = 0, corners = 0, begin = 0;  // of those that are kept
  for (std::size_t i = 0; i < mesh.face_ends.size(); ++i) {
    const auto face = std::span(mesh.corners).subspan(begin, mesh.face_ends[i] - begin);
    begin = mesh.face_ends[i];
    if (face.size() < 3 || *std::max_element(face.begin(), face.end()) >= mesh.vertices.size()) {
      continue;
    }
    std::copy(face.begin(), face.end(),
              mesh.corners.begin() + static_cast<std::ptrdiff_t>(corners));
    corners += face.size();
    if (!face_rgb.empty()) face_rgb[faces] = face_rgb[i];
    mesh.face_ends[faces++] = static_cast<std::uint32_t>(corners);
  }
  const std::size_t dropped = mesh.face_ends.size() - faces;
  mesh.face_ends.resize(faces);
  mesh.corners.resize(corners);
  if (!face_rgb.empty()) face_rgb.resize(faces);
  return dropped;
}

}  // namespace

PolygonMesh read_ply(const std::filesystem::path& path, std::vector<std::string>& warnings) {
  PlyFile ply(path);
  PolygonMesh out;
  std::vector<std::uint32_t> face_rgb;  // 0xrrggbb in sRGB
  const auto is_shape = [](const PlyElement& element) {
    return element.name == "vertex" || element.name == "face" || element.name == "tristrips";
  };
  const std::vector<PlyElement>& all = ply.elements();
  const auto last = std::find_if(all.rbegin(), all.rend(), is_shape).base();
  for (auto at = all.begin(); at != last || (ply.is_free() && at != all.end()); ++at) {
    const PlyElement& element = *at;
    if (element.name == "vertex") {
      read_vertices(ply, element, out);
    } else if (element.name == "face") {
      read_faces(ply, element, out, face_rgb);
    } else if (element.name == "tristrips") {
      read_strips(ply, element, out);
    } else {
      ply.for_each_item(element, [](const PlyItem&) {});
    }
  }
  if (last == all.end() || ply.is_free()) out.lost_faces = ply.warn_of_rest(warnings);
  if (face_rgb.size() != out.face_ends.size()) face_rgb.clear();
  if (const std::size_t dropped = drop_impossible_faces(out, face_rgb); dropped > 0) {
    out.lost_faces += dropped;
    warnings.push_back(
        fmt::format("{}: {} faces of vertices that do not exist left out", ply.path(), dropped));
  }
  if (!face_rgb.empty()) take_colours(face_rgb, out.materials, out.face_material);
  if (!face_rgb.empty() || out.vertex_rgb.size() != out.vertices.size()) out.vertex_rgb.clear();
  return out;
}

std::vector<Vec3f> read_ply_points(const std::filesystem::path& path) {
  PlyFile ply(path);
  std::vector<Vec3f> points;
  for (const PlyElement& element : ply.elements()) {
    const bool is_vertices = element.name == "vertex" && !element.properties.empty();
    const Columns xyz = is_vertices ? xyz_of(ply, element) : Columns{};
    if (is_vertices) points.reserve(ply.most_items(element));
    ply.for_each_item(element, [&](const PlyItem& item) {
      if (is_vertices) points.push_back(position_of(item, xyz).cast<float>());
    });
    if (is_vertices && !ply.is_free()) break;
  }
  std::vector<std::string> ignored;
  if (ply.is_free()) ply.warn_of_rest(ignored);
  return points;
}

}  // namespace gnbv
