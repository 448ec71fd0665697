// Wavefront OBJ as text: what of a file is fit to be handed to the mesh importer, and back.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// The importer copies a vertex once for every face corner. So that the file's own vertices can be
/// told again, each one's number goes through it as the texture coordinate
/// (number % kObjNumberBase, number / kObjNumberBase), exact in float up to 2^36 vertices.
constexpr std::uint32_t kObjNumberBase = 4096;

struct ObjText {
  std::string text;            // v, vt, f, usemtl and mtllib lines, all well formed
  std::vector<Vec3> vertices;  // (n, 3) of the file, in its own coordinates and order
  std::size_t face_count = 0;
  std::string not_finite;  // names the first coordinate that is NaN or infinite; empty without one
};

/// Appends a vertex; one that is not finite stays in `vertices`, the text has 0 in its place.
void append_vertex(ObjText& obj, const Vec3& p_file);
/// Appends a face of vertices counted from 0.
void append_face(ObjText& obj, std::span<const std::size_t> corners);

/// Reads the shape and the material names; normals and texture coordinates of the file are left
/// out. Unreadable lines and faces of vertices that do not exist are left out too and counted in
/// `warnings`, as long as the numbering of the vertices is beyond doubt. Throws BadInput naming the
/// line where it is not (unreadable beside a vertex, and more vertices to come). Coordinates that
/// are not finite stay in `vertices`; the text has 0 in their place.
ObjText read_obj_text(const std::filesystem::path& path, std::string_view content,
                      std::vector<std::string>& warnings);

/// The mesh as OBJ, its materials taken from the file `mtl_name` beside it.
std::string obj_text_of(const TriangleMesh& mesh, const std::string& mtl_name);
std::string mtl_text_of(const TriangleMesh& mesh);

}  // namespace gnbv
