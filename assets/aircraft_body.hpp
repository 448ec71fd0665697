// The fuselage's surface, for what sits on it.
#pragma once

#include "assets/aircraft_parts.hpp"

namespace gnbv::aircraft {

/// Point of the fuselage's skin at y; the angle runs from -90 degrees (lowest) over 0 (x > 0 side)
/// to 90 (highest).
Vec3 body_point_m(double y_m, double angle_rad);

/// Outward unit normal there.
Vec3 body_normal(double y_m, double angle_rad);

}  // namespace gnbv::aircraft
