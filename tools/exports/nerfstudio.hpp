// A run as a nerfstudio data set: https://docs.nerf.studio/quickstart/data_conventions.html
#pragma once

#include <filesystem>

#include "tools/exports/sparse_model.hpp"

namespace gnbv {

/// Writes transforms.json, images/NUMBER_CAMERA.png, depth/NUMBER_CAMERA.png, points.ply and
/// README.txt into the folder. Poses are those the vehicle believed, from camera to world, the
/// camera's x right, y up, z back; the world is the run's own, ENU in metres, so that
/// applied_transform is the identity. Intrinsics stand with each frame, since cameras may differ.
/// Throws BadInput for cameras whose depth images differ in scale: the format knows one.
void write_nerfstudio(const FrameRecord& frames, const SparseModel& model,
                      const std::filesystem::path& folder);

}  // namespace gnbv
