// An A340-like airliner at half scale, the paper's Scenario 1, generated.
#pragma once

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// Mirror-symmetric about x = 0, nose towards -y, about 30 x 35 x 7.7 m, z from 0.4 to 8.1 m;
/// 17-19 thousand vertices, 31-33 thousand faces. Every part is closed and faces outwards.
/// Always the same mesh, bit for bit.
TriangleMesh make_aircraft();

}  // namespace gnbv
