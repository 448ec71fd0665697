// Cameras as calibration programs write them.
#pragma once

#include <string>

#include "sensors/camera_model.hpp"

namespace gnbv {

/// The camera with image size, focal lengths, centre, skew and distortion of a file of
/// OpenCV (FileStorage, YAML or XML), of Kalibr (camchain.yaml; FILE#cam1 takes the camera of that
/// name, FILE its first) or of ROS (camera_info). Their centres count from the middle of the first
/// pixel, ours from its corner. Throws BadInput naming file, line and key of what is missing, no
/// number, out of the range of its key, or of a model that is neither Brown-Conrady nor
/// Kannala-Brandt.
CameraConfig calibrated(const std::string& file, CameraConfig camera);

}  // namespace gnbv
