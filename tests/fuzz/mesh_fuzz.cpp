// Whatever stands in a mesh file: it is read or refused as BadInput, and what was read keeps its
// promises. The first byte chooses the format.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/mesh/file_kind.hpp"
#include "sim/mesh/mesh_scene.hpp"
#include "sim/mesh/model_parts.hpp"
#include "sim/mesh/polygon_mesh.hpp"
#include "sim/mesh/texture_file.hpp"
#include "tests/fuzz/written.hpp"

namespace gnbv {
namespace {

/// A colour for every face, whatever its corners say.
void check_looks(const TriangleMesh& mesh) {
  GNBV_CHECK(mesh.face_looks.empty() || mesh.face_looks.size() == mesh.faces.size(), "{} looks",
             mesh.face_looks.size());
  for (std::size_t i = 0; i < std::min<std::size_t>(mesh.faces.size(), 100); ++i) {
    mean_colour(mesh, i);
    for (const float c : albedo(mesh, i, mesh.vertices_m[mesh.faces[i][0]], Vec3f::UnitZ())) {
      GNBV_CHECK(c >= 0.0F && c <= 1.001F, "colour {}", c);
    }
  }
}

void check_mesh(const PolygonMesh& mesh) {
  std::uint32_t begin = 0;
  for (const std::uint32_t end : mesh.face_ends) {
    GNBV_CHECK(end >= begin + 3 && end <= mesh.corners.size(), "a face of {} corners", end - begin);
    begin = end;
  }
  for (const std::uint32_t corner : mesh.corners) {
    GNBV_CHECK(corner < mesh.vertices.size(), "vertex {} of {}", corner, mesh.vertices.size());
  }
  GNBV_CHECK(mesh.face_material.empty() || mesh.face_material.size() == mesh.face_ends.size(),
             "{} materials", mesh.face_material.size());
  GNBV_CHECK(mesh.corner_looks.empty() || mesh.corner_looks.size() == mesh.corners.size(),
             "{} looks of {} corners", mesh.corner_looks.size(), mesh.corners.size());
  if (!mesh.not_finite.empty()) return;
  for (const Vec3& vertex : mesh.vertices) GNBV_CHECK(vertex.allFinite(), "not finite, not named");
  if (mesh.corners.size() > 3000) return;  // ears take the square of them
  const TriangleMesh triangles = triangulated(mesh);
  GNBV_CHECK(triangles.faces.size() == mesh.corners.size() - 2 * mesh.face_ends.size(),
             "{} triangles", triangles.faces.size());
  check_looks(triangles);
}

void check_scene(const MeshScene& scene) {
  for (const MeshScene::Instance& instance : scene.instances) {
    GNBV_CHECK(instance.part < scene.parts.size(), "part {}", instance.part);
    GNBV_CHECK(instance.material < scene.materials.size(), "material {}", instance.material);
  }
  for (const MeshScene::Part& part : scene.parts) {
    for (const auto& face : part.faces) {
      for (const std::uint32_t v : face) GNBV_CHECK(v < part.vertices.size(), "vertex {}", v);
    }
  }
  if (scene.instances.size() < 1000) {
    check_looks(assembled(scene, Eigen::Matrix4d::Identity(), "mesh"));
  }
}

void check_model(const std::filesystem::path& path) {
  const TriangleMesh mesh = read_model(path, Eigen::Matrix4d::Identity()).mesh;
  for (const auto& face : mesh.faces) {
    for (const std::uint32_t v : face) GNBV_CHECK(v < mesh.vertices_m.size(), "vertex {}", v);
  }
}

void check_file(char format, std::string_view content) {
  std::vector<std::string> warnings;
  const auto path = gnbv::written(content, "mesh");
  what_it_is_instead(path, ".obj");
  switch (format) {
    case 'd':
      return check_model(gnbv::written(content, "model.sdf"));
    case 'u':
      return check_model(gnbv::written(content, "model.urdf"));
    case 'c':
      return check_scene(read_collada(path));
    case 'g':
      return check_scene(read_gltf(path));
    case 'i':
      read_picture(content, 1U << 20U);
      return;
    case 's':
      return check_scene(read_stl(path));
    case 'p':
      return check_mesh(read_ply(path, warnings));
    default:
      return check_mesh(read_obj(path, warnings));
  }
}

}  // namespace
}  // namespace gnbv

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view content(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    gnbv::check_file(static_cast<char>(data[0]), content);
  } catch (const gnbv::BadInput&) {
    // said, and that is all
  }
  return 0;
}
