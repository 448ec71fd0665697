#include "sim/mesh/obj_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kBlanks = " \t\r";

/// Statements of the OBJ specification that say nothing about the shape we keep.
constexpr std::array<std::string_view, 36> kIgnored = {
    "vp",   "s",    "l",     "p",     "o",        "g",        "mg",   "cstype", "deg",
    "bmat", "step", "curv",  "curv2", "surf",     "parm",     "trim", "hole",   "scrv",
    "sp",   "end",  "con",   "bevel", "c_interp", "d_interp", "lod",  "maplib", "usemap",
    "call", "csh",  "ctech", "stech", "bsp",      "bzp",      "cdc",  "cdp",    "res"};

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> tokens;
  while (true) {
    const std::size_t begin = line.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return tokens;
    line.remove_prefix(begin);
    tokens.push_back(line.substr(0, line.find_first_of(kBlanks)));
    line.remove_prefix(tokens.back().size());
  }
}

std::optional<double> number_of(std::string_view token) {
  if (token.starts_with('+')) token.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (end != token.data() + token.size() || token.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range) return std::numeric_limits<double>::infinity();
  return error == std::errc() ? std::optional(value) : std::nullopt;
}

/// Vertex of a face corner "v", "v/vt", "v//vn" or "v/vt/vn": counted from 1, or from the last
/// vertex so far when negative; 0 is no vertex.
std::optional<long long> corner_of(std::string_view token) {
  long long value = 0;
  const char* const last = token.data() + token.size();
  const auto [end, error] = std::from_chars(token.data(), last, value);
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

/// Lines of one kind that were left out, for one warning.
struct Dropped {
  std::size_t count = 0;
  std::size_t first_line = 0;

  void add(std::size_t line) {
    if (count++ == 0) first_line = line;
  }
};

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, std::vector<std::string>& warnings)
      : path_(path), warnings_(warnings) {}

  ObjText read(std::string_view content) {
    std::size_t number = 0;
    while (!content.empty()) {
      std::size_t first = number + 1;
      std::string line;
      bool goes_on = true;
      while (goes_on && !content.empty()) {  // a backslash at the end continues the line
        ++number;
        std::string_view part = content.substr(0, content.find('\n'));
        content.remove_prefix(std::min(part.size() + 1, content.size()));
        while (part.ends_with('\r')) part.remove_suffix(1);
        goes_on = part.ends_with('\\');
        if (goes_on) part.remove_suffix(1);
        line += part;
      }
      line_ = first;
      add_line(line);
    }
    warn(unreadable_, "unreadable lines");
    warn(impossible_, "faces of vertices that do not exist");
    return std::move(out_);
  }

 private:
  void add_line(std::string_view line) {
    if (has_control_bytes(line)) return drop_line();
    const std::vector<std::string_view> tokens = split(line);
    if (tokens.empty() || tokens[0].starts_with('#')) return;
    const std::string_view keyword = tokens[0];
    const std::span<const std::string_view> values = std::span(tokens).subspan(1);
    if (keyword == "v") return add_vertex(values);
    if (keyword == "f" || keyword == "fo") return add_face(values);
    if (keyword == "vt" || keyword == "vn") {
      const bool is_readable =
          !values.empty() && std::all_of(values.begin(), values.end(),
                                         [](auto t) { return number_of(t).has_value(); });
      if (!is_readable) return drop_line();
    } else if (keyword == "usemtl" || keyword == "mtllib") {
      if (values.empty()) return drop_line();
      const std::string name(values.front().data(), values.back().data() + values.back().size());
      keyword == "usemtl" ? use_material(name) : use_library(name);
    } else if (std::find(kIgnored.begin(), kIgnored.end(), keyword) == kIgnored.end()) {
      return drop_line();
    }
    settle(false);
  }

  void add_vertex(std::span<const std::string_view> values) {
    settle(true);
    if (doubt_line_ != 0) fail(doubt_line_, "unreadable beside a vertex, with vertices after it");
    Vec3 p;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = i < values.size() ? number_of(values[i]) : std::nullopt;
      if (!value) fail(line_, fmt::format("vertex {} has no three coordinates", next_vertex()));
      if (!std::isfinite(*value) && out_.not_finite.empty()) {
        out_.not_finite = fmt::format("{}:{}: vertex {} has the coordinate {}", path_.string(),
                                      line_, next_vertex(), values[i]);
      }
      p[static_cast<Eigen::Index>(i)] = *value;
    }
    append_vertex(out_, p);
  }

  void add_face(std::span<const std::string_view> values) {
    settle(false);
    const auto count = static_cast<long long>(out_.vertices.size());
    std::vector<std::size_t> corners;
    for (const std::string_view value : values) {
      const auto corner = corner_of(value);
      if (!corner) return unreadable_.add(line_);
      const long long vertex = *corner < 0 ? count + 1 + *corner : *corner;
      if (vertex < 1 || vertex > count) return impossible_.add(line_);
      corners.push_back(static_cast<std::size_t>(vertex) - 1);
    }
    if (values.size() < 3) return unreadable_.add(line_);
    append_face(out_, corners);
  }

  void use_material(const std::string& name) { out_.text += "usemtl " + name + '\n'; }

  void use_library(const std::string& name) {
    const std::filesystem::path library = std::filesystem::absolute(path_).parent_path() / name;
    if (std::filesystem::is_regular_file(library)) {
      out_.text += "mtllib " + library.string() + '\n';
    } else {
      warnings_.push_back(
          fmt::format("{}:{}: material file {} not found", path_.string(), line_, name));
    }
  }

  void drop_line() {
    unreadable_.add(line_);
    if (pending_line_ == 0) pending_line_ = line_;
  }

  /// A readable statement ends a run of unreadable lines. Beside a vertex the run may have been
  /// vertices too, and every vertex after it would carry a wrong number.
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

  std::size_t next_vertex() const { return out_.vertices.size() + 1; }

  std::filesystem::path path_;
  std::vector<std::string>& warnings_;
  ObjText out_;
  std::size_t line_ = 0;
  bool is_after_vertex_ = false;  // the last readable statement was a vertex
  std::size_t pending_line_ = 0;  // first unreadable line since the last statement; 0 = none
  std::size_t doubt_line_ = 0;    // first unreadable line beside a vertex; 0 = none
  Dropped unreadable_;
  Dropped impossible_;
};

