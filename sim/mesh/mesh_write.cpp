// write_mesh() of sim/mesh/mesh_file.hpp.
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>

#include <assimp/Exporter.hpp>
#include <cerrno>
#include <iterator>
#include <unordered_map>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/image.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "sim/mesh/ply_write.hpp"

namespace gnbv {
namespace {

/// A material without a name gets one by its number.
std::string obj_name_of_material(const TriangleMesh& mesh, std::size_t index) {
  const std::string& name = mesh.materials[index].name;
  return name.empty() ? fmt::format("material_{}", index) : name;
}

std::string mtl_text_of(const TriangleMesh& mesh) {
  std::string out;
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    const auto& [r, g, b] = mesh.materials[i].rgb;
    out += fmt::format("newmtl {}\nKd {} {} {}\n", obj_name_of_material(mesh, i), r, g, b);
  }
  return out;
}

std::string obj_text_of(const TriangleMesh& mesh, const std::string& mtl_name) {
  std::string out = fmt::format("mtllib {}\n", mtl_name);
  const auto at = std::back_inserter(out);
  for (const Vec3f& v : mesh.vertices_m) {
    fmt::format_to(at, "v {} {} {}\n", v.x(), v.y(), v.z());
  }
  std::size_t current = mesh.materials.size();
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const std::size_t material = material_of(mesh, i);
    if (material != current)
      out += fmt::format("usemtl {}\n", obj_name_of_material(mesh, material));
    current = material;
    const auto& [a, b, c] = mesh.faces[i];
    fmt::format_to(at, "f {} {} {}\n", a + 1, b + 1, c + 1);
  }
  return out;
}

/// Each face has the sRGB bytes of its material, as MeshLab shows them. Our own, since assimp
/// (5.2.4) writes binary PLY with colours wrong.
std::string ply_bytes_of(const TriangleMesh& mesh) {
  std::vector<Rgb8> colours;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const auto& [r, g, b] = mesh.materials[material_of(mesh, i)].rgb;
    colours.push_back({srgb_byte(r), srgb_byte(g), srgb_byte(b)});
  }
  return ply_bytes({.places_world_m = mesh.vertices_m},
                   PlyFaces{.corners = mesh.faces, .colours = colours});
}

/// The faces of one material, their vertices numbered in order of first use; null without faces.
aiMesh* export_part(const TriangleMesh& mesh, std::size_t material) {
  std::unordered_map<std::uint32_t, unsigned> index_of;
  std::vector<std::uint32_t> used;
  std::vector<std::array<unsigned, 3>> faces;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    if (material_of(mesh, i) != material) continue;
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
