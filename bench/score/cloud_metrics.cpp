#include "bench/score/cloud_metrics.hpp"

#include <algorithm>
#include <cmath>

#include "bench/score/point_tree.hpp"
#include "bench/score/voxel_set.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kChunk = 8192;

/// Of all distances, which are asked for in any order and summed up in theirs.
template <typename Item, typename Distance>
DistanceShares shares_of(std::span<const Item> items, int threads, const Distance& distance_m) {
  struct Tally {
    std::array<std::size_t, 3> below{};
    double sum_m = 0.0;
  };
  std::vector<Tally> tallies((items.size() + kChunk - 1) / kChunk);
  parallel_for_chunks(threads, items.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    Tally& tally = tallies[begin / kChunk];
    for (std::size_t i = begin; i < end; ++i) {
      const double m = std::min(distance_m(items[i]), kFarthest_m);
      for (std::size_t k = 0; k < 3; ++k) tally.below[k] += m < kScoreDistances_m[k] ? 1 : 0;
      tally.sum_m += m;
    }
  });
  DistanceShares shares;
  if (items.empty()) return shares;
  const auto count = static_cast<double>(items.size());
  Tally all;
  for (const Tally& tally : tallies) {
    for (std::size_t k = 0; k < 3; ++k) all.below[k] += tally.below[k];
    all.sum_m += tally.sum_m;
  }
  for (std::size_t k = 0; k < 3; ++k) shares.below[k] = static_cast<double>(all.below[k]) / count;
  shares.mean_m = all.sum_m / count;
  return shares;
}

DistanceShares shares_of(std::span<const double> distances_m, int threads) {
  return shares_of(distances_m, threads, [](double m) { return m; });
}

}  // namespace

std::vector<double> distances_to_structure_m(const RayScene& scene,
                                             std::span<const Vec3f> points_world_m, int threads) {
  std::vector<double> distances_m(points_world_m.size());
  parallel_for_chunks(threads, distances_m.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 p_m = points_world_m[i].cast<double>();
      distances_m[i] = std::min(scene.distance_to_structure_m(p_m, kFarthest_m), kFarthest_m);
    }
  });
  return distances_m;
}

DistanceShares shares_to_structure(const RayScene& scene, std::span<const Vec3f> points_world_m,
                                   int threads) {
  return shares_of(distances_to_structure_m(scene, points_world_m, threads), threads);
}

CloudDistances cloud_distances(const DistanceShares& precision, const DistanceShares& recall) {
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

CloudDistances cloud_distances(std::span<const double> judged_m,
                               std::span<const Vec3f> cloud_world_m,
                               std::span<const Vec3f> samples_world_m, int threads) {
  const PointTree tree(cloud_world_m);
  const auto nearest_m = [&](const Vec3f& p_m) {
    std::array<Neighbour, 1> room;
    const auto found = tree.nearest(p_m, room, static_cast<float>(kFarthest_m));
    if (found.empty()) return kFarthest_m;
    return (cloud_world_m[found[0].point] - p_m).cast<double>().norm();
  };
  return cloud_distances(shares_of(judged_m, threads),
                         shares_of(samples_world_m, threads, nearest_m));
}

CloudDensity cloud_density(std::span<const Vec3f> cloud_world_m, double voxel_m) {
  GNBV_CHECK(voxel_m > 0.0, "voxel size {} m", voxel_m);
  std::vector<std::uint64_t> codes;
  codes.reserve(cloud_world_m.size());
  for (const Vec3f& p_m : cloud_world_m) codes.push_back(voxel_code(p_m, voxel_m));
  std::sort(codes.begin(), codes.end());
  double voxels = 0.0;
  double sum_of_squares = 0.0;
  for (auto begin = codes.begin(); begin != codes.end();) {
    const auto end = std::upper_bound(begin, codes.end(), *begin);
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
  parallel_for_chunks(threads, is_kept.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 p_m = points_world_m[i].cast<double>();
      const double other_m = scene.distance_to_surroundings_m(p_m, kFarthest_m);
      if (other_m > kFarthest_m) continue;
      is_kept[i] = scene.distance_to_structure_m(p_m, kFarthest_m) <= other_m ? 1 : 0;
    }
  });
  return is_kept;
}

}  // namespace gnbv
