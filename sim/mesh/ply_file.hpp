// PLY files, text or bytes of either endianness. Own reader: the importer's (assimp 5.2.4) crashes
// on sound binary files and does not know the colours of faces.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sim/mesh/obj_text.hpp"

namespace gnbv {

struct PlyFile {
  ObjText shape;  // polygons still whole
  // 0xrrggbb in sRGB; empty where the file has none
  std::vector<std::uint32_t> vertex_rgb;
  std::vector<std::uint32_t> face_rgb;  // of each face; empty, too, when some are no triangles
};

/// Reads vertices (x, y, z), faces (vertex_indices or vertex_index) and their red, green and blue;
/// all else is skipped. Faces with fewer than three corners or of vertices that do not exist are
/// left out and counted in `warnings`. Throws BadInput naming what is wrong with the file when it
/// is no PLY, ends too early or holds what is no number.
PlyFile read_ply(const std::filesystem::path& path, std::string_view content,
                 std::vector<std::string>& warnings);

/// Gives the triangles of the file, its faces cut up in their order, their colours as materials: a
/// face's own, or the mean of its vertices'. Beyond 256 colours in 16 steps a channel. A file
/// without colours changes nothing.
void paint(const PlyFile& ply, TriangleMesh& mesh);

}  // namespace gnbv
