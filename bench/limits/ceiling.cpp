#include "bench/limits/ceiling.hpp"

#include <algorithm>

#include "bench/limits/ceiling_cache.hpp"
#include "bench/limits/cloud_of_views.hpp"
#include "bench/limits/seen_voxels.hpp"
#include "bench/score/content_cache.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kKind = "ceiling-2";

Ceiling compute(const std::string& key, const Scenario& scenario, const World& world,
                const RayScene& scene, const LegalViewpoints& legal, int threads) {
  const ReferenceConfig config{.floor_z_m = scenario.planner.floor_z_m};
  const SurfaceReference reference = cached_surface_reference(world, scene, config, threads);
  const VoxelSet seen =
      seen_voxels(world, scene, exact_cameras(scenario), legal.p_world_m, config, threads);
  const ViewSurvey survey = cached_survey(key, scenario, scene, legal, reference, threads);
  Ceiling ceiling{.leaf_raw = survey.leaf_raw,
                  .leaf_outside = survey.leaf_outside,
                  .positions = legal.size(),
                  .frames = survey.views.size() * scenario.cameras.size()};
  for (std::size_t size = 0; size < kCoverageSizes_m.size(); ++size) {
    const VoxelSet seen_of_size = coarser(seen, kCoverageFactors[size]);
    // a leaf's centroid may lie in a voxel beside those that its points are in, and what is seen
    // goes by few samples a voxel: what the cloud holds is seen in any case
    ceiling.raw[size] =
        std::max(coverage(reference.raw[size], seen_of_size), ceiling.leaf_raw[size]);
    ceiling.outside[size] =
        std::max(coverage(reference.outside[size], seen_of_size), ceiling.leaf_outside[size]);
  }
  return ceiling;
}

}  // namespace

Ceiling find_ceiling(const Scenario& scenario, const World& world, const RayScene& scene,
                     const ViewPose& start, int threads) {
  const LegalViewpoints legal = find_legal_viewpoints(scenario, scene, start, threads);
  const std::string key = ceiling_key(scenario, world, legal);
  if (const auto stored = load_cached(kKind, key)) {
    if (const auto ceiling = ceiling_from(*stored)) return *ceiling;
  }
  const Ceiling ceiling = compute(key, scenario, world, scene, legal, threads);
  store_cached(kKind, key, text_of(ceiling));
  return ceiling;
}

}  // namespace gnbv
