// Faces that rays meet alike on every processor: Embree walks generous boxes around them, and
// whether and where a ray meets one is computed here, in double and without fused multiply-adds.
#pragma once

#include <array>
#include <span>

#include "sensors/embree.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

/// Corners of a face, world.
using FaceCorners = std::array<Vec3f, 3>;

/// Makes a geometry of type RTC_GEOMETRY_TYPE_USER out of the faces, which stay with the caller. Of
/// two that a ray meets at the same distance the first one, by geometry and face, is hit: so it
/// does not matter in which order boxes are walked. No ray passes between two faces that share an
/// edge.
void set_exact_faces(RTCGeometry geometry, std::span<const FaceCorners> faces);

}  // namespace gnbv
