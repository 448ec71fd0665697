// load_mesh() of sim/mesh/mesh_file.hpp: what of a file is fit to be flown around.
#include "sim/core/error.hpp"
#include "sim/mesh/mesh_file.hpp"
#include "sim/mesh/mesh_lint.hpp"

namespace gnbv {

TriangleMesh load_mesh(const MeshFileConfig& config, std::vector<std::string>* warnings) {
  MeshReading reading = read_mesh(config);
  if (!reading.not_finite.empty()) throw BadInput(reading.not_finite);
  TriangleMesh& mesh = reading.mesh;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    if (is_flat(mesh, i)) continue;
    mesh.faces[kept] = mesh.faces[i];
    mesh.face_material[kept++] = mesh.face_material[i];
  }
  const std::size_t flat = mesh.faces.size() - kept;
  if (kept == 0) throw BadInput(fmt::format("{}: holds no faces with an area", config.path));
  mesh.faces.resize(kept);
  mesh.face_material.resize(kept);
  if (flat > 0) {
    reading.warnings.push_back(
        fmt::format("{}: {} faces without area left out", config.path, flat));
  }
  if (warnings != nullptr) {
    warnings->insert(warnings->end(), reading.warnings.begin(), reading.warnings.end());
  }
  return std::move(mesh);
}

}  // namespace gnbv
