#include "bench/score/mission_score.hpp"

#include <algorithm>

#include "bench/score/cloud_metrics.hpp"

namespace gnbv {
namespace {

/// A cloud without the points that belong to what stands around the structure.
struct OwnCloud {
  std::vector<Vec3f> points_world_m = {};
  std::vector<std::size_t> until = {0};  // of the first i points of the whole so many are kept
};

OwnCloud own_cloud(const RayScene& scene, std::span<const Vec3f> points_world_m, int threads) {
  const std::vector<std::uint8_t> is_kept = points_of_structure(scene, points_world_m, threads);
  OwnCloud own;
  for (std::size_t i = 0; i < points_world_m.size(); ++i) {
    if (is_kept[i] != 0) own.points_world_m.push_back(points_world_m[i]);
    own.until.push_back(own.points_world_m.size());
  }
  return own;
}

std::vector<Vec3f> points_in(const Box3& region_m, std::span<const Vec3f> points_world_m) {
  std::vector<Vec3f> inside;
  for (const Vec3f& p_m : points_world_m) {
    if (region_m.contains(p_m.cast<double>())) inside.push_back(p_m);
  }
  return inside;
}

/// The profile, what each view left, and the whole cloud: the curve ends with the last view.
std::vector<std::size_t> prefixes_of(const ScoredCloud& cloud, const OwnCloud& own) {
  std::vector<std::size_t> prefixes = {own.until[cloud.profile_points]};
  for (const ViewMark& view : cloud.views) prefixes.push_back(own.until[view.cloud_points]);
  prefixes.push_back(own.points_world_m.size());
  return prefixes;
}

}  // namespace

std::vector<SizedCoverage> score_more_sizes(std::span<const double> sizes_m, const World& world,
                                            const RayScene& scene, const ReferenceConfig& reference,
                                            const ScoredCloud& cloud, int threads) {
  std::vector<SizedCoverage> all;
  if (std::all_of(sizes_m.begin(), sizes_m.end(),
                  [](double m) { return papers_size(m).has_value(); }))
    return all;
  const OwnCloud own = own_cloud(scene, cloud.points_world_m, threads);
  const std::vector<std::size_t> prefixes = prefixes_of(cloud, own);
  for (const double size_m : sizes_m) {
    if (papers_size(size_m)) continue;
    SizedShares shares =
        sized_shares(world, size_m, reference, own.points_world_m, prefixes, threads);
    SizedCoverage at{.size_m = size_m,
                     .profile = shares.counted.front(),
                     .final = shares.counted.back(),
                     .profile_raw = shares.raw.front(),
                     .final_raw = shares.raw.back()};
    shares.counted.pop_back();
    at.curve = std::move(shares.counted);
    all.push_back(std::move(at));
  }
  std::sort(all.begin(), all.end(),
            [](const SizedCoverage& a, const SizedCoverage& b) { return a.size_m < b.size_m; });
  return all;
}

MissionScore score_cloud(const SurfaceReference& reference, const RayScene& scene,
                         const ScoredCloud& cloud, double density_voxel_m, int threads) {
  const OwnCloud own = own_cloud(scene, cloud.points_world_m, threads);
  const std::vector<std::size_t> prefixes = prefixes_of(cloud, own);
  const std::vector<CoverageShares> shares =
      coverage_of_prefixes(reference, own.points_world_m, prefixes, threads);

  MissionScore score{.profile = shares.front().counted,
                     .final = shares.back().counted,
                     .profile_raw = shares.front().raw,
                     .final_raw = shares.back().raw,
                     .area_samples = reference.area_samples,
                     .before = cloud.before};
  score.curve.coverage.push_back(shares.front().counted);
  score.curve.metres.push_back(0.0);
  score.curve.seconds.push_back(0.0);
  for (std::size_t i = 0; i < cloud.views.size(); ++i) {
    score.curve.coverage.push_back(shares[i + 1].counted);
    score.curve.metres.push_back(cloud.views[i].straight_m);
    score.curve.seconds.push_back(cloud.views[i].time_s - cloud.before.profile_end_s);
  }
  const std::vector<Vec3f> judged = points_in(cloud.region_m, own.points_world_m);
  score.distances =
      cloud_distances(scene, own.points_world_m, judged, reference.samples_world_m, threads);
  score.density = cloud_density(judged, density_voxel_m);
  return score;
}

}  // namespace gnbv
