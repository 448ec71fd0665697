// A coal-fired power plant at quarter scale, the paper's Scenario 2, generated.
#pragma once

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// About 24.8 x 16.2 x 12.0 m, standing on z = 0 and centred on the origin; nothing about it is
/// symmetric. Every body is closed and faces outwards; neighbours penetrate each other or stand
/// apart. Always the same mesh, bit for bit.
TriangleMesh make_power_plant();

}  // namespace gnbv
