// Mesh files of any format assimp reads. Only mesh_file.cpp and mesh_write.cpp know assimp.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/triangle_mesh.hpp"

namespace gnbv {

/// How a file's coordinates become world coordinates:
/// p_world = R(up_axis -> z) * p_file * unit_m * scale + offset_m.
struct MeshFileConfig {
  std::string path;  // empty: no file
  double scale = 1.0;
  Vec3 offset_m = Vec3::Zero();
  std::string up_axis = "auto";  // auto (as the file says, z when it is silent), x, y or z
  double unit_m = 0.0;           // metres per file unit; 0 = as the file says, metres when silent
};

/// Reads, instances nodes, triangulates and drops faces without area. The vertices of OBJ and PLY
/// files stay as the file numbers them; those of formats that repeat a vertex per face, normal or
/// material are joined where their positions are equal, nowhere else. What had to be left out is
/// appended to `warnings`, a sentence each. Throws BadInput naming the file (and what is wrong with
/// it) when it is missing, unreadable, without faces, or holds NaN or infinite coordinates, and
/// when the config itself is not usable.
TriangleMesh load_mesh(const MeshFileConfig& config, std::vector<std::string>* warnings = nullptr);

/// Writes .obj (with its .mtl beside it), .ply (binary, faces coloured) or .glb (turned to y up) by
/// extension, by rename. Throws BadInput for any other.
void write_mesh(const TriangleMesh& mesh, const std::filesystem::path& path);

}  // namespace gnbv
