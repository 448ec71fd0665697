#include "planner/guided/burst.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "planner/guided/cluster_sight.hpp"

namespace gnbv {
namespace {

constexpr int kLayers = 3;

/// Clusters for voxels too scattered to form any: each voxel with its nearest ones (the authors'
/// code). The last voxel comes first, and is left out of the others' clusters.
std::vector<FrontierCluster> scattered_clusters(std::vector<VoxelIndex> voxels,
                                                const GridGeometry& geometry) {
  constexpr std::size_t kNearest = 8;  // with the voxel itself
  std::vector<FrontierCluster> clusters;
  for (; !voxels.empty(); voxels.pop_back()) {
    const Vec3 here_m = geometry.center_m(geometry.key_at(voxels.back()));
    const auto away_m2 = [&](VoxelIndex v) {
      return (geometry.center_m(geometry.key_at(v)) - here_m).squaredNorm();
    };
    std::vector<VoxelIndex> near = voxels;
    const auto end = near.begin() + static_cast<std::ptrdiff_t>(std::min(kNearest, near.size()));
    std::ranges::partial_sort(near, end, {},
                              [&](VoxelIndex v) { return std::pair(away_m2(v), v); });
    near.erase(end, near.end());
    std::ranges::sort(near);
    clusters.push_back(make_cluster(std::move(near), geometry));
  }
  return clusters;
}

/// The nearest to the vehicle first.
std::vector<FrontierCluster> clusters_left(const BurstTask& task, const BurstMemory& memory) {
  const GridGeometry& geometry = task.belief.grid.geometry();
  const FrontierConfig& config = task.fvs.frontier;
  const std::vector<VoxelIndex> voxels =
      frontier_voxels(config, task.belief.grid, task.belief.cloud, memory.ignored);
  std::vector<FrontierCluster> clusters =
      cluster_frontiers(config, geometry, voxels, task.scratch.frontier_marks);
  if (clusters.empty()) clusters = scattered_clusters(voxels, geometry);
  std::ranges::stable_sort(clusters, {}, [&](const FrontierCluster& cluster) {
    return (cluster.centroid_world_m - task.current.p_world_m).squaredNorm();
  });
  return clusters;
}

/// One cluster being covered.
struct Cover {
  const BurstTask& task;
  const FrontierCluster& cluster;
  int rank;  // of the cluster in the plan
  ViewPose from;
  std::vector<Vec3f> left_m;  // points not in sight of the views kept
  Plan& plan;

  /// Keeps the best view at each bearing.
  void look_from_all_bearings() {
    const FvsConfig& fvs = task.fvs;
    const std::vector<ViewPose> views =
        sample_fvs(fvs, cluster.centroid_world_m, task.model.pitches_rad);
    const std::size_t pitches = std::max<std::size_t>(task.model.pitches_rad.size(), 1);
    const std::size_t bearings = views.size() / kLayers / pitches;
    for (std::size_t i = 0; i < bearings && !left_m.empty(); ++i) {
      task.scratch.heed_stop();
      std::vector<ViewPose> column;
      for (std::size_t layer = 0; layer < kLayers; ++layer) {
        const auto first =
            views.begin() + static_cast<std::ptrdiff_t>((layer * bearings + i) * pitches);
        column.insert(column.end(), first, first + static_cast<std::ptrdiff_t>(pitches));
      }
      if (keep_best_of(column) >= fvs.share_to_cover) break;
    }
  }

  void keep(std::size_t candidate) {
    plan.chosen.push_back(candidate);
    from = plan.candidates[candidate].view;
  }

  /// Share of the points left that the view sees which was kept; 0 without one.
  double keep_best_of(std::span<const ViewPose> column) {
    std::optional<std::size_t> best;
    std::vector<bool> best_seen;
    for (const ViewPose& view : column) {
      Candidate candidate = {.view = view, .sampler = Sampler::fvs, .cluster = rank};
      ViewChecker checker(task.validity, task.model.navigation_m, task.model.no_fly,
                          task.belief.grid, task.recent, from,
                          [this] { task.scratch.heed_stop(); });
      check(checker, task.model, candidate);
      if (!candidate.rejected) {
        candidate.rejected = cluster_rejection(task.model.sights, task.belief.grid, cluster, view,
                                               false, task.fvs.fov_margin_m);
      }
      std::vector<bool> seen;
      if (!candidate.rejected) {
        seen = points_in_sight(task.fvs.culling, task.model.sights, task.belief.grid, view, left_m);
        candidate.covers = static_cast<int>(std::ranges::count(seen, true));
        if (*candidate.covers == 0 && task.fvs.needs_visible_cluster) {
          candidate.rejected = Rejection::cluster_hidden;
        }
      }
      plan.candidates.push_back(std::move(candidate));
      const Candidate& tried = plan.candidates.back();
      if (tried.rejected || (best && tried.covers <= plan.candidates[*best].covers)) continue;
      const std::size_t index = plan.candidates.size() - 1;
      if (task.fvs.keeps_blind && tried.covers == 0) {
        keep(index);
        continue;
      }
      best = index;
      best_seen = std::move(seen);
    }
    if (!best) return 0.0;
    keep(*best);
    const double share = *plan.candidates[*best].covers / static_cast<double>(left_m.size());
    std::size_t i = 0;
    std::erase_if(left_m, [&](const Vec3f&) { return best_seen[i++]; });
    return share;
  }
};

}  // namespace

std::vector<Vec3f> points_around(const FvsConfig& fvs, const SurfaceCloud& cloud,
                                 const FrontierCluster& cluster) {
  constexpr double kNearer_m = 1.0;
  const double radius_m = std::max(fvs.radius_m - kNearer_m, 0.0);
  std::vector<Vec3f> around_m;
  for (const Vec3f& p_m : cloud.points_world_m()) {
    if ((p_m.cast<double>() - cluster.centroid_world_m).squaredNorm() <= radius_m * radius_m) {
      around_m.push_back(p_m);
    }
  }
  return around_m;
}

bool add_burst(const BurstTask& task, BurstMemory& memory, Plan& plan) {
  const OccupancyGrid& grid = task.belief.grid;
  if (memory.ignored.empty()) memory.ignored = FrontierMarks(grid.geometry().voxel_count());
  std::vector<FrontierCluster> clusters = clusters_left(task, memory);
  if (plan.clusters.empty()) plan.frontier = voxels_of(clusters);
  clusters.resize(std::min(clusters.size(), static_cast<std::size_t>(memory.clusters)));
  ViewPose from = task.current;
  for (FrontierCluster& cluster : clusters) {
    for (const VoxelIndex v : cluster.voxels) memory.ignored[v] = 1;
    Cover cover = {.task = task,
                   .cluster = cluster,
                   .rank = static_cast<int>(plan.clusters.size()),
                   .from = from,
                   .left_m = points_around(task.fvs, task.belief.cloud, cluster),
                   .plan = plan};
    cover.look_from_all_bearings();
    from = cover.from;
    plan.clusters.push_back(std::move(cluster));
  }
  return !plan.chosen.empty();
}

}  // namespace gnbv
