// The rays of a depth frame one by one: the slow twin of planner/map/scan_rays.hpp.
#pragma once

#include <vector>

#include "planner/map/scan_rays.hpp"
#include "sensors/camera_model.hpp"
#include "sensors/frames.hpp"

namespace gnbv {

/// Rays of a depth frame in row-major pixel order, by the rules of PixelRay: kInvalidRange, or
/// nearer than range_min_m, gives no ray; kNoReturn, or beyond range_max_m, a clearing ray to the
/// plane at range_max_m, or none with NoReturn::unknown; a return below `floor_z_m` clears but
/// marks nothing.
std::vector<ScanRay> rays_of(const DepthFrame& frame, const CameraModel& camera, double floor_z_m,
                             NoReturn no_return = NoReturn::free);

}  // namespace gnbv
