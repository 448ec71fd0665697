// Meshes as PLY files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {

/// Reads vertices (x, y, z), faces (vertex_indices or vertex_index) and their red, green and blue,
/// those of the faces before those of the vertices; all else is skipped. Faces with fewer than
/// three corners or of vertices that do not exist are left out and counted in `warnings`. Throws
/// BadInput as PlyReader does.
PolygonMesh read_ply(const std::filesystem::path& path, std::vector<std::string>& warnings);

/// The mesh as PLY, little-endian; each face has the sRGB bytes of its material, as MeshLab shows
/// them. Own writer: assimp's binary PLY with colours is corrupt (found with 5.2.4).
std::string ply_bytes_of(const TriangleMesh& mesh);

}  // namespace gnbv
