#include "planner/tour/patches.hpp"

#include <algorithm>
#include <bit>

#include "sim/core/parallel.hpp"

namespace gnbv {
namespace {

// of the voxels of a side that nobody observed, when the other one is known
constexpr float kOppositeShare = 0.5F;

// that a cell of unknown space is worth: a fifth of a plane through it
constexpr float kBoundaryVoxels = 0.2F * SurfaceCell::kSide * SurfaceCell::kSide;

struct Gap {
  Vec3f middle_m;
  int voxels = 0;
};

/// What is expected and holds no point.
Gap gap_of(const SurfaceCells& cells, const SurfaceCell& cell) {
  Vec3 sum_m = Vec3::Zero();
  const std::uint64_t missing = cell.expected & ~cell.covered;
  for (std::uint64_t left = missing; left != 0; left &= left - 1) {
    const Vec3 center_m = cells.voxel_center_m(cell, std::countr_zero(left));
    const Vec3 normal = cell.normal.cast<double>();
    sum_m += center_m - normal.dot(center_m - cell.on_plane_m.cast<double>()) * normal;
  }
  const int voxels = std::popcount(missing);
  if (voxels == 0) return {cell.on_plane_m, 0};
  return {(sum_m / voxels).cast<float>(), voxels};
}

}  // namespace

std::string_view name_of(PatchSource source) {
  constexpr std::array<std::string_view, kPatchSources> kNames = {"sampled", "extrapolated",
                                                                  "opposite", "frontier"};
  return kNames[static_cast<std::size_t>(source)];
}

std::uint8_t point_bin(double points_per_voxel) {
  constexpr std::array<double, kPointBins - 1> kFrom = {0.25, 1.0, 2.0, 4.0};
  return static_cast<std::uint8_t>(std::upper_bound(kFrom.begin(), kFrom.end(), points_per_voxel) -
                                   kFrom.begin());
}

std::vector<Patch> find_patches(const SurfaceCells& cells, const OccupancyGrid& grid, int threads) {
  const std::span<const SurfaceCell> all = cells.cells();
  std::vector<Patch> patches(2 * all.size());
  const double before_m = 1.5 * std::max(cells.edge_m(), grid.geometry().resolution_m());
  parallel_for_chunks(threads, all.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const SurfaceCell& cell = all[i];
      if (cell.is_boundary) {
        patches[2 * i] = {.target_m = cell.on_plane_m,
                          .normal = cell.normal,
                          .missing = kBoundaryVoxels,
                          .source = PatchSource::boundary,
                          .observations = cell.observations[0]};
      }
      if (!cell.has_plane) continue;
      const Gap gap = gap_of(cells, cell);
      const auto state_before = [&](const Vec3f& normal) {
        return grid.state_at(
            (cell.on_plane_m + static_cast<float>(before_m) * normal).cast<double>());
      };
      const std::array<Vec3f, 2> normals = {cell.normal, -cell.normal};
      const std::array<VoxelState, 2> before = {state_before(normals[0]), state_before(normals[1])};
      const auto expected = static_cast<float>(std::popcount(cell.expected));
      const std::uint8_t points = point_bin(cell.moments.count / static_cast<double>(expected));
      // what an observation of one side has left, one of the other will hardly find
      const auto observations =
          static_cast<std::uint8_t>(std::min(0xff, cell.observations[0] + cell.observations[1]));
      const bool any_free = before[0] == VoxelState::free || before[1] == VoxelState::free;
      for (std::size_t side = 0; side < 2; ++side) {
        const VoxelState needed = any_free ? VoxelState::free : VoxelState::unknown;
        if (before[side] != needed) continue;
        Patch& patch = patches[2 * i + side];
        patch.target_m = gap.middle_m;
        patch.normal = normals[side];
        patch.missing = static_cast<float>(gap.voxels);
        patch.observations = observations;
        patch.points = points;
        patch.source = cell.is_extrapolated() ? PatchSource::extrapolated : PatchSource::sampled;
        const bool is_other_side = cell.observations[side] == 0 && cell.observations[1 - side] > 0;
        if (is_other_side && patch.missing < kOppositeShare * expected) {
          patch.missing = kOppositeShare * expected;
          patch.target_m = cell.on_plane_m;
          patch.source = PatchSource::opposite;
          patch.observations = 0;
        }
      }
    }
  });
  return patches;
}

}  // namespace gnbv
