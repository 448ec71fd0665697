// read_stl() of sim/mesh/mesh_scene.hpp.
#include <sstream>

#include "sim/core/file.hpp"
#include "sim/mesh/mesh_scene.hpp"
#include "sim/mesh/plain_text.hpp"
#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kStlHeader = 84;    // bytes, the number of triangles among them
constexpr std::size_t kStlTriangle = 50;  // bytes

/// The facets of a text. Its words may stand on any lines, but a vertex stands on one.
class StlText {
 public:
  StlText(const std::filesystem::path& path, MeshScene& scene)
      : path_(path), scene_(scene), part_(scene.parts.emplace_back()) {}

  void read(std::istream& text) {
    LineReader lines(text);
    for (std::string_view line; lines.next(line);) {
      line_ = lines.number();
      take(line);
    }
    if (is_in_facet_ && !facet_.empty()) fail("the file ends within a facet");
    scene_.lose(path_, lost_, "facets of fewer than three vertices");
    if (unknown_ > 0) {
      scene_.warnings.push_back(
          fmt::format("{}: {} words that no STL file has passed over, the first in line {}",
                      path_.string(), unknown_, first_unknown_));
    }
    if (is_in_solid_) {
      scene_.warnings.push_back(
          fmt::format("{}: ends without 'endsolid': it may be cut off", path_.string()));
    }
  }

 private:
  void take(std::string_view line) {
    split(line, words_);
    for (std::size_t i = 0; i < words_.size(); ++i) {
      const std::string word = in_lower_case(words_[i]);
      if (word == "vertex") {
        add_vertex(i + 1);
        i += 3;
      } else if (word == "facet") {
        begin_facet();
        if (is_word(i + 1, "normal")) i = last_before(i + 2, {"outer", "vertex", "endfacet"});
      } else if (word == "endfacet") {
        end_facet();
      } else if (word == "solid" || word == "endsolid") {
        is_in_solid_ = word == "solid";
        i = last_before(i + 1, {"facet", "endsolid"});  // a name
      } else if (word != "outer" && word != "loop" && word != "endloop" && unknown_++ == 0) {
        first_unknown_ = line_;
      }
    }
  }

  bool is_word(std::size_t i, std::string_view word) const {
    return i < words_.size() && in_lower_case(words_[i]) == word;
  }
  std::size_t last_before(std::size_t i, std::initializer_list<std::string_view> stops) const {
    const auto is_stop = [&](auto stop) { return is_word(i, stop); };
    while (i < words_.size() && std::none_of(stops.begin(), stops.end(), is_stop)) ++i;
    return i - 1;
  }

  void begin_facet() {
    if (is_in_facet_ && !facet_.empty()) fail("a facet begins within another one");
    is_in_facet_ = true;
  }

  void add_vertex(std::size_t first_word) {
    if (!is_in_facet_) fail("a vertex outside of a facet");
    Vec3 p;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = first_word + k;
      const auto value = i < words_.size() ? read_decimal(words_[i]) : std::nullopt;
      if (!value) fail("a vertex without three coordinates");
      p[static_cast<Eigen::Index>(k)] = *value;
    }
    facet_.push_back(as_index(part_.vertices.size(), path_.string(), "vertices"));
    part_.vertices.push_back(p);
  }

  void end_facet() {
    is_in_facet_ = false;
    if (facet_.size() >= 3) {
      for (const auto& [a, b, c] : triangles_of(facet_, part_.vertices)) {
        part_.faces.push_back({facet_[a], facet_[b], facet_[c]});
      }
    } else {
      ++lost_;
    }
    facet_.clear();
  }

  [[noreturn]] void fail(std::string_view what) const {
    throw BadInput("{}:{}: {}", path_.string(), line_, what);
  }

  const std::filesystem::path& path_;
  MeshScene& scene_;
  MeshScene::Part& part_;
  std::vector<std::string_view> words_;  // of this line
  std::size_t line_ = 0;
  bool is_in_solid_ = false, is_in_facet_ = false;
  std::vector<std::uint32_t> facet_;
  std::size_t lost_ = 0, unknown_ = 0, first_unknown_ = 0;
};

void read_stl_bytes(const std::filesystem::path& path, std::string_view bytes, MeshScene& scene) {
  const std::size_t announced = number_at<std::uint32_t>(bytes.data() + kStlHeader - 4);
  const std::size_t held = (bytes.size() - kStlHeader) / kStlTriangle;
  if (held < announced) {
    throw BadInput("{}: ends after {} of the {} triangles that its header announces", path.string(),
                   held, announced);
  }
  MeshScene::Part& part = scene.parts.emplace_back();
  std::size_t coloured = 0;
  for (std::size_t i = 0; i < announced; ++i) {
    const char* const end = bytes.data() + kStlHeader + (i + 1) * kStlTriangle;
    coloured += number_at<std::uint16_t>(end - 2) != 0 ? 1 : 0;
    const std::uint32_t first = as_index(part.vertices.size(), path.string(), "vertices");
    part.faces.push_back({first, first + 1, first + 2});
    for (std::size_t k = 0; k < 3; ++k) {  // the normal comes first
      const char* const at = bytes.data() + kStlHeader + i * kStlTriangle + 12 * (k + 1);
      part.vertices.emplace_back(number_at<float>(at), number_at<float>(at + 4),
                                 number_at<float>(at + 8));
    }
  }
  if (coloured > 0) {
    scene.warnings.push_back(fmt::format(
        "{}: {} triangles have attributes, in which some programs keep colours: not read",
        path.string(), coloured));
  }
  const std::size_t over = bytes.size() - kStlHeader - announced * kStlTriangle;
  if (over == 0) return;
  scene.lost_faces += held - announced;
  scene.warnings.push_back(
      fmt::format("{}: {} bytes after the {} triangles that its header announces left out",
                  path.string(), over, announced));
}

}  // namespace

MeshScene read_stl(const std::filesystem::path& path) {
  std::string bytes = read_file(path);
  MeshScene scene;
  scene.materials = {Material{.name = std::string(kDefaultMaterial), .rgb = kDefaultColour}};
  const std::size_t size = bytes.size();
  const bool is_exact =
      size >= kStlHeader &&
      size - kStlHeader ==
          kStlTriangle * std::size_t{number_at<std::uint32_t>(bytes.data() + kStlHeader - 4)};
  // the header of bytes may begin like a text
  std::string_view head = std::string_view(bytes).substr(0, 1024);
  const bool is_wide = is_utf16(head);
  const bool has_zero = !is_wide && head.find('\0') != head.npos;
  const std::string begin = as_utf8(std::string(head));
  const bool may_be_text = !has_zero || begin.find("facet normal") != begin.npos;  // in its name
  const bool is_text =
      !is_exact && may_be_text && in_lower_case(trimmed(begin)).starts_with("solid");
  if (is_text) {
    std::istringstream text(std::move(bytes));
    StlText(path, scene).read(text);
  } else if (is_exact || (size >= kStlHeader && has_zero)) {
    read_stl_bytes(path, bytes, scene);
  } else {
    throw BadInput(
        "{}: is no STL file: it begins without 'solid', and is no table of triangles either",
        path.string());
  }
  scene.instances.push_back({});
  return scene;
}

}  // namespace gnbv
