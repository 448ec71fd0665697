// read_obj() and read_obj_text() of sim/mesh/polygon_mesh.hpp.
#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include "sim/core/file.hpp"
#include "sim/mesh/plain_text.hpp"
#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {
namespace {

/// Statements of the OBJ specification that we do not need.
constexpr std::array<std::string_view, 36> kIgnored = {
    "vp",   "s",    "l",     "p",     "o",        "g",        "mg",   "cstype", "deg",
    "bmat", "step", "curv",  "curv2", "surf",     "parm",     "trim", "hole",   "scrv",
    "sp",   "end",  "con",   "bevel", "c_interp", "d_interp", "lod",  "maplib", "usemap",
    "call", "csh",  "ctech", "stech", "bsp",      "bzp",      "cdc",  "cdp",    "res"};

/// Vertex of a face corner "v", "v/vt", "v//vn" or "v/vt/vn": counted from 1, or from the last
/// vertex so far when negative; 0 is no vertex.
std::optional<long long> corner_of(std::string_view word) {
  long long value = 0;
  const char* const last = word.data() + word.size();
  const auto [end, error] = std::from_chars(word.data(), last, value);
  if (error != std::errc() || (end != last && *end != '/')) return std::nullopt;
  const std::string_view rest(end, static_cast<std::size_t>(last - end));
  if (rest.find_first_not_of("/-0123456789") != std::string_view::npos) return std::nullopt;
  return value;
}

bool has_control_bytes(std::string_view line) {
  return std::any_of(line.begin(), line.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\t' && c != '\r') || byte == 0x7f;
  });
}

/// One number means a grey. Nothing for a spectrum or unreadable numbers.
std::optional<std::array<float, 3>> colour_in(Words words) {
  std::array<float, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = read_decimal(words[std::min(i, words.size() - 1)]);
    if (!value || std::isnan(*value)) return std::nullopt;
    rgb[i] = static_cast<float>(std::clamp(*value, 0.0, 1.0));
  }
  return rgb;
}

/// Faces ahead of the first `usemtl` have the last material of a library named before them, or
/// otherwise that of the first `usemtl`.
class ObjMaterials {
 public:
  explicit ObjMaterials(std::string path) : path_(std::move(path)) {}

  /// Takes the names and diffuse colours of a library, which may come after their use.
  void read_library(std::istream& file, const std::filesystem::path& library) {
    std::vector<std::string_view> words;
    std::string material;
    for (std::string line; std::getline(file, line);) {
      split(line, words);
      if (words.size() < 2) continue;
      const Words values = Words(words).subspan(1);
      if (words[0] == "newmtl") {
        material = joined(values);
        rgb_of_.try_emplace(material, kDefaultColour);
      } else if (words[0] == "Kd" && !material.empty()) {
        if (const auto rgb = colour_in(values)) rgb_of_[material] = *rgb;
      }
    }
    need_whole(file, library);
    if (!is_named_ && index_of_.empty() && !material.empty()) current_ = material;
  }

  void use(const std::string& name) {
    if (!is_named_ && current_ == kDefaultMaterial && !index_of_.empty()) index_of_ = {{name, 0}};
    is_named_ = true;
    if (name != current_) index_.reset();
    current_ = name;
  }

  /// Of the current material among those that faces use, in order of first use. Throws BadInput
  /// naming the file when they become too many.
  std::uint16_t index_for_face() {
    if (index_) return *index_;
    const std::size_t next = index_of_.size();
    const auto [entry, is_new] = index_of_.try_emplace(current_, static_cast<std::uint16_t>(next));
    if (is_new) as_index<std::uint16_t>(next, path_, "materials");
    index_ = entry->second;
    return *index_;
  }

  /// Those that faces use, once all is read.
  std::vector<Material> materials() const {
    std::vector<Material> out(index_of_.size());
    for (const auto& [name, index] : index_of_) {
      const auto found = rgb_of_.find(name);
      out[index] = {.name = name, .rgb = found != rgb_of_.end() ? found->second : kDefaultColour};
    }
    return out;
  }

 private:
  std::string path_;
  std::map<std::string, std::array<float, 3>> rgb_of_;  // of the libraries' materials
  std::map<std::string, std::uint16_t> index_of_;       // of the materials that faces use
  std::string current_ = std::string(kDefaultMaterial);
  std::optional<std::uint16_t> index_;  // of the current one, once a face has used it
  bool is_named_ = false;               // by a usemtl
};

/// Lines of one kind that are left out, for one warning.
struct Dropped {
  std::size_t count = 0;
  std::size_t first_line = 0;

  void add(std::size_t line) {
    if (count++ == 0) first_line = line;
  }
};

class ObjReader {
 public:
  /// `mtl` is the text of every material library; without it they are files beside `path`.
  ObjReader(std::istream& file, const std::filesystem::path& path,
            std::optional<std::string_view> mtl, std::vector<std::string>& warnings)
      : path_(path), file_(file), mtl_(mtl), warnings_(warnings), materials_(path.string()) {}

  PolygonMesh read() {
    std::string statement;
    bool goes_on = false;  // in the next line
    std::size_t number = 0;
    for (std::string line; std::getline(file_, line);) {
      ++number;
      if (!goes_on) {
        line_ = number;
        statement.clear();
      }
      while (line.ends_with('\r')) line.pop_back();
      goes_on = line.ends_with('\\');
      if (goes_on) line.pop_back();
      statement += line;
      if (!goes_on) add_statement(statement);
    }
    need_whole(file_, path_);
    if (goes_on) add_statement(statement);
    warn(unreadable_, "unreadable lines");
    warn(impossible_, "faces of vertices that do not exist");
    if (!out_.face_ends.empty()) out_.materials = materials_.materials();
    return std::move(out_);
  }

