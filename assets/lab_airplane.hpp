// The airplane model of the paper's Scenario 4, generated.
#pragma once

#include "sim/mesh/triangle_mesh.hpp"

namespace gnbv {

/// A turboprop trainer on its wheels, 4 x 3 x 1 m (x, y, z): nose towards +x, mirror-symmetric
/// about y = 0 bit for bit, standing on z = 0 with the middle of its box on the z axis. Control
/// surfaces with gaps, propeller, exhausts, scoop, struts, tanks. Every part is closed and faces
/// outwards. The paper shows its own model in photographs only; this one has its size.
TriangleMesh make_lab_airplane();

}  // namespace gnbv
