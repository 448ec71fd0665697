#include "bench/score/mission_score.hpp"

#include <algorithm>

namespace gnbv {

namespace {

/// The profile, what each view left, and the whole cloud: the curve ends with the last view.
std::vector<std::size_t> prefixes_of(const ScoredCloud& cloud) {
  std::vector<std::size_t> prefixes = {cloud.profile_points};
  for (const ViewMark& view : cloud.views) prefixes.push_back(view.cloud_points);
  prefixes.push_back(cloud.points_world_m.size());
  return prefixes;
}

}  // namespace

std::vector<SizedCoverage> score_more_sizes(std::span<const double> sizes_m, const World& world,
                                            double floor_z_m, const std::optional<Box3>& box_m,
                                            const ScoredCloud& cloud, int threads) {
  const std::vector<std::size_t> prefixes = prefixes_of(cloud);
  std::vector<SizedCoverage> all;
  for (const double size_m : sizes_m) {
    if (is_papers_size(size_m)) continue;
    SizedShares shares =
        sized_shares(world, size_m, floor_z_m, box_m, cloud.points_world_m, prefixes, threads);
    SizedCoverage at{.size_m = size_m,
                     .profile = shares.outside.front(),
                     .final = shares.outside.back(),
                     .profile_raw = shares.raw.front(),
                     .final_raw = shares.raw.back()};
    shares.outside.pop_back();
    at.curve = std::move(shares.outside);
    all.push_back(std::move(at));
  }
  std::sort(all.begin(), all.end(),
            [](const SizedCoverage& a, const SizedCoverage& b) { return a.size_m < b.size_m; });
  return all;
}

MissionScore score_cloud(const SurfaceReference& reference, const RayScene& scene,
                         const ScoredCloud& cloud, double density_voxel_m, int threads) {
  const std::vector<std::size_t> prefixes = prefixes_of(cloud);
  const std::vector<CoverageShares> shares =
      coverage_of_prefixes(reference, cloud.points_world_m, prefixes, threads);

  MissionScore score{.profile = shares.front().outside,
                     .final = shares.back().outside,
                     .profile_raw = shares.front().raw,
                     .final_raw = shares.back().raw,
                     .before = cloud.before};
  score.curve.coverage.push_back(shares.front().outside);
  score.curve.metres.push_back(0.0);
  score.curve.seconds.push_back(0.0);
  for (std::size_t i = 0; i < cloud.views.size(); ++i) {
    score.curve.coverage.push_back(shares[i + 1].outside);
    score.curve.metres.push_back(cloud.views[i].straight_m);
    score.curve.seconds.push_back(cloud.views[i].time_s - cloud.before.profile_end_s);
  }
  score.distances =
      cloud_distances(scene, cloud.points_world_m, reference.samples_world_m, threads);
  score.density = cloud_density(cloud.points_world_m, density_voxel_m);
  return score;
}

}  // namespace gnbv
