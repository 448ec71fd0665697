#include "bench/score/voxel_set.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr int kAxisBits = 21;
constexpr std::int64_t kBias = std::int64_t{1} << (kAxisBits - 1);
constexpr std::uint64_t kAxisMask = (std::uint64_t{1} << kAxisBits) - 1;

// A float times 20, 10 or 2 is exact in double; times the rounded 0.05 or over it, it is not.
static_assert(1.0 / 0.05 == 20.0 && 1.0 / 0.10 == 10.0 && 1.0 / 0.50 == 2.0);

std::optional<std::uint64_t> find_code(const Vec3f& p_world_m, double per_m) {
  std::array<std::int64_t, 3> index{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double cell =
        std::floor(static_cast<double>(p_world_m[static_cast<Eigen::Index>(axis)]) * per_m);
    if (!(std::abs(cell) < static_cast<double>(kBias))) return std::nullopt;
    index[axis] = static_cast<std::int64_t>(cell);
  }
  return code_of(index);
}

std::int64_t floor_div(std::int64_t i, std::int64_t factor) {
  const std::int64_t towards_zero = i / factor;
  return towards_zero * factor > i ? towards_zero - 1 : towards_zero;
}

void sort_unique(VoxelSet& codes) {
  std::sort(codes.begin(), codes.end());
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
}

}  // namespace

std::uint64_t code_of(const std::array<std::int64_t, 3>& index) {
  std::uint64_t code = 0;
  for (const std::int64_t i : index) {
    code = (code << kAxisBits) | static_cast<std::uint64_t>(i + kBias);
  }
  return code;
}

std::array<std::int64_t, 3> index_of(std::uint64_t code) {
  std::array<std::int64_t, 3> index{};
  for (std::size_t axis = 3; axis-- > 0; code >>= kAxisBits) {
    index[axis] = static_cast<std::int64_t>(code & kAxisMask) - kBias;
  }
  return index;
}

std::uint64_t coarser_code(std::uint64_t code, int factor) {
  std::array<std::int64_t, 3> index = index_of(code);
  for (std::int64_t& i : index) i = floor_div(i, factor);
  return code_of(index);
}

std::uint64_t voxel_code(const Vec3f& p_world_m, double size_m) {
  const std::optional<std::uint64_t> code = find_code(p_world_m, 1.0 / size_m);
  GNBV_CHECK(code.has_value(), "no voxel of {} m at ({}, {}, {}) m", size_m, p_world_m.x(),
             p_world_m.y(), p_world_m.z());
  return *code;
}

Vec3 voxel_centre_m(std::uint64_t code, double size_m) {
  const std::array<std::int64_t, 3> index = index_of(code);
  Vec3 centre_m;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    centre_m[static_cast<Eigen::Index>(axis)] = (static_cast<double>(index[axis]) + 0.5) * size_m;
  }
  return centre_m;
}

CoveredVoxels covered_by(const Vec3f& p_world_m, std::size_t size, double reach_m) {
  constexpr double kPerMetre = 1.0 / kCoverageSizes_m[0];
  CoveredVoxels covered{.count = 1};
  for (const float x : p_world_m) {
    const double x_m = static_cast<double>(x);
    GNBV_CHECK(std::abs(std::floor(x_m * kPerMetre)) < static_cast<double>(kBias),
               "no voxel at ({}, {}, {}) m", p_world_m.x(), p_world_m.y(), p_world_m.z());
    const auto bits_at = [&](double at_m) {
      const auto finest = static_cast<std::int64_t>(std::floor(at_m * kPerMetre));
      return static_cast<std::uint64_t>(
          floor_div(std::clamp(finest, 1 - kBias, kBias - 1), kCoverageFactors[size]) + kBias);
    };
    const std::uint64_t low = bits_at(x_m - reach_m);
    const std::uint64_t high = bits_at(x_m + reach_m);
    for (std::size_t i = covered.count; i-- > 0;) {
      const std::uint64_t before = covered.codes[i] << kAxisBits;
      covered.codes[i] = before | low;
      if (high != low) covered.codes[covered.count++] = before | high;
    }
  }
  return covered;
}

VoxelSet covered_voxels(std::span<const Vec3f> points_world_m, std::size_t size) {
  VoxelSet codes;
  codes.reserve(points_world_m.size());
  for (const Vec3f& p_m : points_world_m) {
    for (const std::uint64_t code : covered_by(p_m, size)) {
      if (codes.empty() || codes.back() != code) codes.push_back(code);
    }
  }
  sort_unique(codes);
  return codes;
}

VoxelSet voxels_of(std::span<const Vec3f> points_world_m, double size_m) {
  GNBV_CHECK(size_m > 0.0, "voxel size {} m", size_m);
  VoxelSet codes;
  codes.reserve(points_world_m.size());
  for (std::size_t i = 0; i < points_world_m.size(); ++i) {
    const Vec3f& p = points_world_m[i];
    const std::optional<std::uint64_t> code = find_code(p, 1.0 / size_m);
    if (!code) {
      throw BadInput(
          "cloud: point {} (counted from 0) is ({}, {}, {}) m: not finite or too far from the "
          "origin",
          i, p.x(), p.y(), p.z());
    }
    if (codes.empty() || codes.back() != *code) codes.push_back(*code);
  }
  sort_unique(codes);
  return codes;
}

VoxelSet coarser(const VoxelSet& fine, int factor) {
  GNBV_CHECK(factor >= 1, "factor {}", factor);
  VoxelSet codes;
  codes.reserve(fine.size());
  for (const std::uint64_t code : fine) codes.push_back(coarser_code(code, factor));
  sort_unique(codes);
  return codes;
}

std::array<VoxelSet, 3> at_all_sizes(VoxelSet finest) {
  std::array<VoxelSet, 3> sizes;
  for (std::size_t i = 1; i < sizes.size(); ++i) sizes[i] = coarser(finest, kCoverageFactors[i]);
  sizes[0] = std::move(finest);
  return sizes;
}

double coverage(const VoxelSet& reference, const VoxelSet& cloud) {
  if (reference.empty()) return 0.0;
  const auto covered = std::count_if(reference.begin(), reference.end(), [&](std::uint64_t voxel) {
    return std::binary_search(cloud.begin(), cloud.end(), voxel);
  });
  return static_cast<double>(covered) / static_cast<double>(reference.size());
}

}  // namespace gnbv
