#include <algorithm>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "bench/score/voxel_set.hpp"
#include "sim/core/error.hpp"
#include "tools/page/packs.hpp"

namespace gnbv {
namespace {

constexpr double kCoarser = 1.25;  // from lattice to lattice: a third fewer points of a surface

TriangleMesh clustered(const TriangleMesh& mesh, double cell_m) {
  TriangleMesh out;
  out.materials = mesh.materials;
  std::unordered_map<std::uint64_t, std::uint32_t> vertex_of_cell;
  std::vector<std::uint32_t> new_index;
  new_index.reserve(mesh.vertices_m.size());
  for (const Vec3f& v : mesh.vertices_m) {
    const auto next = static_cast<std::uint32_t>(out.vertices_m.size());
    const auto [cell, is_new] = vertex_of_cell.emplace(voxel_code(v, cell_m), next);
    if (is_new) out.vertices_m.push_back(v);
    new_index.push_back(cell->second);
  }
  std::set<std::array<std::uint32_t, 3>> seen;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    std::array<std::uint32_t, 3> face{};
    for (std::size_t k = 0; k < 3; ++k) face[k] = new_index[mesh.faces[i][k]];
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    std::array<std::uint32_t, 3> sorted = face;
    std::sort(sorted.begin(), sorted.end());
    if (!seen.insert(sorted).second) continue;
    out.faces.push_back(face);
    if (!mesh.face_material.empty()) out.face_material.push_back(mesh.face_material[i]);
  }
  return out;
}

}  // namespace

std::vector<std::size_t> first_points(std::span<const Vec3f> points_m, double cell_m) {
  std::unordered_set<std::uint64_t> taken;
  taken.reserve(points_m.size() / 4);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    if (taken.insert(voxel_code(points_m[i], cell_m)).second) kept.push_back(i);
  }
  return kept;
}

ThinnedPoints thinned(std::span<const Vec3f> points_m, std::size_t max_points, double finest_m) {
  GNBV_CHECK(max_points > 0 && finest_m > 0.0, "{} points, {} m", max_points, finest_m);
  ThinnedPoints out;
  if (points_m.size() <= max_points) {
    for (std::size_t i = 0; i < points_m.size(); ++i) out.kept.push_back(i);
    return out;
  }
  out.cell_m = finest_m;
  out.kept = first_points(points_m, out.cell_m);
  while (out.kept.size() > max_points) {
    out.cell_m *= kCoarser;
    out.kept = first_points(points_m, out.cell_m);
  }
  return out;
}

TriangleMesh with_fewer_faces(const TriangleMesh& mesh, std::size_t max_faces) {
  if (mesh.faces.size() <= max_faces) return mesh;
  double cell_m = bounds_m(mesh).diagonal().norm() / 4096.0;
  TriangleMesh out = clustered(mesh, cell_m);
  while (out.faces.size() > max_faces) {
    cell_m *= kCoarser;
    out = clustered(mesh, cell_m);
  }
  return out;
}

}  // namespace gnbv
