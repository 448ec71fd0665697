#include "sim/mesh/mesh_import.hpp"

#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <bit>
#include <limits>
#include <unordered_map>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

using Matrix4 = Eigen::Matrix4d;

Matrix4 matrix_of(const aiMatrix4x4& m) {
  Matrix4 out;
  for (unsigned i = 0; i < 4; ++i) {
    for (unsigned j = 0; j < 4; ++j) out(i, j) = static_cast<double>(m[i][j]);
  }
  return out;
}

Material material_from(const aiMaterial& from) {
  Material to;
  aiString name;
  if (from.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS && name.length > 0) to.name = name.C_Str();
  aiColor4D rgba;
  if (from.Get(AI_MATKEY_COLOR_DIFFUSE, rgba) == aiReturn_SUCCESS) {
    to.rgb = {rgba.r, rgba.g, rgba.b};
    for (float& channel : to.rgb) channel = std::clamp(channel, 0.0F, 1.0F);
  }
  return to;
}

struct PositionHash {
  std::size_t operator()(const std::array<float, 3>& p) const {
    std::size_t h = 0;
    for (const float x : p) h = (h ^ std::bit_cast<std::uint32_t>(x)) * 0x9e3779b97f4a7c15ULL;
    return h ^ (h >> 29);
  }
};

/// Collects the instances of meshes into one triangle mesh in world coordinates.
class MeshBuilder {
 public:
  MeshBuilder(const std::string& path, const aiScene& scene) : path_(path), scene_(scene) {
    mesh_.materials.clear();
  }

  void add_node(const aiNode& node, const Matrix4& T_world_parent) {
    const Matrix4 T_world_node = T_world_parent * matrix_of(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      add_instance(*scene_.mMeshes[node.mMeshes[i]], T_world_node);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(*node.mChildren[i], T_world_node);
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t add_vertex(const aiMesh& part, unsigned index, const Matrix4& T_world_node) {
    const aiVector3D& v = part.mVertices[index];
    const Vec3 p_node(v.x, v.y, v.z);
    const Vec3f p =
        (T_world_node.topLeftCorner<3, 3>() * p_node + T_world_node.topRightCorner<3, 1>())
            .cast<float>();
    const auto next = static_cast<std::uint32_t>(mesh_.vertices_m.size());
    const Vec3f key = p + Vec3f::Zero();  // -0 becomes 0
    const auto [entry, is_new] = index_of_.try_emplace({key.x(), key.y(), key.z()}, next);
    if (is_new) mesh_.vertices_m.push_back(p);
    return entry->second;
  }

  void add_instance(const aiMesh& part, const Matrix4& T_world_node) {
    if ((part.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) return;  // points and lines only
    std::vector<std::uint32_t> world_index(part.mNumVertices);
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      world_index[i] = add_vertex(part, i, T_world_node);
    }
    const bool is_mirrored = T_world_node.topLeftCorner<3, 3>().determinant() < 0.0;
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& polygon = part.mFaces[i];
      if (polygon.mNumIndices != 3) continue;
      std::array<std::uint32_t, 3> face = {world_index[polygon.mIndices[0]],
                                           world_index[polygon.mIndices[1]],
                                           world_index[polygon.mIndices[2]]};
      if (is_mirrored) std::swap(face[1], face[2]);
      mesh_.faces.push_back(face);
      mesh_.face_material.push_back(material_of(part.mMaterialIndex));
    }
  }

  /// Index of an importer's material among those that faces use, in order of first use.
  std::uint16_t material_of(unsigned importer_index) {
    const auto [entry, is_new] = index_of_material_.try_emplace(
        importer_index, static_cast<std::uint16_t>(mesh_.materials.size()));
    if (is_new) {
      if (mesh_.materials.size() > std::numeric_limits<std::uint16_t>::max()) {
        throw BadInput(fmt::format("{}: more than 65536 materials", path_));
      }
      mesh_.materials.push_back(material_from(*scene_.mMaterials[importer_index]));
    }
    return entry->second;
  }

  std::string path_;
  const aiScene& scene_;
  TriangleMesh mesh_;
  std::unordered_map<std::array<float, 3>, std::uint32_t, PositionHash> index_of_;
  std::unordered_map<unsigned, std::uint16_t> index_of_material_;
};

const aiScene& imported_scene(Assimp::Importer& importer, const MeshFileConfig& config) {
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, config.up_axis != "auto");
  // without meshes some importers would make up one from the bones
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  const aiScene* const scene = importer.ReadFile(config.path, aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw BadInput(
        fmt::format("{}: cannot be read as {}, it may be damaged or of another format ({})",
                    config.path, extension_of(config.path), importer.GetErrorString()));
  }
  return *scene;
}

}  // namespace

TriangleMesh import_mesh(const MeshFileConfig& config, const Matrix4& T_world_imported) {
  Assimp::Importer importer;
  const aiScene& scene = imported_scene(importer, config);
  MeshBuilder builder(config.path, scene);
  builder.add_node(*scene.mRootNode, T_world_imported);
  return builder.take();
}

}  // namespace gnbv
