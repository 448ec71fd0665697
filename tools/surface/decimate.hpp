// The same surface of fewer faces.
#pragma once

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// Edges collapsed by quadric error (Garland and Heckbert 1997) while the surface stays within
/// about `tolerance_m` of what it was: flat parts become few faces, edges stay. Vertices are some
/// of those given; none is left that no face uses. Deterministic.
TriangleMesh decimated(const TriangleMesh& mesh, double tolerance_m);

}  // namespace gnbv
