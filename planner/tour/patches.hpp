// Sides of the surface that still lack points, and what an observation of them can be expected to
// bring.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "planner/map/occupancy_grid.hpp"
#include "planner/tour/surface_cells.hpp"

namespace gnbv {

/// What is known of a patch: some of its points, a plane that leads there, that the other side
/// of something thin has been seen, or only that nothing is.
enum class PatchSource : std::uint8_t { sampled, extrapolated, opposite, boundary };
constexpr std::size_t kPatchSources = 4;
std::string_view name_of(PatchSource source);

/// One side of a cell: 2 cell + (0: the side its normal points to, 1: the other). The same for
/// ever.
using PatchId = std::uint32_t;
constexpr std::uint32_t cell_of(PatchId patch) { return patch / 2; }
constexpr std::size_t side_of(PatchId patch) { return patch % 2; }

/// How many points a cell holds for each small voxel expected of it; the last bin for 4 or more.
/// What many points have left out is hard to get.
constexpr std::size_t kPointBins = 5;
std::uint8_t point_bin(double points_per_voxel);

struct Patch {
  Vec3f target_m = Vec3f::Zero();  // the middle of what it lacks
  Vec3f normal = Vec3f::Zero();    // out of the surface
  float missing = 0.0F;            // small voxels expected to lack a point; 0: nothing to see here
  PatchSource source = PatchSource::sampled;
  std::uint8_t observations = 0;  // at both sides of the cell
  std::uint8_t points = 0;        // point_bin() of its cell
  float reliability = 1.0F;  // of what is predicted: what was kept nearby of late (GainCalibration)
};

/// By PatchId. A side is there if the space before it is not known to be surface.
std::vector<Patch> find_patches(const SurfaceCells& cells, const OccupancyGrid& grid, int threads);

}  // namespace gnbv
