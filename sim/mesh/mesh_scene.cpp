#include "sim/mesh/mesh_scene.hpp"

#include <unordered_map>

#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {
namespace {

using Matrix4 = Eigen::Matrix4d;

constexpr std::size_t kMostFaces = std::size_t{1} << 27U;  // instances multiply what a file holds

/// Collects instances into one mesh in world coordinates.
class Assembly {
 public:
  explicit Assembly(const MeshScene& scene, const std::string& path) : scene_(scene), path_(path) {
    mesh_.materials.clear();
  }

  void add(const MeshScene::Instance& instance, const Matrix4& T_world_file) {
    const MeshScene::Part& part = scene_.parts[instance.part];
    if (part.faces.empty()) return;
    if (mesh_.faces.size() + part.faces.size() > kMostFaces) {
      throw BadInput("{}: more than {} faces with all instances", path_, kMostFaces);
    }
    const Matrix4 T_world_part = T_world_file * instance.T_file_part;
    const bool is_mirrored = T_world_part.topLeftCorner<3, 3>().determinant() < 0.0;
    const std::uint16_t material = material_of(instance.material);
    const auto looks = instance.uv_set ? part.looks.find(*instance.uv_set) : part.looks.end();
    if (looks != part.looks.end()) {
      mesh_.face_looks.resize(mesh_.faces.size());  // of those before it that have none
      for (std::array<CornerLook, 3> of_face : looks->second) {
        if (is_mirrored) std::swap(of_face[1], of_face[2]);
        mesh_.face_looks.push_back(of_face);
      }
    }
    std::vector<std::uint32_t> world_index(part.vertices.size(), kNoVertex);
    for (std::array<std::uint32_t, 3> face : part.faces) {
      for (std::uint32_t& corner : face) {
        std::uint32_t& index = world_index[corner];
        if (index == kNoVertex) index = add_vertex(part.vertices[corner], T_world_part);
        corner = index;
      }
      if (is_mirrored) std::swap(face[1], face[2]);
      mesh_.faces.push_back(face);
      mesh_.face_material.push_back(material);
    }
  }

  TriangleMesh take() {
    if (!mesh_.face_looks.empty()) mesh_.face_looks.resize(mesh_.faces.size());
    return std::move(mesh_);
  }

 private:
  std::uint32_t add_vertex(const Vec3& p_part, const Matrix4& T_world_part) {
    const Vec3f p =
        (T_world_part.topLeftCorner<3, 3>() * p_part + T_world_part.topRightCorner<3, 1>())
            .cast<float>();
    const std::uint32_t next = as_index(mesh_.vertices_m.size(), path_, "vertices");
    const auto [index, is_new] = positions_.index_of(p, next);
    if (is_new) mesh_.vertices_m.push_back(p);
    return index;
  }

  std::uint16_t material_of(std::size_t scene_index) {
    const std::size_t next = mesh_.materials.size();
    const auto [entry, is_new] =
        index_of_material_.try_emplace(scene_index, static_cast<std::uint16_t>(next));
    if (is_new) {
      as_index<std::uint16_t>(next, path_, "materials");
      mesh_.materials.push_back(scene_.materials[scene_index]);
    }
    return entry->second;
  }

  const MeshScene& scene_;
  const std::string& path_;
  TriangleMesh mesh_;
  PositionIndices positions_;
  std::unordered_map<std::size_t, std::uint16_t> index_of_material_;
};

}  // namespace

void MeshScene::lose(const std::filesystem::path& path, std::size_t count,
                     const std::string& what) {
  if (count == 0) return;
  lost_faces += count;
  warnings.push_back(fmt::format("{}: {} {} left out", path.string(), count, what));
}

TriangleMesh assembled(const MeshScene& scene, const Matrix4& T_world_file,
                       const std::string& path) {
  Assembly assembly(scene, path);
  for (const MeshScene::Instance& instance : scene.instances) assembly.add(instance, T_world_file);
  return assembly.take();
}

}  // namespace gnbv
