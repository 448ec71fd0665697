// How sure it is that a point lies on the surface, by the noise of the camera that measured it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sensors/camera_model.hpp"

namespace gnbv {

struct FramePose;

/// The probability that a measured depth lies within `within_m` of the true one of a surface face
/// on: its error is Gaussian (depth_sigma_m). 1 without noise.
double certainty(const CameraModel& camera, double depth_m, double within_m);

/// Bins of an observation by the certainty of its points.
constexpr std::array<double, 3> kCertaintyFrom = {0.6, 0.3, 0.1};
constexpr std::size_t kCertaintyBins = kCertaintyFrom.size() + 1;
std::uint8_t certainty_bin(double certainty);

/// Of each point, by the first of the frames that has it in its image and range; 1 for a point that
/// none has. Empty when no camera has noise.
std::vector<float> certainties(std::span<const Vec3f> points_world_m,
                               std::span<const FramePose> looks,
                               std::span<const CameraModel> cameras, double within_m);

}  // namespace gnbv
