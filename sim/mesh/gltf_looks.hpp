// What is seen of a glTF file: base colours, their pictures, and colours of vertices.
#pragma once

#include <set>

#include "sim/mesh/gltf_file.hpp"
#include "sim/mesh/texture_file.hpp"

namespace gnbv {

/// Nothing in here refuses a file: what is wrong with looks is a warning.
class GltfLooks {
 public:
  using Json = GltfFile::Json;

  GltfLooks(GltfFile& file, bool keeps_uvs)
      : file_(file), keeps_uvs_(keeps_uvs), textures_(file.path()) {}

  /// Those of the file, and a last one for faces without a material.
  std::vector<Material> materials();
  /// Of a primitive; the last one where it names none that is there. After materials().
  std::size_t material_of(const Json& primitive);

  /// Of the vertices of a primitive of that material; empty where it has neither picture nor
  /// colours. After materials().
  std::vector<CornerLook> of_vertices(const Json& attributes, std::size_t material,
                                      std::size_t vertices);

  void warn(std::vector<std::string>& warnings) const;
  const std::vector<std::filesystem::path>& files() const { return textures_.files(); }

 private:
  /// Where a material takes its picture's coordinates from: p_uv = T * (u, v, 1).
  struct Placing {
    bool is_used = false;  // there is a picture
    std::size_t set = 0;
    Eigen::Matrix<double, 2, 3> T = Eigen::Matrix<double, 2, 3>::Identity();
  };

  /// Does it; what is wrong becomes a warning.
  template <typename Do>
  void attempt(const Do& step);
  void read_texture(const Json& info, Material& to, Placing& placing);
  Texture picture(std::size_t image, const std::array<Wrap, 2>& wrap);
  void add_uvs(std::size_t accessor, const Placing& placing, std::vector<CornerLook>& to);
  void add_colours(std::size_t accessor, std::vector<CornerLook>& to);

  GltfFile& file_;
  const bool keeps_uvs_;
  TextureFiles textures_;
  std::vector<Placing> placings_;  // by material
  std::set<std::string> faults_;
};

}  // namespace gnbv
