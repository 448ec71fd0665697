// A small structure for missions of a few seconds.
#pragma once

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// A round tower with a pointed roof and a low annex with a sloping one, asymmetric, standing on
/// the ground at the origin: about 2.0 x 1.5 x 1.6 m.
TriangleMesh make_smoke_structure();

}  // namespace gnbv
