// The materials of a Wavefront OBJ file and its libraries.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {

/// Faces ahead of the first `usemtl` have the last material of a library named before them, or
/// otherwise that of the first `usemtl`.
class ObjMaterials {
 public:
  explicit ObjMaterials(std::string path) : path_(std::move(path)) {}

  /// Takes the names and diffuse colours of a library, which may come after their use.
  void read_library(const std::filesystem::path& library);
  void use(const std::string& name);

  /// Of the current material among those that faces use, in order of first use. Throws BadInput
  /// naming the file when they become more than 65536.
  std::uint16_t index_for_face();

  /// Those that faces use, once all is read.
  std::vector<Material> materials() const;

 private:
  std::string path_;
  std::map<std::string, std::array<float, 3>> rgb_of_;  // of the libraries' materials
  std::vector<std::string> used_;                       // names by index
  std::map<std::string, std::uint16_t> index_of_;       // of them
  std::string current_ = std::string(kUntoldMaterial);
  std::optional<std::uint16_t> index_;  // of the current one, once a face has used it
  bool is_named_ = false;               // by a usemtl
};

/// The mesh's materials as a library; those without a name get one by their number.
std::string mtl_text_of(const TriangleMesh& mesh);
std::string obj_name_of_material(const TriangleMesh& mesh, std::size_t index);

}  // namespace gnbv
