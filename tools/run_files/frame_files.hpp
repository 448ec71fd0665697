// The frames/ folder of a run: what the cameras saw at each view, for other tools.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sensors/camera_model.hpp"
#include "sensors/frames.hpp"

namespace gnbv {

/// Writes ITERATION_CAMERA.rgb.png (sRGB) and ITERATION_CAMERA.depth.png (16 bits, millimetres
/// along the optical axis, 0 where there is none) of each view, cameras.json (pinhole intrinsics in
/// pixels, pixel centres at half pixels) and poses.csv, which grows with the views (T_world_camera
/// as believed: metres, unit quaternion; optical frame, world ENU). Every file appears by rename.
class FrameFiles {
 public:
  /// Makes the folder and writes cameras.json. Throws BadInput naming it when that fails.
  FrameFiles(std::filesystem::path folder, std::vector<CameraModel> cameras);

  void write(std::size_t iteration, double time_s, std::span<const DepthFrame> depth,
             std::span<const ColourFrame> colour);

 private:
  std::filesystem::path folder_;
  std::vector<CameraModel> cameras_;
  std::string poses_;
};

}  // namespace gnbv
