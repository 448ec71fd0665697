#include <unordered_map>

#include "tools/page/packs.hpp"

namespace gnbv {
namespace {

/// A corner of a face that is being cut.
struct Corner {
  std::uint32_t vertex;
  CornerLook look;
};

CornerLook half_way(const CornerLook& a, const CornerLook& b) {
  CornerLook out{.uv = 0.5F * (a.uv + b.uv)};
  for (std::size_t k = 0; k < 3; ++k) {
    out.tint[k] = static_cast<std::uint8_t>((a.tint[k] + b.tint[k] + 1) / 2);
  }
  return out;
}

/// Cuts every edge longer than that in two, and the faces beside it: neighbours cut their edge at
/// the same vertex.
TriangleMesh with_cut_edges(const TriangleMesh& mesh, float longest_m) {
  TriangleMesh out;
  out.vertices_m = mesh.vertices_m;
  out.materials = mesh.materials;
  std::unordered_map<std::uint64_t, std::uint32_t> middle_of;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint64_t edge = std::uint64_t{std::min(a, b)} << 32U | std::max(a, b);
    const auto next = static_cast<std::uint32_t>(out.vertices_m.size());
    const auto [entry, is_new] = middle_of.try_emplace(edge, next);
    if (is_new) out.vertices_m.emplace_back(0.5F * (mesh.vertices_m[a] + mesh.vertices_m[b]));
    return entry->second;
  };
  std::vector<Corner> ring;  // a middle first, where there is one
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    ring.clear();
    std::size_t first = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      const std::uint32_t a = mesh.faces[f][k], b = mesh.faces[f][next];
      ring.push_back({a, mesh.face_looks[f][k]});
      if ((mesh.vertices_m[a] - mesh.vertices_m[b]).norm() <= longest_m) continue;
      first = ring.size();
      ring.push_back({middle(a, b), half_way(mesh.face_looks[f][k], mesh.face_looks[f][next])});
    }
    std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(first), ring.end());
    for (std::size_t i = 2; i < ring.size(); ++i) {
      out.faces.push_back({ring[0].vertex, ring[i - 1].vertex, ring[i].vertex});
      out.face_looks.push_back({ring[0].look, ring[i - 1].look, ring[i].look});
      out.face_material.push_back(static_cast<std::uint16_t>(material_of(mesh, f)));
    }
  }
  return out;
}

}  // namespace

TriangleMesh cut_finer(TriangleMesh mesh, std::size_t faces, std::size_t max_faces) {
  if (mesh.face_looks.empty()) return mesh;
  const double equal_m2 = surface_area_m2(mesh) / static_cast<double>(faces);
  const auto longest_m = static_cast<float>(1.5 * std::sqrt(4.0 / std::sqrt(3.0) * equal_m2));
  while (mesh.faces.size() < max_faces) {
    TriangleMesh finer = with_cut_edges(mesh, longest_m);
    if (finer.faces.size() == mesh.faces.size()) break;
    mesh = std::move(finer);
  }
  return mesh;
}

VertexColours::VertexColours(const TriangleMesh& mesh) {
  if (mesh.face_looks.empty()) return;
  std::vector<Eigen::Array4f> sums;  // of colours, and their number
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [r, g, b] = mean_colour(mesh, f);
    for (const std::uint32_t vertex : mesh.faces[f]) {
      const auto next = static_cast<std::uint32_t>(sums.size());
      const auto [index, is_new] = places_.index_of(mesh.vertices_m[vertex], next);
      if (is_new) sums.emplace_back(Eigen::Array4f::Zero());
      sums[index] += Eigen::Array4f(r, g, b, 1.0F);
    }
  }
  for (const Eigen::Array4f& sum : sums) {
    const Eigen::Array3f linear = (65535.0F * sum.head<3>() / sum[3]).round();
    for (const float channel : linear) colours_.push_back(static_cast<std::uint16_t>(channel));
  }
}

std::vector<std::uint16_t> VertexColours::of(std::span<const Vec3f> vertices_m) {
  std::vector<std::uint16_t> out;
  for (const Vec3f& p_m : vertices_m) {
    const auto index = places_.index_of(p_m, 0).first;  // a vertex of no face takes any
    const auto from = colours_.begin() + std::ptrdiff_t{3} * index;
    out.insert(out.end(), from, from + 3);
  }
  return out;
}

}  // namespace gnbv
