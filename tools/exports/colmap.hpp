// A run as a COLMAP model with known poses: https://colmap.github.io/format.html
#pragma once

#include <filesystem>

#include "tools/exports/sparse_model.hpp"

namespace gnbv {

/// Writes sparse/0/{cameras,images,points3D}.txt, images/CAMERA/NUMBER.png and README.txt into the
/// folder. Poses are those the vehicle believed, from world to camera (x right, y down, z forward)
/// in metres of the run's world; pixels are COLMAP's as they are ours, the centre of the first one
/// at (0.5, 0.5). Observations are projections, not detected features, so that reprojection errors
/// are 0.
void write_colmap(const FrameRecord& frames, const SparseModel& model,
                  const std::filesystem::path& folder);

}  // namespace gnbv
