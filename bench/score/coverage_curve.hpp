// Coverage as a cloud grows, all of it in one pass.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <unordered_set>
#include <vector>

#include "bench/score/surface_reference.hpp"

namespace gnbv {

/// A voxel counts as accurate once it is covered by a point that lies within this share of the
/// voxel's size of the structure: what noise smears into a voxel that nobody saw does not.
constexpr double kAccurateShare = 0.2;

/// Coverage as fractions, by kCoverageSizes_m.
struct CoverageShares {
  std::array<double, 3> raw{};
  std::array<double, 3> counted{};
  std::array<double, 3> accurate{};  // of what is counted
};

/// What the first prefixes[i] points of the cloud cover, for each i: the same as coverage() of
/// covered_voxels(), but every point is looked at once a size. `distances_m` are those of the
/// points to the structure; none: all lie on it. Requires that prefixes never shrink and end within
/// the cloud. Throws BrokenInvariant for a point that has no voxel.
std::vector<CoverageShares> coverage_of_prefixes(const SurfaceReference& reference,
                                                 std::span<const Vec3f> cloud_world_m,
                                                 std::span<const std::size_t> prefixes, int threads,
                                                 std::span<const double> distances_m = {},
                                                 double reach_m = kCoverReach_m);

/// Counts while a cloud grows what its points cover of one set of voxels.
class CoverageMeter {
 public:
  /// Of kCoverageSizes_m[size].
  CoverageMeter(const VoxelSet& reference, std::size_t size)
      : unmet_(reference.begin(), reference.end()), all_(reference.size()), size_(size) {}

  /// Share that the cloud covers, equal to coverage() of covered_voxels(). Looks at the points
  /// behind those of the call before, which have to be the cloud's first.
  double share_of(std::span<const Vec3f> cloud_world_m);

 private:
  std::unordered_set<std::uint64_t> unmet_;
  std::size_t all_;
  std::size_t size_;
  std::size_t looked_at_ = 0;  // points
};

}  // namespace gnbv
