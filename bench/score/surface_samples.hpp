// Points spread evenly over triangles, the same on every machine.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

struct SurfaceSample {
  Vec3f p_world_m = Vec3f::Zero();
  std::uint32_t face = 0;
};

/// The samples of all faces, by face. About area / spacing^2 of them, 16 bytes each.
///
/// A face is cut into strips along its longest edge and each strip into cells, neither wider than
/// `spacing_m`; a sample sits in the middle of each cell's part of the face. So every face has a
/// sample, no point of it is farther than 1.2 spacings from one, and slivers cost no more than
/// their length.
std::vector<SurfaceSample> sample_surface(const TriangleMesh& mesh, double spacing_m);

/// About `count` samples, at least one a face; of a sliver, however long, at most twice as many.
/// None of a mesh without extent.
std::vector<SurfaceSample> sample_about(const TriangleMesh& mesh, double count);

}  // namespace gnbv
