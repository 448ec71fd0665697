// The shape of a COLLADA <geometry>, and the numbers in its elements.
#pragma once

#include <string>
#include <unordered_map>

#include "sim/mesh/mesh_scene.hpp"
#include "sim/mesh/xml_tree.hpp"

namespace gnbv {

/// A COLLADA document whose elements are found by id. All of it throws BadInput naming file and
/// line.
class ColladaFile {
 public:
  ColladaFile(const std::filesystem::path& path, std::vector<std::string>& warnings);

  XmlElement root() const { return tree_.root(); }
  const std::filesystem::path& path() const { return path_; }
  /// The element of that id, which may have a # before it, if it is in this file.
  XmlElement by_id(std::string url) const;
  /// What an attribute (url, source, target) refers to, if it is in this file.
  XmlElement named_by(const XmlElement& from, const char* attribute) const;
  /// Whether there is an <image>: in a library, or in an effect.
  bool has_images() const { return has_images_; }
  /// The numbers in an element's text.
  std::vector<double> numbers(const XmlElement& element) const;
  /// The same in single precision, with decimal commas where there are any: positions, texture
  /// coordinates and matrices.
  std::vector<double> singles(const XmlElement& element) const;
  [[noreturn]] void fail(const XmlElement& at, const std::string& what) const;

 private:
  template <typename Read>
  std::vector<double> words(const XmlElement& element, const Read& read) const;

  std::filesystem::path path_;
  XmlTree tree_;
  std::unordered_map<std::string, XmlElement> by_id_;
  bool has_images_ = false;
};

/// read_decimal() of a word that may have the decimal comma of its writer's country.
std::optional<double> read_with_comma(std::string_view word);

struct ColladaShape {
  struct Group {
    std::string material;  // the symbol that instances bind
    MeshScene::Part part;
  };
  std::vector<Group> groups;
  std::size_t impossible_faces = 0;      // of vertices that do not exist, or fewer than three
  std::size_t unread = 0;                // surfaces that are no polygons
  std::vector<std::string> faults = {};  // of texture coordinates and colours that are left out
};

/// Triangles, strips, fans and polygons, with their holes; lines are passed over. Each set of
/// texture coordinates becomes looks of its part.
ColladaShape collada_shape(const ColladaFile& file, const XmlElement& geometry, bool wants_uvs);

}  // namespace gnbv