std::string material_name(const TriangleMesh& mesh, std::size_t index) {
  const std::string& name = mesh.materials[index].name;
  return name.empty() ? fmt::format("material_{}", index) : name;
}

}  // namespace

void append_vertex(ObjText& obj, const Vec3& p_file) {
  const Vec3 shown = p_file.allFinite() ? p_file : Vec3::Zero();
  fmt::format_to(std::back_inserter(obj.text), "v {} {} {}\nvt {} {}\n", shown.x(), shown.y(),
                 shown.z(), obj.vertices.size() % kObjNumberBase,
                 obj.vertices.size() / kObjNumberBase);
  obj.vertices.push_back(p_file);
}

void append_face(ObjText& obj, std::span<const std::size_t> corners) {
  obj.text += 'f';
  for (const std::size_t corner : corners) {
    fmt::format_to(std::back_inserter(obj.text), " {}/{}", corner + 1, corner + 1);
  }
  obj.text += '\n';
  ++obj.face_count;
}

ObjText read_obj_text(const std::filesystem::path& path, std::string_view content,
                      std::vector<std::string>& warnings) {
  return ObjReader(path, warnings).read(content);
}

std::string obj_text_of(const TriangleMesh& mesh, const std::string& mtl_name) {
  std::string out = fmt::format("mtllib {}\n", mtl_name);
  const auto at = std::back_inserter(out);
  for (const Vec3f& v : mesh.vertices_m) {
    fmt::format_to(at, "v {} {} {}\n", v.x(), v.y(), v.z());
  }
  std::size_t current = mesh.materials.size();
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const std::size_t material = mesh.face_material.empty() ? 0 : mesh.face_material[i];
    if (material != current) fmt::format_to(at, "usemtl {}\n", material_name(mesh, material));
    current = material;
    const auto& [a, b, c] = mesh.faces[i];
    fmt::format_to(at, "f {} {} {}\n", a + 1, b + 1, c + 1);
  }
  return out;
}

std::string mtl_text_of(const TriangleMesh& mesh) {
  std::string out;
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    const auto& [r, g, b] = mesh.materials[i].rgb;
    fmt::format_to(std::back_inserter(out), "newmtl {}\nKd {} {} {}\n", material_name(mesh, i), r,
                   g, b);
  }
  return out;
}

}  // namespace gnbv
