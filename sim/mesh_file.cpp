#include "sim/mesh_file.hpp"

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
#include <regex>
#include <unordered_map>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/obj_text.hpp"

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

/// Turns `up` to z; the right-handed turns of COLLADA 1.4's up_axis table.
Eigen::Matrix3d R_z_up(char up) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  if (up == 'y') {
    R << 1, 0, 0,  //
        0, 0, -1,  //
        0, 1, 0;
  } else if (up == 'x') {
    R << 0, -1, 0,  //
        0, 0, -1,   //
        1, 0, 0;
  }
  return R;
}

/// Metres per unit that a COLLADA file declares; 1 when it is silent.
double collada_unit_m(const std::string& content) {
  static const std::regex kUnit(R"re(<unit\s[^>]*meter\s*=\s*["']\s*([^"']+)["'])re");
  std::smatch match;
  if (!std::regex_search(content, match, kUnit)) return 1.0;
  const double unit_m = std::strtod(match[1].str().c_str(), nullptr);
  return unit_m > 0.0 ? unit_m : 1.0;
}

/// Maps what the importer delivers to metres with z up, scale and offset of the config included.
Matrix4 T_world_imported(const MeshFileConfig& config, const std::string& extension,
                         const aiScene& scene) {
  const bool is_collada = extension == ".dae";
  char up = 'z';
  double unit_m = 1.0;
  if (is_collada || extension == ".gltf" || extension == ".glb" || extension == ".x3d") {
    up = 'y';  // by specification, or (COLLADA) because the importer turns it there
  } else if (extension == ".fbx" && scene.mMetaData != nullptr) {
    std::int32_t axis = 1;
    double unit_cm = 1.0;
    if (scene.mMetaData->Get("UpAxis", axis)) up = axis == 0 ? 'x' : axis == 1 ? 'y' : 'z';
    float single_cm = 1.0F;
    if (scene.mMetaData->Get("UnitScaleFactor", unit_cm)) {
      unit_m = unit_cm * kCentimetre_m;
    } else if (scene.mMetaData->Get("UnitScaleFactor", single_cm)) {
      unit_m = static_cast<double>(single_cm) * kCentimetre_m;
    }
  }
  if (config.up_axis != "auto") up = config.up_axis[0];
  if (config.unit_m > 0.0) {
    // the importer has already applied the unit of a COLLADA file to its root node
    unit_m = is_collada ? config.unit_m / collada_unit_m(read_file(config.path)) : config.unit_m;
  }
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
  MeshBuilder(const MeshFileConfig& config, const aiScene& scene, bool joins_equal_positions)
      : path_(config.path), scene_(scene), joins_(joins_equal_positions) {
    mesh_.materials.clear();
  }

  /// Vertices of an OBJ file, as it numbers them; the corners then carry these numbers.
  void use_numbered_vertices(const std::vector<Vec3>& vertices, const Matrix4& T_world_file) {
    is_numbered_ = true;
    for (const Vec3& p : vertices) {
      mesh_.vertices_m.push_back(world_point(p, T_world_file));
      if (!mesh_.vertices_m.back().allFinite()) {
        throw BadInput(fmt::format("{}: vertex {} lies beyond the range of float", path_,
                                   mesh_.vertices_m.size()));
      }
    }
  }

  void add_node(const aiNode& node, const Matrix4& T_world_parent) {
    const Matrix4 T_world_node = T_world_parent * matrix_of(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      add_instance(*scene_.mMeshes[node.mMeshes[i]], T_world_node);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(*node.mChildren[i], T_world_node);
  }

  TriangleMesh finish(std::vector<std::string>& warnings) {
    if (mesh_.faces.empty()) throw BadInput(fmt::format("{}: holds no faces with an area", path_));
    if (flat_ > 0) {
      warnings.push_back(fmt::format("{}: {} faces without area left out", path_, flat_));
    }
    return std::move(mesh_);
  }

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
    if (!p.allFinite()) {
      throw BadInput(fmt::format("{}: vertex {} of mesh '{}' is at ({}, {}, {})", path_, index,
                                 part.mName.C_Str(), v.x, v.y, v.z));
    }
    const auto next = static_cast<std::uint32_t>(mesh_.vertices_m.size());
    if (joins_) {
      const Vec3f key = p + Vec3f::Zero();  // -0 becomes 0
      const auto [entry, is_new] = index_of_.try_emplace({key.x(), key.y(), key.z()}, next);
      if (!is_new) return entry->second;
    }
    mesh_.vertices_m.push_back(p);
    return next;
  }

  /// Whether the corners lie on a line, to the rounding of float coordinates.
  bool is_flat(const std::array<std::uint32_t, 3>& face) const {
    const Vec3 a = mesh_.vertices_m[face[0]].cast<double>();
    const Vec3 b = mesh_.vertices_m[face[1]].cast<double>();
    const Vec3 c = mesh_.vertices_m[face[2]].cast<double>();
    const double longest2 =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    return (b - a).cross(c - a).norm() <= 1e-7 * longest2;
  }

  void add_instance(const aiMesh& part, const Matrix4& T_world_node) {
    if ((part.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) return;  // points and lines only
    GNBV_CHECK(!is_numbered_ || part.HasTextureCoords(0), "{}: vertex numbers got lost", path_);
    std::vector<std::uint32_t> world_index(part.mNumVertices);
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      world_index[i] = add_vertex(part, i, T_world_node);
    }
    const bool is_mirrored = T_world_node.topLeftCorner<3, 3>().determinant() < 0.0;
    std::optional<std::uint16_t> material;
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& polygon = part.mFaces[i];
      if (polygon.mNumIndices != 3) continue;
      std::array<std::uint32_t, 3> face = {world_index[polygon.mIndices[0]],
                                           world_index[polygon.mIndices[1]],
                                           world_index[polygon.mIndices[2]]};
      if (is_mirrored) std::swap(face[1], face[2]);
      if (is_flat(face)) {
        ++flat_;
        continue;
      }
      if (!material) material = add_material(part.mMaterialIndex);
      mesh_.faces.push_back(face);
      mesh_.face_material.push_back(*material);
    }
  }

  /// Index of an importer's material among those that faces use, in order of first use.
  std::uint16_t add_material(unsigned importer_index) {
    const auto [entry, is_new] = material_of_.try_emplace(
        importer_index, static_cast<std::uint16_t>(mesh_.materials.size()));
    if (is_new) {
      if (mesh_.materials.size() > std::numeric_limits<std::uint16_t>::max()) {
        throw BadInput(fmt::format("{}: more than 65536 materials", path_));
      }
      const aiMaterial& from = *scene_.mMaterials[importer_index];
      Material to;
      aiString name;
      if (from.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS && name.length > 0) {
        to.name = name.C_Str();
      }
      aiColor4D rgba;
      if (from.Get(AI_MATKEY_COLOR_DIFFUSE, rgba) == aiReturn_SUCCESS) {
        to.rgb = {rgba.r, rgba.g, rgba.b};
        for (float& channel : to.rgb) channel = std::clamp(channel, 0.0F, 1.0F);
      }
      mesh_.materials.push_back(to);
    }
    return entry->second;
  }

  std::string path_;
  const aiScene& scene_;
  bool joins_ = false;
  bool is_numbered_ = false;
  TriangleMesh mesh_;
  std::size_t flat_ = 0;
  std::unordered_map<std::array<float, 3>, std::uint32_t, PositionHash> index_of_;
  std::unordered_map<unsigned, std::uint16_t> material_of_;
};

}  // namespace

