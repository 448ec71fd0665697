#include "tools/run_files/cloud_file.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include "sim/core/append_bytes.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/mesh/ply_file.hpp"

namespace gnbv {

static_assert(sizeof(Vec3f) == 3 * sizeof(float));

namespace {

/// Where the vertices of the most common layout lie: float x, y, z one after the other in records
/// of one length, ahead of all other elements.
struct PlainPly {
  std::size_t begin = 0;  // of the first x, in bytes
  std::size_t stride = 0;
  std::size_t count = 0;
};

std::optional<std::size_t> bytes_of_type(const std::string& type) {
  for (const auto& [names, bytes] : {std::pair{" char uchar int8 uint8 ", 1},
                                     {" short ushort int16 uint16 ", 2},
                                     {" int uint float int32 uint32 float32 ", 4},
                                     {" double float64 ", 8}}) {
    if (std::string_view(names).find(" " + type + " ") != std::string_view::npos) {
      return static_cast<std::size_t>(bytes);
    }
  }
  return std::nullopt;
}

/// Nothing for any other PLY file, damaged ones too: the general reader takes those.
std::optional<PlainPly> find_plain_ply(std::string_view content) {
  constexpr std::string_view kEnd = "\nend_header\n";
  const std::size_t end = content.find(kEnd);
  if (end == std::string_view::npos) return std::nullopt;
  std::istringstream header{std::string(content.substr(0, end))};
  PlainPly ply{.begin = end + kEnd.size()};
  std::string axes;  // the properties so far that are x, y or z, one after the other
  bool is_vertex = false;
  bool is_first = true;
  bool is_little = false;
  for (std::string line; std::getline(header, line);) {
    std::istringstream words(line);
    std::string word, type, name;
    words >> word >> type >> name;
    if (word == "format") is_little = type == "binary_little_endian";
    if (word == "element") {
      is_vertex = is_first && type == "vertex";
      is_first = false;
      if (!is_vertex) break;
      const auto [last, error] = std::from_chars(name.data(), name.data() + name.size(), ply.count);
      if (error != std::errc() || last != name.data() + name.size()) return std::nullopt;
    }
    if (word != "property" || !is_vertex) continue;
    const auto bytes = bytes_of_type(type);
    if (!bytes) return std::nullopt;
    if (name == "x" || name == "y" || name == "z") {
      if (type != "float" && type != "float32") return std::nullopt;
      if (axes.empty()) ply.begin += ply.stride;
      axes += name;
    } else if (!axes.empty() && axes.size() < 3) {
      return std::nullopt;
    }
    ply.stride += *bytes;
  }
  const bool is_plain = is_little && axes == "xyz" && ply.count <= content.size() / ply.stride &&
                        end + kEnd.size() + ply.count * ply.stride <= content.size();
  return is_plain ? std::optional(ply) : std::nullopt;
}

std::vector<Vec3f> read_ply_cloud(const std::filesystem::path& path, std::string_view content) {
  std::vector<Vec3f> points_m;
  if (const auto plain = find_plain_ply(content)) {
    points_m.resize(plain->count);
    const char* record = content.data() + plain->begin;
    for (Vec3f& p_m : points_m) {
      std::memcpy(p_m.data(), record, sizeof(Vec3f));
      record += plain->stride;
    }
    return points_m;
  }
  std::vector<std::string> of_faces;  // which do not matter here
  const PlyFile ply = read_ply(path, content, of_faces);
  points_m.reserve(ply.shape.vertices.size());
  for (const Vec3& p_m : ply.shape.vertices) points_m.push_back(p_m.cast<float>());
  return points_m;
}

/// The next number of a line, which is cut off; nothing where there is none.
std::optional<float> take_number(std::string_view& line) {
  constexpr std::string_view kBetween = " \t\r,;";
  line.remove_prefix(std::min(line.find_first_not_of(kBetween), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBetween));
  line.remove_prefix(word.size());
  const std::string text(word);  // ends where the word does
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') return std::nullopt;
  return static_cast<float>(value);
}

std::vector<Vec3f> read_xyz_cloud(const std::filesystem::path& path, std::string_view content) {
  std::vector<Vec3f> points_m;
  for (std::size_t number = 1; !content.empty(); ++number) {
    std::string_view line = content.substr(0, content.find('\n'));
    content.remove_prefix(std::min(line.size() + 1, content.size()));
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos || line[first] == '#') continue;
    const std::string_view whole = line;
    Vec3f p_m;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto value = take_number(line);
      if (!value) {
        throw BadInput(fmt::format("{}:{}: '{}' does not begin with three numbers", path.string(),
                                   number, whole.substr(0, 60)));
      }
      p_m[axis] = *value;
    }
    points_m.push_back(p_m);
  }
  return points_m;
}

}  // namespace

void write_cloud_ply(std::span<const Vec3f> points_world_m, const std::filesystem::path& path,
                     const CloudColumns& columns) {
  const auto& [colours, views] = columns;
  const std::size_t count = points_world_m.size();
  GNBV_CHECK(colours.empty() || colours.size() == count, "{} of {} colours", colours.size(), count);
  GNBV_CHECK(views.empty() || views.size() == count, "{} of {} views", views.size(), count);
  std::string content = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment gnbv, world ENU, metres\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n",
      count);
  if (!colours.empty()) {
    content += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  }
  if (!views.empty()) content += "property int view\n";
  content += "end_header\n";
  content.reserve(content.size() + 19 * count);
  for (std::size_t i = 0; i < count; ++i) {
    for (const float x : points_world_m[i]) append_bytes(content, x);
    if (!colours.empty()) {
      for (const std::uint8_t level : colours[i]) append_bytes(content, level);
    }
    if (!views.empty()) append_bytes(content, views[i]);
  }
  write_file_atomically(path, content);
}

std::vector<Vec3f> read_cloud(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension != ".ply" && extension != ".xyz") {
    throw BadInput(fmt::format("{}: a cloud is a .ply or an .xyz file", path.string()));
  }
  const std::string content = read_file(path);
  return extension == ".ply" ? read_ply_cloud(path, content) : read_xyz_cloud(path, content);
}

}  // namespace gnbv
