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
constexpr std::array<std::string_view, 35> kIgnored = {
    "vt",     "vn",  "vp",    "s",     "l",     "p",        "o",          "g",        "mg",
    "cstype", "deg", "bmat",  "step",  "curv",  "curv2",    "parm",       "trim",     "hole",
    "scrv",   "sp",  "end",   "con",   "bevel", "c_interp", "d_interp",   "lod",      "maplib",
    "usemap", "csh", "ctech", "stech", "cdc",   "res",      "shadow_obj", "trace_obj"};
/// Those that hold surface: free forms, patches and other files.
constexpr std::array<std::string_view, 5> kUnread = {"surf", "bsp", "bzp", "cdp", "call"};

bool is_one_of(std::span<const std::string_view> words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Whether a word may be a statement that some program made up: no damaged vertex begins so.
bool is_keyword(std::string_view word) {
  return word.size() >= 2 && std::all_of(word.begin(), word.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
         });
}

/// Where a comment begins: at a # that begins a word; the length without one. A name may hold one.
std::size_t comment_in(std::string_view line) {
  std::string_view rest = line;
  const std::string_view keyword = take_word(rest);
  constexpr std::array<std::string_view, 4> kOfNames = {"usemtl", "mtllib", "o", "g"};
  if (is_one_of(kOfNames, keyword)) return line.size();
  if (keyword.starts_with('#')) return 0;
  for (std::size_t at = 0; (at = line.find('#', at)) != line.npos; ++at) {
    if (at == 0 || line[at - 1] == ' ' || line[at - 1] == '\t') return at;
  }
  return line.size();
}

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
    LineReader lines(file);
    for (std::string_view line; lines.next(line);) {
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
      auto found = rgb_of_.find(name);
      if (found == rgb_of_.end()) found = rgb_of_.find(name.substr(0, name.find(" #")));
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
    LineReader lines(file_);
    for (std::string_view line; lines.next(line);) {
      if (!goes_on) {
        line_ = lines.number();
        statement.clear();
      }
      statement += line;
      const std::size_t comment = comment_in(statement);
      goes_on = comment == statement.size() && statement.ends_with('\\');
      statement.resize(goes_on ? comment - 1 : comment);
      if (!goes_on) add_statement(statement);
    }
    need_whole(file_, path_);
    if (goes_on) add_statement(statement);
    warn(unreadable_, "unreadable lines");
    warn(impossible_, "faces of vertices that do not exist");
    warn(unread_, "surfaces that are no polygons");
    out_.lost_faces = impossible_.count + broken_faces_ + unread_.count;
    if (!out_.face_ends.empty()) out_.materials = materials_.materials();
    return std::move(out_);
  }

 private:
  void add_statement(std::string_view line) {
    if (has_control_bytes(line)) return drop_line();
    split(line, words_);
    if (words_.empty()) return;
    const std::string_view keyword = words_[0];
    const Words values = Words(words_).subspan(1);
    if (keyword == "v") return add_vertex(values);
    if (keyword == "f" || keyword == "fo") return add_face(values);
    if (keyword == "usemtl" || keyword == "mtllib") {
      if (values.empty()) return drop_line();
      keyword == "usemtl" ? materials_.use(joined(values)) : use_libraries(values);
    } else if (is_one_of(kUnread, keyword)) {
      unread_.add(line_);
    } else if (!is_one_of(kIgnored, keyword)) {
      if (!is_keyword(keyword)) return drop_line();
      unreadable_.add(line_);
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
    const auto drop_broken = [&] {
      ++broken_faces_;
      drop(unreadable_);
    };
    for (const std::string_view value : values) {
      const auto corner = corner_of(value);
      if (!corner) return drop_broken();
      const long long vertex = *corner < 0 ? count + 1 + *corner : *corner;
      if (vertex < 1 || vertex > count) return drop(impossible_);
      out_.corners.push_back(static_cast<std::uint32_t>(vertex - 1));
    }
    if (values.size() < 3) return drop_broken();
    out_.face_ends.push_back(as_index(out_.corners.size(), path_.string(), "corners"));
    out_.face_material.push_back(materials_.index_for_face());
  }

  /// One name with blanks in it or, where there is no such file, several.
  void use_libraries(Words names) {
    std::error_code ignored;
    const bool are_several = !mtl_ && names.size() > 1 &&
                             !std::filesystem::exists(path_.parent_path() / joined(names), ignored);
    if (!are_several) return use_library(joined(names));
    for (const std::string_view name : names) {
      if (name.starts_with('#')) break;
      use_library(std::string(name));
    }
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
  Dropped unread_;
  std::size_t broken_faces_ = 0;  // of the unreadable lines
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
