// Which faces of a mesh share an edge.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

constexpr std::uint32_t kNoNeighbour = 0xffffffffU;

/// For each face the one across its edge from corner k to corner k + 1; kNoNeighbour at a rim and
/// where more than two faces meet.
std::vector<std::array<std::uint32_t, 3>> neighbours_across_edges(const TriangleMesh& mesh);

/// Edges that are not shared by exactly two faces: 0 for a watertight mesh.
std::size_t open_edges(const TriangleMesh& mesh);

}  // namespace gnbv
