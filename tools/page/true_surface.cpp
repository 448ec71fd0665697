#include "tools/page/true_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/score/cloud_metrics.hpp"
#include "sim/core/error.hpp"
#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

constexpr std::int64_t kMostIndex = std::numeric_limits<std::int16_t>::max();

bool fits_16_bits(const VoxelSet& codes) {
  return std::all_of(codes.begin(), codes.end(), [](std::uint64_t code) {
    const auto index = index_of(code);
    return std::all_of(index.begin(), index.end(),
                       [](std::int64_t k) { return -kMostIndex <= k && k < kMostIndex; });
  });
}

}  // namespace

TrueVoxels true_voxels(const SurfaceReference& reference, std::size_t max_voxels) {
  for (std::size_t size = 0; size < kCoverageSizes_m.size(); ++size) {
    const VoxelSet& codes = reference.outside[size];
    if (codes.size() <= max_voxels && fits_16_bits(codes)) {
      return {.size_m = kCoverageSizes_m[size], .codes = codes};
    }
  }
  return {};
}

std::vector<std::int16_t> voxel_indices(const TrueVoxels& voxels) {
  std::vector<std::int16_t> indices;
  for (const std::uint64_t code : voxels.codes) {
    for (const std::int64_t k : index_of(code)) indices.push_back(static_cast<std::int16_t>(k));
  }
  return indices;
}

std::vector<std::uint16_t> views_until_found(const TrueVoxels& voxels, const RunCloud& cloud) {
  const std::size_t views = cloud.view_points.size();
  GNBV_CHECK(views < kNeverFound, "{} views", views);
  std::vector<std::uint16_t> until(voxels.codes.size(), kNeverFound);
  std::size_t state = 0;
  for (std::size_t i = 0; i < cloud.points_world_m.size(); ++i) {
    const auto points_of = [&](std::size_t n) {
      return n == 0 ? cloud.profile_points : cloud.view_points[n - 1];
    };
    while (state < views && i >= points_of(state)) ++state;
    const std::uint64_t code = voxel_code(cloud.points_world_m[i], voxels.size_m);
    const auto voxel = std::lower_bound(voxels.codes.begin(), voxels.codes.end(), code);
    if (voxel == voxels.codes.end() || *voxel != code) continue;
    std::uint16_t& found = until[static_cast<std::size_t>(voxel - voxels.codes.begin())];
    found = std::min(found, static_cast<std::uint16_t>(state));
  }
  return until;
}

std::vector<std::uint8_t> point_errors(const RayScene& scene, std::span<const Vec3f> points_world_m,
                                       int threads) {
  constexpr double kMost = kNotOfStructure - 1;
  std::vector<std::uint8_t> errors(points_world_m.size());
  const std::vector<std::uint8_t> is_its = points_of_structure(scene, points_world_m, threads);
  constexpr std::size_t kPoints = 4096;  // a task
  parallel_for_chunks(
      threads, points_world_m.size(), kPoints, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const double off_m =
              scene.distance_to_structure_m(points_world_m[i].cast<double>(), kMost * kErrorStep_m);
          const double steps = std::min(kMost, std::round(off_m / kErrorStep_m));
          errors[i] = is_its[i] != 0 ? static_cast<std::uint8_t>(steps) : kNotOfStructure;
        }
      });
  return errors;
}

}  // namespace gnbv
