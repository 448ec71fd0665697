#include "tools/surface/mesh_edges.hpp"

#include <algorithm>

namespace gnbv {
namespace {

struct Edge {
  std::uint64_t ends;  // the lower vertex first
  std::uint32_t face;
  std::uint32_t corner;
};

std::vector<Edge> sorted_edges(const TriangleMesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.faces.size());
  for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.faces[face][k];
      const std::uint32_t b = mesh.faces[face][(k + 1) % 3];
      edges.push_back({(std::uint64_t{std::min(a, b)} << 32) | std::max(a, b), face, k});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.face < b.face;
  });
  return edges;
}

/// Calls visit(first, count) for each run of equal edges.
template <typename Visit>
void for_each_edge(const std::vector<Edge>& edges, const Visit& visit) {
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin + 1;
    while (end < edges.size() && edges[end].ends == edges[begin].ends) ++end;
    visit(begin, end - begin);
    begin = end;
  }
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> neighbours_across_edges(const TriangleMesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> neighbours(mesh.faces.size(),
                                                       {kNoNeighbour, kNoNeighbour, kNoNeighbour});
  const std::vector<Edge> edges = sorted_edges(mesh);
  for_each_edge(edges, [&](std::size_t first, std::size_t count) {
    if (count != 2) return;
    const Edge& a = edges[first];
    const Edge& b = edges[first + 1];
    neighbours[a.face][a.corner] = b.face;
    neighbours[b.face][b.corner] = a.face;
  });
  return neighbours;
}

std::size_t open_edges(const TriangleMesh& mesh) {
  std::size_t open = 0;
  for_each_edge(sorted_edges(mesh),
                [&](std::size_t, std::size_t count) { open += count == 2 ? 0 : 1; });
  return open;
}

}  // namespace gnbv
