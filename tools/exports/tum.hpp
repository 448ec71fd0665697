// A run in the text formats of the TUM RGB-D benchmark:
// https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats
#pragma once

#include <filesystem>

#include "tools/run/frames_folder.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// Writes trajectory.txt, the true path of the body as `evo_traj tum` opens it, README.txt, and for
/// each camera that took frames CAMERA/ with rgb/, depth/, calibration.txt, rgb.txt, depth.txt,
/// associations.txt, groundtruth.txt (true poses of the camera) and estimate.txt (the poses the
/// vehicle believed). `frames` is null for a run without frames. Throws BadInput for a run without
/// trajectory.tum and for cameras that the scenario does not know.
void write_tum(const RunRecord& record, const FrameRecord* frames,
               const std::filesystem::path& folder);

}  // namespace gnbv
