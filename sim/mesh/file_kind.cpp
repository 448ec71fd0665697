#include "sim/mesh/file_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "sim/core/file.hpp"
#include "sim/mesh/plain_text.hpp"

namespace gnbv {
namespace {

struct Kind {
  std::string_view begins;     // in lower case
  std::string_view what;       // it is
  std::string_view extension;  // for which that is right; empty: for none of a mesh
};

constexpr std::array kKinds = {
    Kind{"version https://git-lfs", "a Git LFS pointer, not a mesh: git lfs pull", ""},
    Kind{"version https://hawser", "a Git LFS pointer, not a mesh: git lfs pull", ""},
    Kind{"<!doctype html", "an HTML page, not a mesh: download the file itself", ""},
    Kind{"<html", "an HTML page, not a mesh: download the file itself", ""},
    Kind{"<head", "an HTML page, not a mesh: download the file itself", ""},
    Kind{"pk\x03\x04", "a ZIP archive, not a mesh: unpack it", ""},
    Kind{"\x1f\x8b", "a gzip archive, not a mesh: unpack it", ""},
    Kind{"\xfd"
         "7zxz",
         "an xz archive, not a mesh: unpack it", ""},
    Kind{"7z\xbc\xaf", "a 7-Zip archive, not a mesh: unpack it", ""},
    Kind{"rar!", "a RAR archive, not a mesh: unpack it", ""},
    Kind{"\x89png", "a PNG picture, not a mesh", ""},
    Kind{"\xff\xd8\xff", "a JPEG picture, not a mesh", ""},
    Kind{"%pdf", "a PDF document, not a mesh", ""},
    Kind{"kaydara fbx", "an FBX file by its content: export it as .dae or .glb", ""},
    Kind{"blender-v", "a Blender file by its content: export it as .glb or .obj", ""},
    Kind{"blender_v", "a Blender file by its content: export it as .glb or .obj", ""},
    Kind{"draco", "a Draco file, which is compressed: export it without", ""},
    Kind{"lasf", "a LAS point cloud, not a mesh", ""},
    Kind{"# .pcd", "a PCD point cloud, not a mesh", ""},
    Kind{"<sdf", "an SDF model by its content: name it .sdf", ".sdf"},
    Kind{"<robot", "a URDF model by its content: name it .urdf", ".urdf"},
    Kind{"off\n", "an OFF file by its content: convert it to .ply or .obj", ""},
    Kind{"gltf", "a GLB file by its content: name it .glb", ".glb"},
    Kind{"ply\n", "a PLY file by its content: name it .ply", ".ply"},
    Kind{"<collada", "a COLLADA file by its content: name it .dae", ".dae"},
    Kind{"solid ", "an STL file by its content: name it .stl", ".stl"},
    Kind{"solid\n", "an STL file by its content: name it .stl", ".stl"},
    Kind{"{", "JSON by its content: name it .gltf where it is glTF", ".glb"},
};

/// Without what may stand before the root of an XML file.
std::string_view without_prologue(std::string_view text) {
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    const bool is_comment = text.starts_with("<!--");
    if (!is_comment && !text.starts_with("<?")) return text;
    const std::string_view close = is_comment ? "-->" : "?>";
    const std::size_t end = text.find(close);
    if (end == text.npos) return {};
    text.remove_prefix(end + close.size());
  }
}

}  // namespace

std::string what_it_is_instead(const std::filesystem::path& path, const std::string& extension) {
  constexpr std::array<std::string_view, 8> kClouds = {".xyz", ".pcd", ".pts", ".las",
                                                       ".laz", ".txt", ".asc", ".csv"};
  if (std::find(kClouds.begin(), kClouds.end(), extension) != kClouds.end()) {
    return "is a point cloud, not a mesh: `gnbv score CLOUD --mesh MESH` scores it, and `gnbv "
           "surface CLOUD` makes a mesh of it";
  }
  if (extension == ".3mf") return "is a 3MF file, which is not read: export it as .glb or .obj";
  if (extension.starts_with(".usd")) {
    return "is a USD file, which is not read: export it as .glb or .obj";
  }
  std::string head(4096, '\0');
  std::ifstream file = open_file(path);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  if (is_utf16(head)) head = as_utf8(std::move(head));
  std::string begin = in_lower_case(without_prologue(as_utf8(std::move(head))));
  std::replace(begin.begin(), begin.end(), '\r', '\n');
  for (const Kind& kind : kKinds) {
    if (!begin.starts_with(kind.begins)) continue;
    const bool is_right = kind.extension == extension ||
                          (kind.extension == ".glb" && extension == ".gltf") ||
                          (kind.extension == ".sdf" && extension == ".world");
    return is_right ? "" : fmt::format("is {}", kind.what);
  }
  return "";
}

std::string no_faces_text(std::size_t points) {
  if (points == 0) return "holds no faces";
  return fmt::format(
      "holds no faces, only {} points: as a cloud `gnbv score CLOUD --mesh MESH` scores it, and "
      "`gnbv surface CLOUD` makes a mesh of it",
      points);
}

}  // namespace gnbv
