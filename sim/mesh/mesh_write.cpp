// The writers of sim/mesh/mesh_file.hpp; OBJ and PLY texts are those of obj_file and ply_file.
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <assimp/Exporter.hpp>
#include <cerrno>
#include <unordered_map>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "sim/mesh/obj_file.hpp"
#include "sim/mesh/obj_materials.hpp"
#include "sim/mesh/ply_file.hpp"

namespace gnbv {
namespace {

/// One aiMesh with the faces of one material, its vertices renumbered in order of first use.
aiMesh* export_part(const TriangleMesh& mesh, std::size_t material) {
  std::unordered_map<std::uint32_t, unsigned> index_of;
  std::vector<std::uint32_t> used;
  std::vector<std::array<unsigned, 3>> faces;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    if ((mesh.face_material.empty() ? 0 : mesh.face_material[i]) != material) continue;
    auto& face = faces.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [entry, is_new] =
          index_of.try_emplace(mesh.faces[i][k], static_cast<unsigned>(used.size()));
      if (is_new) used.push_back(mesh.faces[i][k]);
      face[k] = entry->second;
    }
  }
  if (faces.empty()) return nullptr;
  auto* out = new aiMesh;  // assimp's scene deletes what hangs on it
  out->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  out->mMaterialIndex = static_cast<unsigned>(material);
  out->mName = mesh.materials[material].name;
  out->mNumVertices = static_cast<unsigned>(used.size());
  out->mVertices = new aiVector3D[used.size()];
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Vec3f& p = mesh.vertices_m[used[i]];
    out->mVertices[i] = aiVector3D(p.x(), p.z(), -p.y());  // glTF is y up
  }
  out->mNumFaces = static_cast<unsigned>(faces.size());
  out->mFaces = new aiFace[faces.size()];
  for (std::size_t i = 0; i < faces.size(); ++i) {
    out->mFaces[i].mNumIndices = 3;
    out->mFaces[i].mIndices = new unsigned[3]{faces[i][0], faces[i][1], faces[i][2]};
  }
  return out;
}

void write_glb(const TriangleMesh& mesh, const std::filesystem::path& path) {
  aiScene scene;
  scene.mNumMaterials = static_cast<unsigned>(mesh.materials.size());
  scene.mMaterials = new aiMaterial*[mesh.materials.size()];
  std::vector<aiMesh*> parts;
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    const Material& material = mesh.materials[i];
    auto* out = scene.mMaterials[i] = new aiMaterial;
    const aiString name(material.name);
    out->AddProperty(&name, AI_MATKEY_NAME);
    const aiColor4D rgba(material.rgb[0], material.rgb[1], material.rgb[2], 1.0F);
    out->AddProperty(&rgba, 1, AI_MATKEY_BASE_COLOR);
    out->AddProperty(&rgba, 1, AI_MATKEY_COLOR_DIFFUSE);
    if (aiMesh* part = export_part(mesh, i)) parts.push_back(part);
  }
  scene.mRootNode = new aiNode("structure");
  scene.mNumMeshes = scene.mRootNode->mNumMeshes = static_cast<unsigned>(parts.size());
  scene.mMeshes = new aiMesh*[parts.size()];
  scene.mRootNode->mMeshes = new unsigned[parts.size()];
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    scene.mMeshes[i] = parts[i];
    scene.mRootNode->mMeshes[i] = i;
  }
  write_file_atomically(path, [&](const std::filesystem::path& part) {
    Assimp::Exporter exporter;
    errno = 0;
    if (exporter.Export(&scene, "glb2", part.string()) != aiReturn_SUCCESS) {
      if (errno != 0) refuse_to_write(path, errno);
      throw BadInput(fmt::format("{}: cannot write: {}", path.string(), exporter.GetErrorString()));
    }
  });
}

}  // namespace

void write_mesh(const TriangleMesh& mesh, const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension == ".obj") {
    const std::filesystem::path mtl = std::filesystem::path(path).replace_extension(".mtl");
    write_file_atomically(mtl, mtl_text_of(mesh));
    write_file_atomically(path, obj_text_of(mesh, mtl.filename().string()));
  } else if (extension == ".ply") {
    write_file_atomically(path, ply_bytes_of(mesh));
  } else if (extension == ".glb") {
    write_glb(mesh, path);
  } else {
    throw BadInput(fmt::format("{}: meshes are written as .obj, .ply or .glb, not '{}'",
                               path.string(), extension));
  }
}

}  // namespace gnbv
