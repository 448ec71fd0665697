#include "bench/score/cloud_metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "bench/score/point_tree.hpp"
#include "bench/score/voxel_set.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kChunk = 8192;

double nearest_m(const PointTree& cloud, std::span<const Vec3f> cloud_m, const Vec3f& p_m) {
  std::array<Neighbour, 1> room;
  const auto found = cloud.nearest(p_m, room, static_cast<float>(kFarthest_m));
  if (found.empty()) return kFarthest_m;
  const double distance_m = (cloud_m[found[0].point] - p_m).cast<double>().norm();
  return std::min(distance_m, kFarthest_m);
}

/// Of some distances: how many are below each of kScoreDistances_m, and their sum.
struct Tally {
  std::array<std::size_t, 3> below{};
  double sum_m = 0.0;

  void add(double distance_m) {
    for (std::size_t i = 0; i < below.size(); ++i) {
      if (distance_m < kScoreDistances_m[i]) ++below[i];
    }
    sum_m += distance_m;
  }
};

/// All tallies in their order, as shares of `count` and their mean.
struct Shares {
  std::array<double, 3> below{};
  double mean_m = kFarthest_m;
};

Shares shares_of(std::span<const Tally> tallies, std::size_t count) {
  Shares shares;
  if (count == 0) return shares;
  Tally all;
  for (const Tally& tally : tallies) {
    for (std::size_t i = 0; i < all.below.size(); ++i) all.below[i] += tally.below[i];
    all.sum_m += tally.sum_m;
  }
  for (std::size_t i = 0; i < all.below.size(); ++i) {
    shares.below[i] = static_cast<double>(all.below[i]) / static_cast<double>(count);
  }
  shares.mean_m = all.sum_m / static_cast<double>(count);
  return shares;
}

template <typename Distance>
Tally tally_of(std::span<const Vec3f> points_m, std::size_t chunk, const Distance& distance_m) {
  Tally tally;
  const std::size_t end = std::min(points_m.size(), (chunk + 1) * kChunk);
  for (std::size_t i = chunk * kChunk; i < end; ++i) tally.add(distance_m(points_m[i]));
  return tally;
}

double to_surface_m(const RayScene& scene, const Vec3f& p_m) {
  return std::min(scene.distance_to_structure_m(p_m.cast<double>(), kFarthest_m), kFarthest_m);
}

std::size_t chunks_of(std::span<const Vec3f> points_m) {
  return (points_m.size() + kChunk - 1) / kChunk;
}

}  // namespace

CloudDistances cloud_distances(const RayScene& scene, std::span<const Vec3f> cloud_world_m,
                               std::span<const Vec3f> samples_world_m, int threads) {
  return cloud_distances(scene, cloud_world_m, cloud_world_m, samples_world_m, threads);
}

CloudDistances cloud_distances(const RayScene& scene, std::span<const Vec3f> cloud_world_m,
                               std::span<const Vec3f> judged_world_m,
                               std::span<const Vec3f> samples_world_m, int threads) {
  std::optional<PointTree> tree;
  std::vector<Tally> precise(chunks_of(judged_world_m));
  // the tree is one task beside those that need none
  parallel_for(threads, precise.size() + 1, [&](std::size_t task) {
    if (task == 0) {
      tree.emplace(cloud_world_m);
      return;
    }
    precise[task - 1] = tally_of(judged_world_m, task - 1,
                                 [&](const Vec3f& p_m) { return to_surface_m(scene, p_m); });
  });
  std::vector<Tally> recalled(chunks_of(samples_world_m));
  parallel_for(threads, recalled.size(), [&](std::size_t chunk) {
    recalled[chunk] = tally_of(samples_world_m, chunk, [&](const Vec3f& p_m) {
      return nearest_m(*tree, cloud_world_m, p_m);
    });
  });

  const Shares precision = shares_of(precise, judged_world_m.size());
  const Shares recall = shares_of(recalled, samples_world_m.size());
  CloudDistances out;
  for (std::size_t i = 0; i < out.at.size(); ++i) {
    const double p = precision.below[i];
    const double r = recall.below[i];
    out.at[i] = {kScoreDistances_m[i], p, r, p + r > 0.0 ? 2.0 * p * r / (p + r) : 0.0};
  }
  out.accuracy_m = precision.mean_m;
  out.completeness_m = recall.mean_m;
  out.chamfer_m = 0.5 * (out.accuracy_m + out.completeness_m);
  return out;
}

CloudDensity cloud_density(std::span<const Vec3f> cloud_world_m, double voxel_m) {
  GNBV_CHECK(voxel_m > 0.0, "voxel size {} m", voxel_m);
  std::vector<std::uint64_t> codes;
  codes.reserve(cloud_world_m.size());
  for (const Vec3f& p_m : cloud_world_m) codes.push_back(voxel_code(p_m, voxel_m));
  std::sort(codes.begin(), codes.end());
  double voxels = 0.0;
  double sum_of_squares = 0.0;
  for (std::size_t begin = 0; begin < codes.size();) {
    std::size_t end = begin;
    while (end < codes.size() && codes[end] == codes[begin]) ++end;
    const auto points = static_cast<double>(end - begin);
    voxels += 1.0;
    sum_of_squares += points * points;
    begin = end;
  }
  CloudDensity density{.voxel_m = voxel_m};
  if (codes.empty()) return density;
  density.mean_points = static_cast<double>(codes.size()) / voxels;
  const double variance = sum_of_squares / voxels - density.mean_points * density.mean_points;
  density.variation = std::sqrt(std::max(variance, 0.0)) / density.mean_points;
  return density;
}

std::vector<std::uint8_t> points_of_structure(const RayScene& scene,
                                              std::span<const Vec3f> points_world_m, int threads) {
  std::vector<std::uint8_t> is_kept(points_world_m.size(), 1);
  if (!scene.has_obstacles() && !scene.has_terrain()) return is_kept;
  constexpr std::size_t kPoints = 4096;  // a task
  parallel_for_chunks(threads, points_world_m.size(), kPoints,
                      [&](std::size_t begin, std::size_t end) {
                        for (std::size_t i = begin; i < end; ++i) {
                          const Vec3 p_m = points_world_m[i].cast<double>();
                          const double other_m = scene.distance_to_surroundings_m(p_m, kFarthest_m);
                          if (other_m > kFarthest_m) continue;
                          const double own_m = scene.distance_to_structure_m(p_m, kFarthest_m);
                          is_kept[i] = own_m <= other_m ? 1 : 0;
                        }
                      });
  return is_kept;
}

}  // namespace gnbv
