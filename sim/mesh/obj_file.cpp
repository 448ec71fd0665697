// read_obj() and read_obj_text() of sim/mesh/polygon_mesh.hpp.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

#include "sim/core/file.hpp"
#include "sim/mesh/obj_materials.hpp"
#include "sim/mesh/plain_text.hpp"
#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {
namespace {

/// Statements of the OBJ specification that we do not need.
constexpr std::array<std::string_view, 34> kIgnored = {
    "vn",  "vp",    "s",     "l",     "p",        "o",          "g",        "mg",     "cstype",
    "deg", "bmat",  "step",  "curv",  "curv2",    "parm",       "trim",     "hole",   "scrv",
    "sp",  "end",   "con",   "bevel", "c_interp", "d_interp",   "lod",      "maplib", "usemap",
    "csh", "ctech", "stech", "cdc",   "res",      "shadow_obj", "trace_obj"};
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

/// The texture coordinate "vt" of such a corner, counted in the same way; 0 is none.
long long uv_of(std::string_view word) {
  const std::size_t slash = std::min(word.find('/'), word.size() - 1);
  long long value = 0;
  std::from_chars(word.data() + slash + 1, word.data() + word.size(), value);
  return value;
}

bool has_control_bytes(std::string_view line) {
  return std::any_of(line.begin(), line.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\t' && c != '\r') || byte == 0x7f;
  });
}

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
            std::optional<std::string_view> mtl, std::vector<std::string>& warnings, bool keeps_uvs)
      : path_(path),
        file_(file),
        mtl_(mtl),
        warnings_(warnings),
        keeps_uvs_(keeps_uvs),
        materials_(path.string()) {}

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
    if (!out_.face_ends.empty()) add_looks();
    warn(unreadable_, "unreadable lines");
    warn(impossible_, "faces of vertices that do not exist");
    warn(unread_, "surfaces that are no polygons");
    out_.lost_faces = impossible_.count + broken_faces_ + unread_.count;
    return std::move(out_);
  }

 private:
  void add_statement(std::string_view line) {
    split(line, words_);
    if (words_.empty()) return;
    if (has_control_bytes(line)) {
      if (words_[0].starts_with('f')) ++broken_faces_;
      return drop_line();
    }
    const std::string_view keyword = words_[0];
    const Words values = Words(words_).subspan(1);
    if (keyword == "v") return add_vertex(values);
    if (keyword == "f" || keyword == "fo") return add_face(values);
    if (keyword == "vt") add_uv(values);
    if (keyword == "usemtl" || keyword == "mtllib") {
      if (values.empty()) return drop_line();
      keyword == "usemtl" ? materials_.use(joined(values)) : use_libraries(values);
    } else if (is_one_of(kUnread, keyword)) {
      unread_.add(line_);
    } else if (keyword != "vt" && !is_one_of(kIgnored, keyword)) {
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
    add_colour(values);
    out_.vertices.push_back(p);
  }

  /// "v x y z r g b", as of MeshLab: sRGB from 0 to 1 or, as of scanners, to 255. A file has them
  /// of all its vertices or of none.
  void add_colour(Words values) {
    if (values.size() < 6) return;
    has_colours_ = true;
    Vec3 levels;
    for (std::size_t i = 0; i < 3; ++i) {
      levels[static_cast<Eigen::Index>(i)] = read_decimal(values[3 + i]).value_or(-1.0);
    }
    const bool is_colour = (levels.array() >= 0.0 && levels.array() <= 255.0).all();
    if (is_colour && colours_.rgb.size() == out_.vertices.size()) colours_.add(levels);
  }

  void add_uv(Words values) {
    Vec2f& uv = uvs_.emplace_back(CornerLook().uv);
    const auto u = values.empty() ? std::nullopt : read_decimal(values[0]);
    const auto v = values.size() < 2 ? 0.0 : read_decimal(values[1]);
    if (u && v) uv = {static_cast<float>(*u), static_cast<float>(*v)};
  }

  /// Once all libraries are read.
  void add_looks() {
    const bool have_all = colours_.rgb.size() == out_.vertices.size();
    if (have_all && !materials_.has_library()) {
      out_.vertex_rgb = std::move(colours_.rgb);
    } else if (has_colours_) {
      warnings_.push_back(fmt::format("{}: colours of vertices left out: {}", path_.string(),
                                      materials_.has_library()
                                          ? "its materials have colours"
                                          : "not all of them have one of 0 to 1 or 255"));
    }
    TextureFiles textures(path_);
    out_.materials = materials_.materials(textures, warnings_);
    textures.warn(warnings_);
    out_.files.insert(out_.files.end(), textures.files().begin(), textures.files().end());
    const bool has_pictures = std::ranges::any_of(
        out_.materials, [](const Material& material) { return material.texture.image != nullptr; });
    if (!(has_pictures || keeps_uvs_) || corner_uvs_.empty()) return;
    corner_uvs_.resize(out_.corners.size(), kNoVertex);
    out_.corner_looks.resize(out_.corners.size());
    std::size_t corner = 0;
    for (std::size_t face = 0; face < out_.face_ends.size(); ++face) {
      for (; corner < out_.face_ends[face]; ++corner) {
        if (corner_uvs_[corner] >= uvs_.size()) continue;
        out_.corner_looks[corner].uv =
            materials_.placed(out_.face_material[face], uvs_[corner_uvs_[corner]]);
      }
    }
  }

  void add_face(Words values) {
    settle(false);
    const auto count = static_cast<long long>(out_.vertices.size());
    const std::size_t begin = out_.corners.size();
    const auto drop = [&](Dropped& as) {
      out_.corners.resize(begin);
      corner_uvs_.resize(std::min(begin, corner_uvs_.size()));
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
      const long long named = uv_of(value);
      if (named == 0 || !materials_.may_have_pictures()) continue;
      const long long uv = named < 0 ? static_cast<long long>(uvs_.size()) + named : named - 1;
      corner_uvs_.resize(out_.corners.size(), kNoVertex);
      corner_uvs_.back() = static_cast<std::uint32_t>(std::clamp(uv, -1LL, kMostUvs));
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
    const std::filesystem::path as_named = path_.parent_path() / name;
    if (mtl_) {
      std::istringstream text{std::string(*mtl_)};
      return materials_.read_library(text, as_named, "");
    }
    const std::filesystem::path library = file_of_uri(path_, name);
    if (!library.empty()) {
      std::ifstream file = open_file(library);
      out_.files.push_back(library);
      const bool is_there = library == as_named;
      return materials_.read_library(
          file, library,
          (is_there ? std::filesystem::path(name) : std::filesystem::absolute(library))
              .parent_path());
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
    throw BadInput("{}:{}: {}", path_.string(), line, what);
  }

  std::filesystem::path path_;
  std::istream& file_;
  std::optional<std::string_view> mtl_;
  std::vector<std::string>& warnings_;
  const bool keeps_uvs_;
  static constexpr long long kMostUvs = kNoVertex;
  PolygonMesh out_;
  bool has_colours_ = false;               // any vertex
  LevelColours colours_{1.0, 255.0};       // of the vertices, up to the first without one
  std::vector<Vec2f> uvs_;                 // of the vt
  std::vector<std::uint32_t> corner_uvs_;  // of the corners so far, or of the first of them
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

PolygonMesh read_obj(const std::filesystem::path& path, std::vector<std::string>& warnings,
                     bool keeps_uvs) {
  std::ifstream file = open_file(path);
  return ObjReader(file, path, std::nullopt, warnings, keeps_uvs).read();
}

PolygonMesh read_obj_text(const std::filesystem::path& path, std::string_view obj,
                          std::string_view mtl, std::vector<std::string>& warnings) {
  std::istringstream text{std::string(obj)};
  return ObjReader(text, path, mtl, warnings, false).read();
}

}  // namespace gnbv
