#include "bench/limits/ceiling.hpp"

#include <algorithm>
#include <iterator>

#include "bench/limits/ceiling_cache.hpp"
#include "bench/limits/seen_surface.hpp"
#include "bench/score/content_cache.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kKind = "ceiling";

Ceiling compute(const Scenario& scenario, const World& world, const RayScene& scene,
                const LegalViewpoints& legal, int threads,
                const std::function<void(double)>& on_progress) {
  const ReferenceConfig config{.floor_z_m = scenario.planner.floor_z_m,
                               .region_m = scenario.score.region_m};
  const SurfaceReference reference = cached_surface_reference(world, scene, config, threads);
  const SeenSurface seen =
      find_seen_surface(scenario, world, scene, legal, reference, threads, on_progress);
  Ceiling ceiling{.positions = legal.size()};
  for (std::size_t size = 0; size < kCoverageSizes_m.size(); ++size) {
    const VoxelSet seen_of_size = coarser(seen.voxels, kCoverageFactors[size]);
    const VoxelSet kept = voxels_of(seen.kept_world_m, kCoverageSizes_m[size]);
    VoxelSet kept_and_seen;  // the neighbour that gets a leaf need not be seen
    std::set_intersection(kept.begin(), kept.end(), seen_of_size.begin(), seen_of_size.end(),
                          std::back_inserter(kept_and_seen));
    ceiling.raw[size] = coverage(reference.raw[size], seen_of_size);
    ceiling.outside[size] = coverage(reference.outside[size], seen_of_size);
    ceiling.leaf_raw[size] = coverage(reference.raw[size], kept_and_seen);
    ceiling.leaf_outside[size] = coverage(reference.outside[size], kept_and_seen);
  }
  return ceiling;
}

}  // namespace

Ceiling find_ceiling(const Scenario& scenario, const World& world, const RayScene& scene,
                     const ViewPose& start, int threads,
                     const std::function<void(double)>& on_progress) {
  const LegalViewpoints legal = find_legal_viewpoints(scenario, scene, start, threads);
  const std::string key = ceiling_key(scenario, world, legal);
  if (const auto stored = load_cached(kKind, key)) {
    if (const auto ceiling = ceiling_from(*stored)) return *ceiling;
  }
  const Ceiling ceiling = compute(scenario, world, scene, legal, threads, on_progress);
  store_cached(kKind, key, text_of(ceiling));
  return ceiling;
}

std::optional<Ceiling> known_ceiling(const Scenario& scenario, const World& world,
                                     const RayScene& scene, const ViewPose& start, int threads) {
  if (!has_cached(kKind)) return std::nullopt;
  const LegalViewpoints legal = find_legal_viewpoints(scenario, scene, start, threads);
  const auto stored = load_cached(kKind, ceiling_key(scenario, world, legal));
  return stored ? ceiling_from(*stored) : std::nullopt;
}

}  // namespace gnbv
