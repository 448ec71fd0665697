#include "planner/frontier_order.hpp"

#include <algorithm>

#include "planner/belief.hpp"
#include "planner/view_sampling.hpp"

namespace gnbv {
namespace {

bool is_looked_at_enough(const FvsConfig& fvs, std::span<const Decision> decisions,
                         const FrontierCluster& cluster, double resolution_m) {
  constexpr double kSame_voxels = 3.0;
  const auto looks = std::count_if(decisions.begin(), decisions.end(), [&](const Decision& d) {
    return d.sampler == "fvs" &&
           looks_at(fvs, d.view, cluster.centroid_world_m, kSame_voxels * resolution_m);
  });
  return looks >= fvs.looks_max;
}

}  // namespace

std::vector<FrontierCluster> clusters_to_try(const FvsConfig& fvs, const Belief& belief,
                                             std::span<const Decision> decisions,
                                             const Vec3& from_world_m, FrontierMarks& marks) {
  std::vector<FrontierCluster> clusters =
      find_frontiers(fvs.frontier, belief.grid, belief.cloud, marks);
  if (fvs.looks_max > 0) {
    const double resolution_m = belief.grid.geometry().resolution_m();
    std::erase_if(clusters, [&](const FrontierCluster& cluster) {
      return is_looked_at_enough(fvs, decisions, cluster, resolution_m);
    });
  }
  const auto is_nearer = [&](const FrontierCluster& a, const FrontierCluster& b) {
    return (a.centroid_world_m - from_world_m).squaredNorm() <
           (b.centroid_world_m - from_world_m).squaredNorm();
  };
  std::stable_sort(clusters.begin(), clusters.end(), is_nearer);
  if (fvs.order == ClusterOrder::largest) {
    std::stable_sort(clusters.begin(), clusters.end(),
                     [](const FrontierCluster& a, const FrontierCluster& b) {
                       return a.voxels.size() > b.voxels.size();
                     });
  }
  clusters.resize(std::min(clusters.size(), static_cast<std::size_t>(fvs.tries)));
  return clusters;
}

}  // namespace gnbv
