// Meshes of polygons from Wavefront OBJ and PLY files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {

/// Reads the shape and the diffuse colours of its materials, but no normals and no texture
/// coordinates. Leaves out unreadable lines and faces of vertices that do not exist, and counts
/// them in `warnings`. Throws BadInput naming the line where that could number vertices wrongly: an
/// unreadable line beside a vertex, with more vertices after it.
PolygonMesh read_obj(const std::filesystem::path& path, std::vector<std::string>& warnings);

/// Reads vertices (x, y, z), faces (vertex_indices or vertex_index) and their red, green and blue,
/// those of the faces before those of the vertices; all else is skipped. Faces with fewer than
/// three corners or of vertices that do not exist are left out and counted in `warnings`. Throws
/// BadInput as PlyReader does.
PolygonMesh read_ply(const std::filesystem::path& path, std::vector<std::string>& warnings);

}  // namespace gnbv