TriangleMesh load_mesh(const MeshFileConfig& config, std::vector<std::string>* warnings) {
  check_config(config);
  const std::filesystem::path path = config.path;
  const std::string extension = extension_of(path);
  std::vector<std::string> found;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
    read_file(path);  // throws, naming the cause
  if (std::filesystem::file_size(path, ignored) == 0) {
    throw BadInput(fmt::format("{}: is empty", config.path));
  }
  Assimp::Importer importer;
  if (extension.empty() || !importer.IsExtensionSupported(extension)) {
    throw BadInput(fmt::format("{}: '{}' is no known mesh format", config.path, extension));
  }
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, config.up_axis != "auto");
  // without meshes some importers would make up one from the bones
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);

  ObjText obj;
  const aiScene* scene = nullptr;
  if (extension == ".obj") {
    obj = read_obj_text(path, read_file(path), found);
    scene =
        importer.ReadFileFromMemory(obj.text.data(), obj.text.size(), aiProcess_Triangulate, "obj");
  } else {
    scene = importer.ReadFile(config.path, aiProcess_Triangulate);
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw BadInput(fmt::format("{}: cannot be read: {}", config.path, importer.GetErrorString()));
  }
  const Matrix4 T_world = T_world_imported(config, extension, *scene);
  MeshBuilder builder(config, *scene, extension != ".ply");
  if (extension == ".obj") builder.use_numbered_vertices(obj.vertices, T_world);
  builder.add_node(*scene->mRootNode, T_world);
  TriangleMesh mesh = builder.finish(found);
  if (warnings != nullptr) warnings->insert(warnings->end(), found.begin(), found.end());
  return mesh;
}

}  // namespace gnbv
