// The sensors of the paper by name.
#pragma once

#include <array>
#include <string_view>

#include "sensors/camera_model.hpp"
#include "sensors/lidar_model.hpp"

namespace gnbv {

/// rgbd_sim: the simulated RGBD camera of section 3.1.1; the defaults of CameraConfig.
/// zed_mini: the stereo camera of section 3.2.1.
constexpr std::array<std::string_view, 2> kCameraPresets = {"rgbd_sim", "zed_mini"};

/// profiling_sim: the simulated laser of section 3.1.1; the defaults of LidarConfig.
/// hokuyo_utm_30lx, hokuyo_ust_10lx: the paper flew "a hokuyo LIDAR", which may be either.
constexpr std::array<std::string_view, 3> kLidarPresets = {"profiling_sim", "hokuyo_utm_30lx",
                                                           "hokuyo_ust_10lx"};

/// The camera, or LIDAR, turned into the sensor that its `preset` names: everything but what
/// depends on the vehicle, that is its name, its place and its rotation.
CameraConfig with_preset_values(const CameraConfig& camera);
LidarConfig with_preset_values(const LidarConfig& lidar);

}  // namespace gnbv
