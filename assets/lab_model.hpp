// The representative model of the paper's Scenario 3, generated.
#pragma once

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// Cartons, boards, a drum and an arch, stacked askew in a laboratory: 1.3 x 1.0 x 1.5 m (x, y, z)
/// about the z axis, standing on z = 0. No symmetry; niches, pits and overhangs. Every part is
/// closed and faces outwards. The paper shows its own model in photographs only; this one has its
/// size and its kind.
TriangleMesh make_lab_model();

}  // namespace gnbv
