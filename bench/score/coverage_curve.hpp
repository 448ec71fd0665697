// Coverage as a cloud grows, all of it in one pass.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <unordered_set>
#include <vector>

#include "bench/score/surface_reference.hpp"

namespace gnbv {

/// Coverage as fractions, by kCoverageSizes_m.
struct CoverageShares {
  std::array<double, 3> raw{};
  std::array<double, 3> counted{};
};

/// What the first prefixes[i] points of the cloud cover, for each i: the same as coverage() of
/// their voxels, but every point is looked at once a size. Requires that prefixes never shrink and
/// end within the cloud. Throws BrokenInvariant for a point that has no voxel.
std::vector<CoverageShares> coverage_of_prefixes(const SurfaceReference& reference,
                                                 std::span<const Vec3f> cloud_world_m,
                                                 std::span<const std::size_t> prefixes,
                                                 int threads);

/// Counts while a cloud grows what its points cover of one set of voxels.
class CoverageMeter {
 public:
  CoverageMeter(const VoxelSet& reference, double size_m)
      : unmet_(reference.begin(), reference.end()), all_(reference.size()), size_m_(size_m) {}

  /// Share that the cloud covers, equal to coverage() of its voxels. Looks at the points behind
  /// those of the call before, which have to be the cloud's first.
  double share_of(std::span<const Vec3f> cloud_world_m);

 private:
  std::unordered_set<std::uint64_t> unmet_;
  std::size_t all_;
  double size_m_;
  std::size_t looked_at_ = 0;  // points
};

}  // namespace gnbv
