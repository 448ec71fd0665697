#include "bench/score/mission_score.hpp"

#include <algorithm>

namespace gnbv {
namespace {

/// A cloud without the points that belong to what stands around the structure.
struct OwnCloud {
  std::vector<Vec3f> points_world_m = {};
  std::vector<double> distances_m = {};  // to the structure
  std::vector<std::size_t> until = {0};  // of the first i points of the whole so many are kept
};

OwnCloud own_cloud(const RayScene& scene, std::span<const Vec3f> points_world_m, int threads) {
  const std::vector<std::uint8_t> is_kept = points_of_structure(scene, points_world_m, threads);
  OwnCloud own;
  for (std::size_t i = 0; i < points_world_m.size(); ++i) {
    if (is_kept[i] != 0) own.points_world_m.push_back(points_world_m[i]);
    own.until.push_back(own.points_world_m.size());
  }
  own.distances_m = distances_to_structure_m(scene, own.points_world_m, threads);
  return own;
}

OwnCloud part_in(const Box3& region_m, const OwnCloud& own) {
  OwnCloud inside;
  for (std::size_t i = 0; i < own.points_world_m.size(); ++i) {
    if (!region_m.contains(own.points_world_m[i].cast<double>())) continue;
    inside.points_world_m.push_back(own.points_world_m[i]);
    inside.distances_m.push_back(own.distances_m[i]);
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

std::vector<SizedCoverage> score_more(const MoreSizes& more, const OwnCloud& own,
                                      std::span<const std::size_t> prefixes, int threads) {
  std::vector<SizedCoverage> all;
  for (const double size_m : more.sizes_m) {
    if (papers_size(size_m)) continue;
    SizedShares shares = sized_shares(more.world, size_m, more.reference, own.points_world_m,
                                      prefixes, threads, own.distances_m);
    SizedCoverage at{.size_m = size_m,
                     .profile = shares.counted.front(),
                     .final = shares.counted.back(),
                     .profile_raw = shares.raw.front(),
                     .final_raw = shares.raw.back(),
                     .accurate = shares.accurate.back()};
    shares.counted.pop_back();
    shares.accurate.pop_back();
    at.curve = std::move(shares.counted);
    at.accurate_curve = std::move(shares.accurate);
    all.push_back(std::move(at));
  }
  std::sort(all.begin(), all.end(),
            [](const SizedCoverage& a, const SizedCoverage& b) { return a.size_m < b.size_m; });
  return all;
}

/// Where it is known of all.
void add_energy(const ScoredCloud& cloud, CoverageCurve& curve) {
  const auto has_energy = [](const ViewMark& view) { return view.energy_wh.has_value(); };
  if (cloud.views.empty() || !std::ranges::all_of(cloud.views, has_energy)) return;
  curve.energy_wh = {*cloud.views.front().energy_wh};
  curve.on_one_battery = {cloud.views.front().on_one_battery};
  for (const ViewMark& view : cloud.views) {
    curve.energy_wh.push_back(*view.energy_wh);
    curve.on_one_battery.push_back(view.on_one_battery);
  }
}

}  // namespace

MissionScore score_cloud(const SurfaceReference& reference, const RayScene& scene,
                         const ScoredCloud& cloud, double density_voxel_m, int threads,
                         const std::optional<MoreSizes>& more) {
  const OwnCloud own = own_cloud(scene, cloud.points_world_m, threads);
  const std::vector<std::size_t> prefixes = prefixes_of(cloud, own);
  const std::vector<CoverageShares> shares =
      coverage_of_prefixes(reference, own.points_world_m, prefixes, threads, own.distances_m);

  MissionScore score{.profile = shares.front().counted,
                     .final = shares.back().counted,
                     .accurate = shares.back().accurate,
                     .profile_raw = shares.front().raw,
                     .final_raw = shares.back().raw,
                     .area_samples = reference.area_samples,
                     .before = cloud.before};
  if (more) score.more = score_more(*more, own, prefixes, threads);
  score.curve.coverage.push_back(shares.front().counted);
  score.curve.accurate.push_back(shares.front().accurate);
  score.curve.metres.push_back(0.0);
  score.curve.seconds.push_back(0.0);
  for (std::size_t i = 0; i < cloud.views.size(); ++i) {
    score.curve.coverage.push_back(shares[i + 1].counted);
    score.curve.accurate.push_back(shares[i + 1].accurate);
    score.curve.metres.push_back(cloud.views[i].straight_m);
    score.curve.seconds.push_back(cloud.views[i].time_s - cloud.before.profile_end_s);
  }
  add_energy(cloud, score.curve);
  const OwnCloud judged = part_in(cloud.region_m, own);
  score.distances =
      cloud_distances(judged.distances_m, own.points_world_m, reference.samples_world_m, threads);
  score.density = cloud_density(judged.points_world_m, density_voxel_m);
  return score;
}

}  // namespace gnbv
