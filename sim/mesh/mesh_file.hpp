// Mesh files: OBJ and PLY by our own readers, STL, COLLADA and glTF by assimp, which only
// mesh_import.cpp and mesh_write.cpp know.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// How a file's coordinates become world coordinates:
/// p_world = R(yaw about z) * R(up_axis -> z) * p_file * unit_m * scale + offset_m.
struct MeshFileConfig {
  std::string path;  // empty: no file
  double scale = 1.0;
  double yaw_rad = 0.0;  // about the file's origin, counter-clockwise seen from above
  Vec3 offset_m = Vec3::Zero();
  std::string up_axis = "auto";  // auto (as the file says, z when it is silent), x, y or z
  double unit_m = 0.0;           // metres per file unit; 0 = as the file says, metres when silent
};

/// A mesh as its file holds it, for whoever wants to judge the file.
struct MeshReading {
  TriangleMesh mesh;  // in world coordinates; may hold anything, faces without area and NaN too
  std::string not_finite;  // a sentence naming the first coordinate that is not; empty without one
  double unit_m = 1.0;     // metres per file unit, as used
  char up_axis = 'z';      // of the file, as used: x, y or z
  // what the file itself says, or its format's specification; nothing when both are silent
  std::optional<double> declared_unit_m;
  std::optional<char> declared_up_axis;
  std::vector<std::string> warnings;  // what had to be left out, a sentence each
};

/// Reads .obj, .ply, .stl, .dae, .gltf and .glb, instances nodes and triangulates. The vertices of
/// OBJ and PLY files stay as the file numbers them; those of formats that repeat a vertex per face,
/// normal or material are joined where their positions are equal, nowhere else. Materials carry the
/// diffuse colours of the file; those of a PLY file are the colours of its faces or vertices
/// (sim/mesh/ply_file.hpp). Throws BadInput naming the file (and what is wrong with it) when it is
/// missing or unreadable, and when the config itself is not usable.
MeshReading read_mesh(const MeshFileConfig& config);

/// read_mesh() without the faces that have no area (is_flat() of sim/mesh/mesh_lint.hpp). What had
/// to be left out is appended to `warnings`, a sentence each. Throws BadInput, too, when no face is
/// left and when a coordinate is NaN or infinite.
TriangleMesh load_mesh(const MeshFileConfig& config, std::vector<std::string>* warnings = nullptr);

/// Writes .obj (with its .mtl beside it), .ply (binary, faces coloured) or .glb (turned to y up) by
/// extension, by rename. Throws BadInput for any other.
void write_mesh(const TriangleMesh& mesh, const std::filesystem::path& path);

}  // namespace gnbv
