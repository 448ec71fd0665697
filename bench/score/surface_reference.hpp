// What there is to find: the voxels of the true surface, raw and as seen from outside.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bench/score/surface_samples.hpp"
#include "bench/score/voxel_set.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

struct ReferenceConfig {
  double floor_z_m = 0.3;  // surface below is never mapped, so it is never asked for
  double sample_spacing_m = 0.0125;
  int directions = 128;         // over the sphere, per sample, until one escapes
  double escape_near_m = 1e-4;  // what lies nearer to the sample on such a line does not block it
};

/// The samples of the surface (surface_samples.hpp) put into voxels, by kCoverageSizes_m. The two
/// coarser sizes are derived from the finest, which is exact: a voxel holds a sample if one of the
/// finest voxels in it does.
struct SurfaceReference {
  std::array<VoxelSet, 3> raw;      // any surface
  std::array<VoxelSet, 3> outside;  // surface from which some straight line leaves the structure
  // One sample of each voxel of outside[0], in its order, that sees out: the nearest to the voxel's
  // centre of those found first. They lie evenly whatever the triangles are; recall and
  // completeness are of them.
  std::vector<Vec3f> samples_world_m;

  bool operator==(const SurfaceReference&) const = default;
};

/// Deterministic at any number of threads. A voxel belongs to `outside` if one of its samples sees
/// out: two degrees off the face's normal, off its opposite, or in one of `directions`
/// directions. The ground never blocks. Openings narrower than the directions resolve (about
/// 4 pi / directions steradian) are found only by luck.
SurfaceReference make_surface_reference(const World& world, const RayScene& scene,
                                        const ReferenceConfig& config, int threads);

/// The same from the cache (content_cache.hpp), where it is kept by the geometry of the structure
/// and the config.
SurfaceReference cached_surface_reference(const World& world, const RayScene& scene,
                                          const ReferenceConfig& config, int threads);

/// 1 for each sample that sees out by the rule above, 0 for the others. make_surface_reference asks
/// less, since a voxel's first such sample settles it.
std::vector<std::uint8_t> samples_seeing_out(const World& world, const RayScene& scene,
                                             std::span<const SurfaceSample> samples,
                                             const ReferenceConfig& config, int threads);

/// Unit vectors spread evenly over the sphere, the first few of them too.
std::vector<Vec3f> spread_directions(int count);

/// {"0.05", "0.10", "0.50"} of the run directory.
std::array<double, 3> coverage_at_all_sizes(const std::array<VoxelSet, 3>& reference,
                                            std::span<const Vec3f> points_world_m);

}  // namespace gnbv
