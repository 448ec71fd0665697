// A depth frame as the loops over voxels see it: where its pixels look, and what they can reach.
#pragma once

#include "planner/map/frame_kernels.hpp"
#include "planner/map/grid_geometry.hpp"
#include "sensors/camera_model.hpp"
#include "sensors/frames.hpp"

namespace gnbv {

/// Whether voxels can be projected into the frame. Not when the camera is outside the grid, its
/// rotation is none, its minimum range is not positive, its rays end beyond OctoMap's keys, the
/// voxels are narrow against the margin, or float32 cannot count the pixels.
bool can_project(const GridGeometry& grid, const DepthFrame& frame, const CameraModel& camera);

/// Everything but the pointers and strides. No ray of the frame goes deeper than `furthest_m`.
FrameView make_frame_view(const GridGeometry& grid, const DepthFrame& frame,
                          const CameraModel& camera, double furthest_m);

/// The ranges with which depths are compared: as float32.
void set_ranges(const CameraModel& camera, PixelRow& row);

}  // namespace gnbv
