// Laws of closed meshes, for the tests of the built-in structures.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "assets/random/mesh_builder.hpp"

namespace gnbv {

using Faces = std::vector<std::array<std::uint32_t, 3>>;

/// Edges that are not in exactly two faces, once in each direction.
inline std::size_t open_edges(const Faces& faces) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& f : faces)
    for (std::size_t i = 0; i < 3; ++i) ++uses[{f[i], f[(i + 1) % 3]}];
  std::size_t bad = 0;
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    bad += count != 1 || back == uses.end() || back->second != 1;
  }
  return bad;
}

/// Faces split by connection over shared vertices.
inline std::vector<Faces> connected_parts(const Faces& faces, std::size_t vertices) {
  std::vector<std::uint32_t> parent(vertices);
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& f : faces)
    for (const std::size_t i : {1, 2}) parent[root(f[i])] = root(f[0]);
  std::map<std::uint32_t, Faces> by_root;
  for (const auto& f : faces) by_root[root(f[0])].push_back(f);
  std::vector<Faces> parts;
  for (auto& entry : by_root) parts.push_back(std::move(entry.second));
  return parts;
}

inline double area_m2(const Part& part) {
  double sum_m2 = 0.0;
  for (const auto& f : part.faces)
    sum_m2 += 0.5 * (part.points_m[f[1]] - part.points_m[f[0]])
                        .cross(part.points_m[f[2]] - part.points_m[f[0]])
                        .norm();
  return sum_m2;
}

}  // namespace gnbv