 private:
  void add_statement(std::string_view line) {
    if (has_control_bytes(line)) return drop_line();
    split(line, words_);
    if (words_.empty() || words_[0].starts_with('#')) return;
    const std::string_view keyword = words_[0];
    const Words values = Words(words_).subspan(1);
    if (keyword == "v") return add_vertex(values);
    if (keyword == "f" || keyword == "fo") return add_face(values);
    if (keyword == "vt" || keyword == "vn") {
      const bool is_readable =
          !values.empty() && std::all_of(values.begin(), values.end(),
                                         [](auto word) { return read_decimal(word).has_value(); });
      if (!is_readable) return drop_line();
    } else if (keyword == "usemtl" || keyword == "mtllib") {
      if (values.empty()) return drop_line();
      keyword == "usemtl" ? materials_.use(joined(values)) : use_library(joined(values));
    } else if (std::find(kIgnored.begin(), kIgnored.end(), keyword) == kIgnored.end()) {
      return drop_line();
    }
    settle(false);
  }

  void add_vertex(Words values) {
    settle(true);
    if (doubt_line_ != 0) fail(doubt_line_, "unreadable beside a vertex, with vertices after it");
    const std::uint32_t number = as_index(out_.vertices.size(), path_.string(), "vertices") + 1;
    Vec3 p;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = i < values.size() ? read_decimal(values[i]) : std::nullopt;
      if (!value) fail(line_, fmt::format("vertex {} has no three coordinates", number));
      if (!std::isfinite(*value) && out_.not_finite.empty()) {
        out_.not_finite = fmt::format("{}:{}: vertex {} has the coordinate {}", path_.string(),
                                      line_, number, values[i]);
      }
      p[static_cast<Eigen::Index>(i)] = *value;
    }
    out_.vertices.push_back(p);
  }

  void add_face(Words values) {
    settle(false);
    const auto count = static_cast<long long>(out_.vertices.size());
    const std::size_t begin = out_.corners.size();
    const auto drop = [&](Dropped& as) {
      out_.corners.resize(begin);
      as.add(line_);
    };
    for (const std::string_view value : values) {
      const auto corner = corner_of(value);
      if (!corner) return drop(unreadable_);
      const long long vertex = *corner < 0 ? count + 1 + *corner : *corner;
      if (vertex < 1 || vertex > count) return drop(impossible_);
      out_.corners.push_back(static_cast<std::uint32_t>(vertex - 1));
    }
    if (values.size() < 3) return drop(unreadable_);
    out_.face_ends.push_back(as_index(out_.corners.size(), path_.string(), "corners"));
    out_.face_material.push_back(materials_.index_for_face());
  }

  void use_library(const std::string& name) {
    const std::filesystem::path library = path_.parent_path() / name;
    if (mtl_) {
      std::istringstream text{std::string(*mtl_)};
      return materials_.read_library(text, library);
    }
    std::error_code ignored;  // a file that we may not look at counts as not found
    if (std::filesystem::is_regular_file(library, ignored)) {
      std::ifstream file = open_file(library);
      return materials_.read_library(file, library);
    }
    warnings_.push_back(
        fmt::format("{}:{}: material file {} not found", path_.string(), line_, name));
  }

  void drop_line() {
    unreadable_.add(line_);
    if (pending_line_ == 0) pending_line_ = line_;
  }

  /// Call it for each readable statement: it ends a run of unreadable lines. Beside a vertex these
  /// may have been vertices, and every vertex after them would have a wrong number.
  void settle(bool is_vertex) {
    const bool is_beside_vertex = is_after_vertex_ || (is_vertex && !out_.vertices.empty());
    if (pending_line_ != 0 && is_beside_vertex && doubt_line_ == 0) doubt_line_ = pending_line_;
    pending_line_ = 0;
    is_after_vertex_ = is_vertex;
  }

  void warn(const Dropped& dropped, std::string_view what) const {
    if (dropped.count == 0) return;
    warnings_.push_back(fmt::format("{}: {} {} left out, the first in line {}", path_.string(),
                                    dropped.count, what, dropped.first_line));
  }

  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw BadInput(fmt::format("{}:{}: {}", path_.string(), line, what));
  }

  std::filesystem::path path_;
  std::istream& file_;
  std::optional<std::string_view> mtl_;
  std::vector<std::string>& warnings_;
  PolygonMesh out_;
  std::size_t line_ = 0;
  std::vector<std::string_view> words_;  // of this line
  ObjMaterials materials_;
  bool is_after_vertex_ = false;  // the last readable statement was a vertex
  std::size_t pending_line_ = 0;  // first unreadable line since the last statement; 0 = none
  std::size_t doubt_line_ = 0;    // first unreadable line beside a vertex; 0 = none
  Dropped unreadable_;
  Dropped impossible_;
};

}  // namespace

PolygonMesh read_obj(const std::filesystem::path& path, std::vector<std::string>& warnings) {
  std::ifstream file = open_file(path);
  return ObjReader(file, path, std::nullopt, warnings).read();
}

PolygonMesh read_obj_text(const std::filesystem::path& path, std::string_view obj,
                          std::string_view mtl, std::vector<std::string>& warnings) {
  std::istringstream text{std::string(obj)};
  return ObjReader(text, path, mtl, warnings).read();
}

}  // namespace gnbv
