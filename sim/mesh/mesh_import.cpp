// import_mesh() of sim/mesh/mesh_file.hpp.
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "sim/mesh/polygon_mesh.hpp"

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
  std::uint32_t add_vertex(const aiVector3D& v, const Matrix4& T_world_node) {
    const Vec3f p = (T_world_node.topLeftCorner<3, 3>() * Vec3(v.x, v.y, v.z) +
                     T_world_node.topRightCorner<3, 1>())
                        .cast<float>();
    const auto next = static_cast<std::uint32_t>(mesh_.vertices_m.size());
    const auto [index, is_new] = positions_.index_of(p, next);
    if (is_new) mesh_.vertices_m.push_back(p);
    return index;
  }

  void add_instance(const aiMesh& part, const Matrix4& T_world_node) {
    if ((part.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) return;  // points and lines only
    std::vector<std::uint32_t> world_index;
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      world_index.push_back(add_vertex(part.mVertices[i], T_world_node));
    }
    const bool is_mirrored = T_world_node.topLeftCorner<3, 3>().determinant() < 0.0;
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      if (part.mFaces[i].mNumIndices != 3) continue;
      const unsigned* const at = part.mFaces[i].mIndices;
      std::array<std::uint32_t, 3> face = {world_index[at[0]], world_index[at[1]],
                                           world_index[at[2]]};
      if (is_mirrored) std::swap(face[1], face[2]);
      mesh_.faces.push_back(face);
      mesh_.face_material.push_back(material_of(part.mMaterialIndex));
    }
  }

  /// Index of an importer's material among those that faces use, in order of first use.
  std::uint16_t material_of(unsigned importer_index) {
    const std::size_t next = mesh_.materials.size();
    const auto [entry, is_new] =
        index_of_material_.try_emplace(importer_index, static_cast<std::uint16_t>(next));
    if (is_new) {
      as_index<std::uint16_t>(next, path_, "materials");
      mesh_.materials.push_back(material_from(*scene_.mMaterials[importer_index]));
    }
    return entry->second;
  }

  std::string path_;
  const aiScene& scene_;
  TriangleMesh mesh_;
  PositionIndices positions_;
  std::unordered_map<unsigned, std::uint16_t> index_of_material_;
};

}  // namespace

TriangleMesh import_mesh(const MeshFileConfig& config, const Matrix4& T_world_imported) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, config.up_axis != "auto");
  // without meshes some importers would make up one from the bones
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  const aiScene* const scene = importer.ReadFile(config.path, aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw BadInput(
        fmt::format("{}: cannot be read as {}, it may be damaged or of another format ({})",
                    config.path, extension_of(config.path), importer.GetErrorString()));
  }
  MeshBuilder builder(config.path, *scene);
  builder.add_node(*scene->mRootNode, T_world_imported);
  return builder.take();
}

}  // namespace gnbv
