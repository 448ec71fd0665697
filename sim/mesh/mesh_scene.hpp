// A mesh as STL, COLLADA and glTF files hold it: parts that instances place.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/mesh/mesh_file.hpp"

namespace gnbv {

struct MeshScene {
  struct Part {
    std::vector<Vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> faces;
    std::map<std::size_t, FaceLooks> looks = {};  // as faces, by set of texture coordinates
  };
  struct Instance {
    std::size_t part = 0;
    std::size_t material = 0;
    Eigen::Matrix4d T_file_part = Eigen::Matrix4d::Identity();
    std::optional<std::size_t> uv_set = 0;  // of the part's looks, where it has them; or none
  };
  std::vector<Part> parts;
  std::vector<Instance> instances;
  std::vector<Material> materials;
  DeclaredAxes declared;
  std::size_t lost_faces = 0;                     // that could not be used
  std::vector<std::string> warnings;              // what is left out, a sentence each
  std::vector<std::filesystem::path> files = {};  // beside it, that it was read from

  /// Counts what is left out, as "4 faces that ...", with its warning. Nothing for none.
  void lose(const std::filesystem::path& path, std::size_t count, const std::string& what);
};

/// Normals are passed over, whatever they are. What is wrong with pictures, texture coordinates and
/// colours is a warning.
/// Each throws BadInput naming the file, and the place in it where there is one. `keeps_uvs`: as
/// read_mesh()'s.

/// Text or bytes. A facet of more than three vertices is a polygon.
MeshScene read_stl(const std::filesystem::path& path);
/// COLLADA 1.4 and 1.5: what the scene shows, skins in their bind pose.
MeshScene read_collada(const std::filesystem::path& path, bool keeps_uvs = false);
/// glTF 2, text or bytes: what the scene shows at rest, with default morph weights, skins,
/// instances (EXT_mesh_gpu_instancing) and quantized positions. Refuses a required extension of
/// shapes that it does not know.
MeshScene read_gltf(const std::filesystem::path& path, bool keeps_uvs = false);

/// All instances in world coordinates, vertices joined where their positions are equal; mirrored
/// ones keep their outsides out. Materials are those that faces use, in order of first use. Throws
/// BadInput naming the file for more than 2^27 faces or 2^16 materials.
TriangleMesh assembled(const MeshScene& scene, const Eigen::Matrix4d& T_world_file,
                       const std::string& path);

}  // namespace gnbv
