// Sets of voxels, the currency of the coverage metric. Voxel k of an axis covers [k s, (k + 1) s).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/core/pose.hpp"

namespace gnbv {

/// The paper's three voxel sizes (Tables 2 and 3).
constexpr std::array<double, 3> kCoverageSizes_m = {0.05, 0.10, 0.50};

/// The sizes in units of the finest: a finest voxel lies in exactly one voxel of each size.
constexpr std::array<int, 3> kCoverageFactors = {1, 2, 10};

/// Sorted, unique voxel codes of one size. A code holds x, y, z in this order of weight.
using VoxelSet = std::vector<std::uint64_t>;

/// Code of the voxel that holds a point. The index is floor(x / s) in exact arithmetic for the
/// three sizes above, so that sizes nest. Throws BrokenInvariant for a point that is not finite or
/// farther than 2^20 voxels from the origin.
std::uint64_t voxel_code(const Vec3f& p_world_m, double size_m);

/// Code of a voxel by its index along x, y, z, each of less than 2^20.
std::uint64_t code_of(const std::array<std::int64_t, 3>& index);
std::array<std::int64_t, 3> index_of(std::uint64_t code);

/// The voxel `factor` times as large that holds it. factor >= 1.
std::uint64_t coarser_code(std::uint64_t code, int factor);

/// Centre of a voxel.
Vec3 voxel_centre_m(std::uint64_t code, double size_m);

/// Of coverage, at every size: a point covers the voxel that it lies in and those that it lies
/// within this of, along each axis. What lies on a voxel's face, as walls at round coordinates do,
/// so does not belong to one side or the other by the last bit. Ten times what rays and files in
/// float lose; more would lend a sparse cloud neighbours along its walls.
constexpr double kCoverReach_m = 0.00015;

/// The voxels that a point covers, one to eight.
struct CoveredVoxels {
  std::array<std::uint64_t, 8> codes{};
  std::size_t count = 0;

  const std::uint64_t* begin() const { return codes.data(); }
  const std::uint64_t* end() const { return codes.data() + count; }
};

/// Of a size of kCoverageSizes_m. Sizes nest: the coarse voxels covered are those that hold the
/// fine ones covered. Requires a reach below half of the finest size. Throws as voxel_code().
CoveredVoxels covered_by(const Vec3f& p_world_m, std::size_t size, double reach_m = kCoverReach_m);

/// Those that any of the points covers.
VoxelSet covered_voxels(std::span<const Vec3f> points_world_m, std::size_t size);

/// The voxels that hold the points of a cloud. Throws BadInput naming the first point that is not
/// finite or farther than 2^20 voxels from the origin.
VoxelSet voxels_of(std::span<const Vec3f> points_world_m, double size_m);

/// The voxels `factor` times as large that hold a voxel of `fine`. factor >= 1.
VoxelSet coarser(const VoxelSet& fine, int factor);

/// The voxels of all three sizes that hold those of the finest, by kCoverageSizes_m.
std::array<VoxelSet, 3> at_all_sizes(VoxelSet finest);

/// Share of `reference` that is in `cloud`, in [0, 1]; 0 for an empty reference.
double coverage(const VoxelSet& reference, const VoxelSet& cloud);

}  // namespace gnbv
