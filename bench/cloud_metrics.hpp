// How near a cloud is to the true surface, and how evenly it lies on it.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "sim/core/pose.hpp"

namespace gnbv {

/// The distances of precision, recall and F.
constexpr std::array<double, 3> kScoreDistances_m = {0.02, 0.05, 0.10};

/// Knapitsch et al. 2017 (Tanks and Temples): precision = share of the cloud's points nearer than
/// `distance_m` to the surface, recall = share of the surface (samples visible from outside) nearer
/// than that to a point of the cloud, F their harmonic mean.
struct DistanceScore {
  double distance_m = 0.0;
  double precision = 0.0;
  double recall = 0.0;
  double f = 0.0;
};

struct CloudDistances {
  std::array<DistanceScore, 3> at;  // by kScoreDistances_m
  double accuracy_m = 0.0;          // mean distance of the cloud's points to the surface
  double completeness_m = 0.0;      // mean distance of the surface's samples to the cloud
  double chamfer_m = 0.0;           // mean of the two
};

/// Over the voxels that hold points: mean points a voxel, and the standard deviation over the mean
/// (coefficient of variation).
struct CloudDensity {
  double voxel_m = 0.0;
  double mean_points = 0.0;
  double variation = 0.0;
};

}  // namespace gnbv
