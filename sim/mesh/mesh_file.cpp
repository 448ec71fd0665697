#include "sim/mesh/mesh_file.hpp"

#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/mesh/mesh_units.hpp"
#include "sim/mesh/obj_text.hpp"
#include "sim/mesh/ply_file.hpp"

namespace gnbv {
namespace {

using Matrix4 = Eigen::Matrix4d;

constexpr double kCentimetre_m = 0.01;

void check_config(const MeshFileConfig& config) {
  const auto fail = [](const std::string& what) { throw BadInput("mesh: " + what); };
  if (config.path.empty()) fail("path is empty");
  if (!(config.scale > 0.0) || !std::isfinite(config.scale)) {
    fail(fmt::format("scale = {} is not positive", config.scale));
  }
  if (!(config.unit_m >= 0.0) || !std::isfinite(config.unit_m)) {
    fail(fmt::format("unit_m = {} is neither positive nor 0", config.unit_m));
  }
  if (!config.offset_m.allFinite()) fail("offset_m is not finite");
  const auto& up = config.up_axis;
  if (up != "auto" && up != "x" && up != "y" && up != "z") {
    fail(fmt::format("up_axis = {} is none of auto, x, y, z", up));
  }
}

DeclaredAxes declared_by(const std::filesystem::path& path, const aiScene& scene) {
  const std::string extension = extension_of(path);
  if (extension == ".dae") return declared_by_collada(read_file(path));
  if (extension == ".gltf" || extension == ".glb" || extension == ".x3d") return {1.0, 'y'};
  DeclaredAxes declared;
  if (extension == ".fbx" && scene.mMetaData != nullptr) {
    std::int32_t axis = 1;
    double unit_cm = 1.0;
    float single_cm = 1.0F;
    if (scene.mMetaData->Get("UpAxis", axis)) {
      declared.up_axis = axis == 0 ? 'x' : axis == 1 ? 'y' : 'z';
    }
    if (scene.mMetaData->Get("UnitScaleFactor", unit_cm)) {
      declared.unit_m = unit_cm * kCentimetre_m;
    } else if (scene.mMetaData->Get("UnitScaleFactor", single_cm)) {
      declared.unit_m = static_cast<double>(single_cm) * kCentimetre_m;
    }
  }
  return declared;
}

/// Maps what the importer delivers to metres with z up, scale and offset of the config included.
/// The importer has already applied the unit of a COLLADA file to its root node, and turned it
/// to y up unless the config names the axis.
Matrix4 T_world_imported(const MeshFileConfig& config, const MeshReading& reading) {
  const bool is_collada = extension_of(config.path) == ".dae";
  const double unit_m = reading.unit_m / (is_collada ? reading.declared_unit_m.value() : 1.0);
  const char up = is_collada && config.up_axis == "auto" ? 'y' : reading.up_axis;
  Matrix4 T = Matrix4::Identity();
  T.topLeftCorner<3, 3>() = unit_m * config.scale * R_z_up(up);
  T.topRightCorner<3, 1>() = config.offset_m;
  return T;
}

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
  MeshBuilder(const MeshFileConfig& config, const aiScene& scene)
      : path_(config.path), scene_(scene) {
    mesh_.materials.clear();
  }

