// The true surface on the page: what of it a run found, and when; how far its points lie off.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/score/surface_reference.hpp"
#include "sensors/ray_scene.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// The voxels that coverage counts (SurfaceReference::outside), of one size.
struct TrueVoxels {
  double size_m = 0.0;
  VoxelSet codes = {};
};

/// The finest voxels of at most `max_voxels` whose indices fit 16 bits; none where even the
/// coarsest are too many.
TrueVoxels true_voxels(const SurfaceReference& reference, std::size_t max_voxels);

/// int16 (n, 3): the voxel covers [index, index + 1) * size.
std::vector<std::int16_t> voxel_indices(const TrueVoxels& voxels);

constexpr std::uint16_t kNeverFound = 0xffff;

/// Of each voxel the number of views after which a point lay in it first, 0 after the profile
/// alone, or kNeverFound. What came after the last view counts to it. Requires fewer than
/// kNeverFound views.
std::vector<std::uint16_t> views_until_found(const TrueVoxels& voxels, const RunCloud& cloud);

/// One step of an error.
constexpr double kErrorStep_m = 0.001;
constexpr std::uint8_t kNotOfStructure = 0xff;

/// Distance of each of those points of the cloud to the structure, rounded to steps and at most 254
/// of them; kNotOfStructure for points of what stands around it. The same at any number of threads.
std::vector<std::uint8_t> point_errors(const RayScene& scene, std::span<const Vec3f> points_world_m,
                                       int threads);

}  // namespace gnbv
