// Wavefront OBJ files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/mesh/polygon_mesh.hpp"

namespace gnbv {

/// Reads the shape and the diffuse colours of its materials (sim/mesh/obj_materials.hpp); normals
/// and texture coordinates are left out. Unreadable lines and faces of vertices that do not exist
/// are left out too and counted in `warnings`, as long as the numbering of the vertices is beyond
/// doubt. Throws BadInput naming the line where it is not (unreadable beside a vertex, and more
/// vertices to come).
PolygonMesh read_obj(const std::filesystem::path& path, std::vector<std::string>& warnings);

/// The mesh as OBJ, its materials taken from the file `mtl_name` beside it.
std::string obj_text_of(const TriangleMesh& mesh, const std::string& mtl_name);

}  // namespace gnbv
