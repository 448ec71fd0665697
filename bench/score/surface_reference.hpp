// What there is to find: the voxels of the true surface, all of them and those that coverage
// counts.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/score/surface_samples.hpp"
#include "bench/score/voxel_set.hpp"
#include "sensors/ray_scene.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {

struct ReferenceConfig {
  double floor_z_m = 0.3;           // surface below is never mapped, so it is never asked for
  double sample_spacing_m = 0.025;  // at most: one sample to each spacing^2, one a piece at least
  std::size_t fewest_samples = 100000;  // about; a small structure is sampled more closely
  int directions = 512;                 // tried over the sphere, per sample
  double escape_near_m = 1e-4;    // what lies nearer to the sample on such a line does not block it
  double obstacle_reach_m = 1.0;  // an obstacle farther away along the line does not, either
  // Coverage counts the voxels that hold one of so many points (drawn_by_area()), as the authors'
  // evaluate_coverage does (a sparse cloud of all the mesh); 0: those with surface that sees out.
  std::size_t area_samples = 0;
  // Counted are voxels whose centre lies in it, and samples that do themselves.
  Box3 region_m = Box3(Vec3::Constant(-1e4), Vec3::Constant(1e4));
};

/// Without area samples, a voxel of size s belongs to the reference if the surface in it has at
/// least this share of s^2. Less is a sliver at an edge, which hardly a pixel hits and the cloud's
/// leaves give away; how many of them there are would depend on how densely one looks.
constexpr double kLeastFaceShare = 0.1;

/// A point sees out if straight lines leave the structure along its face's normal, on either side,
/// or in at least this share of all directions: a tenth of a steradian. With fewer asked for, the
/// longer one looks the more narrow gaps one would find. An obstacle blocks a line where it meets
/// it within obstacle_reach_m of the point: it hides what it stands against, but a hall around the
/// structure hides nothing. Terrain hides what lies under it, and like the plane ground nothing
/// else.
constexpr double kLeastOpenShare = 1.0 / 128.0;

/// How many samples recall is a mean over: enough for a hundredth of a point.
constexpr std::size_t kAreaSamples = 100000;

/// By kCoverageSizes_m. A coarse voxel has the surface of all the fine ones in it, also of those
/// that are too poor to count themselves.
struct SurfaceReference {
  std::array<VoxelSet, 3> raw;      // any surface
  std::array<VoxelSet, 3> counted;  // surface that sees out; or what holds an area sample
  std::size_t area_samples = 0;     // of the config
  // A point of each voxel of counted[0], in its order, by which it counts: of the samples (that see
  // out) the nearest to the voxel's centre.
  std::vector<Vec3f> points_world_m;
  // Samples of the surface that sees out, each of which stands for as much area as any other, so
  // that a mean over them is one over the area: recall and completeness. At most kAreaSamples.
  std::vector<Vec3f> samples_world_m;

  bool operator==(const SurfaceReference&) const = default;
};

/// What it takes to find a reference, about, from the area alone.
struct ReferenceCost {
  double area_m2 = 0.0;  // above the floor and below
  double samples = 0.0;
  double voxels = 0.0;  // of the finest size
  double bytes = 0.0;   // of memory at most
  double thread_s = 0.0;
};
ReferenceCost cost_of_reference(const TriangleMesh& structure, const ReferenceConfig& config);

/// Told the share that is done, from one thread at a time.
using ReferenceProgress = std::function<void(double share_done)>;

/// Deterministic at any number of threads. The area of the surface in a voxel is exact
/// (surface_pieces.hpp); which part of it sees out is estimated by its samples, and what share of
/// the directions is open by `directions`, evenly spread, of which none but the last few decide on
/// most points. Normals are tilted by two degrees. The ground never blocks.
SurfaceReference make_surface_reference(const World& world, const RayScene& scene,
                                        const ReferenceConfig& config, int threads,
                                        const ReferenceProgress& progress = {});

/// The same from the cache (content_cache.hpp), where it is kept by the geometry of the structure
/// and of what stands around it, and by the config; which tells no progress.
SurfaceReference cached_surface_reference(const World& world, const RayScene& scene,
                                          const ReferenceConfig& config, int threads,
                                          const ReferenceProgress& progress = {});

/// What coverage counts, for programs: "outside" or "area_samples".
std::string reference_name(std::size_t area_samples);
/// For people, behind "voxels": "with visible surface of a tenth of their face".
std::string reference_words(std::size_t area_samples);

/// Of what the points cover (covered_by()): {"0.05", "0.10", "0.50"} of the run directory.
std::array<double, 3> coverage_at_all_sizes(const std::array<VoxelSet, 3>& reference,
                                            std::span<const Vec3f> points_world_m);

}  // namespace gnbv
