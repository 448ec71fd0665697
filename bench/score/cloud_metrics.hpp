// How near a cloud is to the true surface, and how evenly it lies on it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sensors/ray_scene.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

/// Farther than this is as good as lost: distances beyond count as this much, so that a stray point
/// weighs no more than a wrong one.
constexpr double kFarthest_m = 1.0;

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

/// Of some distances: the shares below each of kScoreDistances_m, and their mean.
struct DistanceShares {
  std::array<double, 3> below{};
  double mean_m = kFarthest_m;
};

/// The points' exact distances to the structure, at most kFarthest_m (n).
std::vector<double> distances_to_structure_m(const RayScene& scene,
                                             std::span<const Vec3f> points_world_m, int threads);
/// Of them. Deterministic at any number of threads.
DistanceShares shares_to_structure(const RayScene& scene, std::span<const Vec3f> points_world_m,
                                   int threads);

/// From those of the cloud's points to the surface, and of the surface's samples to the cloud.
CloudDistances cloud_distances(const DistanceShares& precision, const DistanceShares& recall);

/// From the distances of the judged points of the cloud to the structure, and of every sample of
/// the surface (SurfaceReference::samples_world_m) to its nearest point of all the cloud. An empty
/// cloud, like an empty surface, is kFarthest_m away and scores 0. Deterministic at any number of
/// threads.
CloudDistances cloud_distances(std::span<const double> judged_m,
                               std::span<const Vec3f> cloud_world_m,
                               std::span<const Vec3f> samples_world_m, int threads);

/// Zero for an empty cloud. Voxels are those of voxel_code().
CloudDensity cloud_density(std::span<const Vec3f> cloud_world_m, double voxel_m);

/// 1 for each point but those that belong to what stands around the structure: nearer to an
/// obstacle or the terrain than to the structure, and within kFarthest_m of it. Points near neither
/// are kept: they are as wrong as without obstacles. Deterministic at any number of threads.
std::vector<std::uint8_t> points_of_structure(const RayScene& scene,
                                              std::span<const Vec3f> points_world_m, int threads);

}  // namespace gnbv