  /// Vertices of an OBJ file, as it numbers them; the corners then carry these numbers.
  void use_numbered_vertices(const std::vector<Vec3>& vertices, const Matrix4& T_world_file) {
    is_numbered_ = true;
    for (const Vec3& p : vertices) mesh_.vertices_m.push_back(world_point(p, T_world_file));
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
  Vec3f world_point(const Vec3& p, const Matrix4& T) const {
    return (T.topLeftCorner<3, 3>() * p + T.topRightCorner<3, 1>()).cast<float>();
  }

  std::uint32_t add_vertex(const aiMesh& part, unsigned index, const Matrix4& T_world_node) {
    if (is_numbered_) {
      const aiVector3D& number = part.mTextureCoords[0][index];
      return static_cast<std::uint32_t>(number.x) +
             kObjNumberBase * static_cast<std::uint32_t>(number.y);
    }
    const aiVector3D& v = part.mVertices[index];
    const Vec3f p = world_point(Vec3(v.x, v.y, v.z), T_world_node);
    const auto next = static_cast<std::uint32_t>(mesh_.vertices_m.size());
    const Vec3f key = p + Vec3f::Zero();  // -0 becomes 0
    const auto [entry, is_new] = index_of_.try_emplace({key.x(), key.y(), key.z()}, next);
    if (is_new) mesh_.vertices_m.push_back(p);
    return entry->second;
  }

  void add_instance(const aiMesh& part, const Matrix4& T_world_node) {
    if ((part.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) return;  // points and lines only
    GNBV_CHECK(!is_numbered_ || part.HasTextureCoords(0), "{}: vertex numbers got lost", path_);
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
  bool is_numbered_ = false;
  TriangleMesh mesh_;
  std::unordered_map<std::array<float, 3>, std::uint32_t, PositionHash> index_of_;
  std::unordered_map<unsigned, std::uint16_t> index_of_material_;
};

void check_file(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) read_file(path);  // throws, with the cause
  if (std::filesystem::file_size(path, ignored) == 0) {
    throw BadInput(fmt::format("{}: is empty", path));
  }
}

const aiScene& imported_scene(Assimp::Importer& importer, const MeshFileConfig& config,
                              const ObjText* obj) {
  const std::string extension = extension_of(config.path);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, config.up_axis != "auto");
  // without meshes some importers would make up one from the bones
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  const aiScene* const scene = obj != nullptr
                                   ? importer.ReadFileFromMemory(obj->text.data(), obj->text.size(),
                                                                 aiProcess_Triangulate, "obj")
                                   : importer.ReadFile(config.path, aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw BadInput(
        fmt::format("{}: cannot be read as {}, it may be damaged or of another format ({})",
                    config.path, extension, importer.GetErrorString()));
  }
  return *scene;
}

}  // namespace

MeshReading read_mesh(const MeshFileConfig& config) {
  check_config(config);
  check_file(config.path);
  const std::string extension = extension_of(config.path);
  Assimp::Importer importer;
  if (extension.empty() || !importer.IsExtensionSupported(extension)) {
    throw BadInput(fmt::format("{}: '{}' is no known mesh format", config.path, extension));
  }
  MeshReading reading;
  PlyFile numbered;  // what numbers its own vertices: an OBJ file has no colours
  const bool is_numbered = extension == ".obj" || extension == ".ply";
  if (extension == ".obj") {
    numbered.shape = read_obj_text(config.path, read_file(config.path), reading.warnings);
  } else if (extension == ".ply") {
    numbered = read_ply(config.path, read_file(config.path), reading.warnings);
  }
  if (is_numbered && numbered.shape.face_count == 0) {
    throw BadInput(fmt::format("{}: holds no faces", config.path));
  }
  const aiScene& scene = imported_scene(importer, config, is_numbered ? &numbered.shape : nullptr);
  const DeclaredAxes declared = declared_by(config.path, scene);
  reading.declared_unit_m = declared.unit_m;
  reading.declared_up_axis = declared.up_axis;
  reading.unit_m = config.unit_m > 0.0 ? config.unit_m : declared.unit_m.value_or(1.0);
  reading.up_axis = config.up_axis != "auto" ? config.up_axis[0] : declared.up_axis.value_or('z');

  const Matrix4 T_world = T_world_imported(config, reading);
  MeshBuilder builder(config, scene);
  if (is_numbered) builder.use_numbered_vertices(numbered.shape.vertices, T_world);
  builder.add_node(*scene.mRootNode, T_world);
  reading.mesh = builder.take();
  paint(numbered, reading.mesh);
  reading.not_finite = numbered.shape.not_finite;
  const auto& vertices = reading.mesh.vertices_m;
  const auto bad =
      std::find_if(vertices.begin(), vertices.end(), [](const Vec3f& p) { return !p.allFinite(); });
  if (bad != vertices.end() && reading.not_finite.empty()) {
    reading.not_finite = fmt::format("{}: vertex {} comes to lie at ({}, {}, {}) m", config.path,
                                     bad - vertices.begin(), bad->x(), bad->y(), bad->z());
  }
  return reading;
}

}  // namespace gnbv
