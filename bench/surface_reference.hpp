// What there is to find: the voxels of the true surface, raw and as seen from outside.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sensors/ray_scene.hpp"
#include "sim/world.hpp"

namespace gnbv {

/// The paper's three voxel sizes (Tables 2 and 3).
constexpr std::array<double, 3> kCoverageSizes_m = {0.05, 0.10, 0.50};

struct ReferenceConfig {
  double floor_z_m = 0.3;        // surface below is never mapped, so it is never asked for
  double sample_spacing_m = 0.0125;
  int directions = 128;          // over the sphere, per sample, until one escapes
};

/// Sorted, unique voxel codes of the surface at one size. Voxel k covers [k s, (k + 1) s).
using VoxelSet = std::vector<std::uint64_t>;

struct SurfaceReference {
  std::array<VoxelSet, 3> raw;       // any surface, by kCoverageSizes_m
  std::array<VoxelSet, 3> outside;   // surface from which some straight line leaves the structure
};

/// Deterministic at any number of threads.
SurfaceReference make_surface_reference(const World& world, const RayScene& scene,
                                        const ReferenceConfig& config, int threads);

/// The voxels of a cloud.
VoxelSet voxels_of(std::span<const Vec3f> points_world_m, double size_m);

/// Share of `reference` that is in `cloud`, in [0, 1]; 0 for an empty reference.
double coverage(const VoxelSet& reference, const VoxelSet& cloud);

/// {"0.05", "0.10", "0.50"} of the run directory.
std::array<double, 3> coverage_at_all_sizes(const std::array<VoxelSet, 3>& reference,
                                            std::span<const Vec3f> points_world_m);

}  // namespace gnbv
