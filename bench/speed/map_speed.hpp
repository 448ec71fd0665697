// Depth frames into the map: how much faster than octomap::OcTree::insertPointCloud, and whether
// the maps are the same.
#pragma once

#include <vector>

#include "bench/speed/speed_row.hpp"
#include "sensors/camera_model.hpp"
#include "sensors/frames.hpp"

namespace gnbv {

/// 640 x 480, 60 x 45 deg, 8 m, looking 20 deg down.
const CameraModel& circle_camera();
/// 16 frames on a circle around the scene of analytic_scans.hpp, looking inwards.
const std::vector<DepthFrame>& circle_frames();

/// Medians over the frames of the thread's CPU time, ms, of the best, the AVX2 and the baseline
/// level. Ours is everything from the depths to the updated grid; the reference is plain
/// insertPointCloud with the cloud ready, and the competent way OctoMap's own faster one: one ray a
/// voxel that was hit (discretize, hence another map: frame_insertion_test.cpp says which) and
/// inner nodes left alone (lazy_eval). Identical: every voxel's log-odds, bit for bit, after all
/// frames, against OctoMap's rule ray by ray, and against insertPointCloud itself on the same
/// frames with each pixel without a return made a hit at maximum range. Takes some 10 s.
std::vector<SpeedRow> map_speed();

}  // namespace gnbv
