// The mesh formats that assimp reads: STL, COLLADA, glTF.
#pragma once

#include <Eigen/Core>

#include "sim/mesh/mesh_file.hpp"

namespace gnbv {

/// Instances the nodes of the file, triangulates, and joins vertices where their positions are
/// equal. `T_world_imported` maps what the importer delivers to metres with z up: of a COLLADA file
/// metres, with y up unless the config names the axis. Throws BadInput naming the unreadable file.
TriangleMesh import_mesh(const MeshFileConfig& config, const Eigen::Matrix4d& T_world_imported);

}  // namespace gnbv
