#include "bench/reference/paper_view_twin.hpp"

#include <octomap/octomap.h>

#include <set>

#include "planner/map/ray_walk.hpp"

namespace gnbv {
namespace {

constexpr int kOctomapKeyOffset = 32768;

struct KeyLess {
  bool operator()(const octomap::OcTreeKey& a, const octomap::OcTreeKey& b) const {
    return std::tie(a[0], a[1], a[2]) < std::tie(b[0], b[1], b[2]);
  }
};

octomap::OcTreeKey octomap_key(const Key& key) {
  return {static_cast<octomap::key_type>(key[0] + kOctomapKeyOffset),
          static_cast<octomap::key_type>(key[1] + kOctomapKeyOffset),
          static_cast<octomap::key_type>(key[2] + kOctomapKeyOffset)};
}

octomap::point3d octomap_point(const Vec3& p_m) {
  const Vec3f p = p_m.cast<float>();
  return {p.x(), p.y(), p.z()};
}

/// Calls visit(origin_world_m, end_world_m) for every ray.
template <typename Visit>
void for_each_ray(const GridGeometry& grid, const ViewRays& rays, const ViewPose& candidate,
                  Visit&& visit) {
  const Isometry T = T_world_body(candidate);
  for (const ViewRays::Camera& camera : rays.cameras) {
    const Vec3 origin_m = grid.nearest_inside(T * camera.origin_body_m);
    for (std::size_t i = camera.first; i < camera.first + camera.count; ++i) {
      visit(origin_m,
            T * Vec3(rays.end_body_m[0][i], rays.end_body_m[1][i], rays.end_body_m[2][i]));
    }
  }
}

}  // namespace

struct PaperViewTwin::Tree {
  Tree(double resolution_m, const GridGeometry& grid) : octree(resolution_m), geometry(grid) {}

  bool is_in_workspace(const octomap::OcTreeKey& key) const {
    return geometry.contains(
        {key[0] - kOctomapKeyOffset, key[1] - kOctomapKeyOffset, key[2] - kOctomapKeyOffset});
  }
  /// Adds the voxel unless it is known already; false outside the workspace.
  bool see(const octomap::OcTreeKey& key, std::set<octomap::OcTreeKey, KeyLess>& seen,
           ViewCounts& counts) const {
    if (!is_in_workspace(key)) return false;
    const octomap::OcTreeNode* node = octree.search(key);
    if (!seen.insert(key).second) return true;
    if (node != nullptr && octree.isNodeOccupied(node)) {
      ++counts.occupied;
    } else if (node != nullptr && node->getLogOdds() <= free_max_log) {
      ++counts.free;
    } else {
      ++counts.unknown;
    }
    return true;
  }

  octomap::OcTree octree;
  GridGeometry geometry;
  float free_max_log = 0.0F;
};

PaperViewTwin::~PaperViewTwin() = default;
PaperViewTwin::PaperViewTwin(PaperViewTwin&&) noexcept = default;
PaperViewTwin& PaperViewTwin::operator=(PaperViewTwin&&) noexcept = default;

PaperViewTwin::PaperViewTwin(const OccupancyGrid& grid)
    : tree_(std::make_unique<Tree>(grid.geometry().resolution_m(), grid.geometry())) {
  octomap::OcTree& octree = tree_->octree;
  octree.setOccupancyThres(grid.config().occupied_min);
  tree_->free_max_log = octomap::logodds(grid.config().free_max);
  const auto voxels = static_cast<VoxelIndex>(grid.geometry().voxel_count());
  for (VoxelIndex v = 0; v < voxels; ++v) {
    if (!grid.is_measured(v)) continue;
    constexpr bool kLazy = true;
    octree.setNodeValue(octomap_key(grid.geometry().key_at(v)), grid.log_odds(v), kLazy);
  }
  octree.updateInnerOccupancy();
}

ViewCounts PaperViewTwin::evaluate(const ViewRays& rays, const ViewPose& candidate) const {
  const octomap::OcTree& octree = tree_->octree;
  ViewCounts counts;
  std::set<octomap::OcTreeKey, KeyLess> seen;
  octomap::KeyRay keys;
  for_each_ray(tree_->geometry, rays, candidate, [&](const Vec3& from_m, const Vec3& to_m) {
    const octomap::point3d origin = octomap_point(from_m);
    octomap::point3d end = octomap_point(to_m);
    octomap::point3d hit;
    constexpr bool kIgnoreUnknown = true;
    const bool has_hit =
        octree.castRay(origin, end - origin, hit, kIgnoreUnknown, (end - origin).norm());
    if (has_hit) end = hit;
    if (!octree.computeRayKeys(origin, end, keys)) return;
    for (const octomap::OcTreeKey& key : keys) {
      if (!tree_->see(key, seen, counts)) return;
    }
    if (has_hit) tree_->see(octree.coordToKey(hit), seen, counts);
  });
  return counts;
}

ViewCounts exact_view_counts(const OccupancyGrid& grid, const ViewRays& rays,
                             const ViewPose& candidate) {
  const GridGeometry& geometry = grid.geometry();
  ViewCounts counts;
  std::vector<bool> seen(geometry.voxel_count(), false);
  for_each_ray(geometry, rays, candidate, [&](const Vec3& from_m, const Vec3& to_m) {
    const RayOrigin origin = make_ray_origin(geometry, from_m.cast<float>());
    walk_ray_inside(geometry, origin, to_m.cast<float>(), [&](VoxelIndex v) {
      const VoxelState state = grid.state(v);
      if (!seen[v]) {
        seen[v] = true;
        counts.free += state == VoxelState::free ? 1 : 0;
        counts.occupied += state == VoxelState::occupied ? 1 : 0;
        counts.unknown += state == VoxelState::unknown ? 1 : 0;
      }
      return state != VoxelState::occupied;
    });
  });
  return counts;
}

}  // namespace gnbv
