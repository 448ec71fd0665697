#include "bench/reference/paper_view_twin.hpp"

#include <set>

#include "bench/reference/octomap_copy.hpp"
#include "planner/map/ray_walk.hpp"

namespace gnbv {
namespace {

struct KeyLess {
  bool operator()(const octomap::OcTreeKey& a, const octomap::OcTreeKey& b) const {
    return std::tie(a[0], a[1], a[2]) < std::tie(b[0], b[1], b[2]);
  }
};

}  // namespace

struct PaperViewTwin::Tree {
  Tree(double resolution_m, const GridGeometry& grid) : octree(resolution_m), geometry(grid) {}

  /// Adds the voxel unless it is known already, with one search; false outside the workspace.
  bool see(const octomap::OcTreeKey& key, std::set<octomap::OcTreeKey, KeyLess>& seen,
           ViewCounts& counts) const {
    if (!geometry.contains(our_key(key))) return false;
    if (!seen.insert(key).second) return true;
    const octomap::OcTreeNode* node = octree.search(key);
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
  copy_into(grid, tree_->octree);
  tree_->free_max_log = octomap::logodds(grid.config().free_max);
}

ViewCounts PaperViewTwin::evaluate(const ViewRays& rays, const ViewPose& candidate) const {
  const octomap::OcTree& octree = tree_->octree;
  ViewCounts counts;
  std::set<octomap::OcTreeKey, KeyLess> seen;
  octomap::KeyRay keys;
  for_each_ray(tree_->geometry, rays, candidate, [&](const Vec3& from_m, const Vec3& to_m) {
    const octomap::point3d origin = octomap_point(from_m.cast<float>());
    octomap::point3d end = octomap_point(to_m.cast<float>());
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
