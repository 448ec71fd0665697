// Mesh files: OBJ, PLY, STL, COLLADA, glTF, SDF and URDF, by our own readers.
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
  std::string up_axis = "auto";  // auto (as the file says, or z), x, y or z
  double unit_m = 0.0;           // metres per file unit; 0: as the file says, or metres
  double lost_max = 0.01;        // share of the faces that may be lost
};

/// What a file, or the specification of its format, says about its coordinates; nothing where both
/// are silent.
struct DeclaredAxes {
  std::optional<double> unit_m;
  std::optional<char> up_axis;  // x, y or z
  bool is_law = false;          // of its format: no file of it may say otherwise
};

/// A mesh as its file holds it.
struct MeshReading {
  TriangleMesh mesh;       // in world coordinates; may hold faces without area, NaN and infinity
  std::string not_finite;  // names the first coordinate that is not; empty without one
  double unit_m = 1.0;     // metres per file unit, as used
  char up_axis = 'z';      // of the file, as used: x, y or z
  DeclaredAxes declared;
  std::vector<std::string> warnings;  // what is left out, a sentence each
  std::size_t lost_faces = 0;         // that could not be used; flat ones are in the mesh
  std::vector<std::filesystem::path> files = {};  // beside it, that it was read from
};

/// Reads .obj, .ply, .stl, .dae, .gltf and .glb, places instances and triangulates; and .sdf,
/// .world, .urdf and the folder of a Gazebo model (model_parts.hpp). The vertices of
/// OBJ and PLY files keep their numbers; those of the other formats, which repeat a vertex for each
/// face, normal or material, are joined where their positions are equal. Materials have the diffuse
/// colours of the file, in PLY files those of its faces or vertices. Throws BadInput naming the
/// file and its fault, or what is wrong with the config. `keeps_uvs`: coordinates of surfaces
/// without a picture are kept, too, for one that is to be put on them.
MeshReading read_mesh(const MeshFileConfig& config, bool keeps_uvs = false);

/// Whether more of its faces than that share could not be used.
bool has_lost_more(const MeshReading& reading, double lost_max);

/// Moves a mesh so far from the origin that single precision loses a millimetre, a map grid's say,
/// near it by whole metres of x and y; nothing where that is not what is wrong.
std::optional<Vec3> offset_to_origin_m(const TriangleMesh& mesh);

/// read_mesh() without faces that are flat (is_flat()). Appends to `warnings` what is left out.
/// Throws BadInput, too, when no face is left, more are lost than lost_max, a coordinate is NaN or
/// infinite, or offset_to_origin_m() knows better.
TriangleMesh load_mesh(const MeshFileConfig& config, std::vector<std::string>* warnings = nullptr);

/// Writes .obj (with its .mtl beside it), .ply (binary, faces coloured) or .glb (turned to y up) by
/// extension, by rename. Throws BadInput for any other.
void write_mesh(const TriangleMesh& mesh, const std::filesystem::path& path);

/// Turns the axis `up` (x, y or z) to z; the right-handed turns of COLLADA 1.4's up_axis table.
Eigen::Matrix3d R_z_up(char up);

/// Turns about z, counter-clockwise seen from above.
Eigen::Matrix3d R_yaw(double yaw_rad);

}  // namespace gnbv
