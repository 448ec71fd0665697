#include "bench/reference/view_twins.hpp"

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

/// What the grid has measured, as a tree.
struct MeasuredTree {
  explicit MeasuredTree(const OccupancyGrid& grid)
      : octree(grid.geometry().resolution_m()),
        geometry(grid.geometry()),
        free_max_log(octomap::logodds(grid.config().free_max)) {
    copy_into(grid, octree);
  }

  /// Counts the voxel, with one search; whether it is occupied.
  bool count(const octomap::OcTreeKey& key, ViewCounts& counts) const {
    const octomap::OcTreeNode* const node = octree.search(key);
    const bool is_occupied = node != nullptr && octree.isNodeOccupied(node);
    const bool is_free = !is_occupied && node != nullptr && node->getLogOdds() <= free_max_log;
    ++(is_occupied ? counts.occupied : is_free ? counts.free : counts.unknown);
    return is_occupied;
  }

  octomap::OcTree octree;
  GridGeometry geometry;
  float free_max_log;
};

}  // namespace

struct PaperViewTwin::State : MeasuredTree {
  using MeasuredTree::MeasuredTree;

  /// Adds the voxel unless it is known already; false outside the workspace.
  bool see(const octomap::OcTreeKey& key, std::set<octomap::OcTreeKey, KeyLess>& seen,
           ViewCounts& counts) const {
    if (!geometry.contains(our_key(key))) return false;
    if (seen.insert(key).second) count(key, counts);
    return true;
  }
};

PaperViewTwin::PaperViewTwin(const OccupancyGrid& grid) : state_(std::make_unique<State>(grid)) {}
PaperViewTwin::~PaperViewTwin() = default;

ViewCounts PaperViewTwin::evaluate(const ViewRays& rays, const ViewPose& candidate) const {
  const octomap::OcTree& octree = state_->octree;
  ViewCounts counts;
  std::set<octomap::OcTreeKey, KeyLess> seen;
  octomap::KeyRay keys;
  for_each_ray(state_->geometry, rays, candidate, [&](const Vec3& from_m, const Vec3& to_m) {
    const octomap::point3d origin = octomap_point(from_m.cast<float>());
    octomap::point3d end = octomap_point(to_m.cast<float>());
    octomap::point3d hit;
    constexpr bool kIgnoreUnknown = true;
    const bool has_hit =
        octree.castRay(origin, end - origin, hit, kIgnoreUnknown, (end - origin).norm());
    if (has_hit) end = hit;
    if (!octree.computeRayKeys(origin, end, keys)) return;
    for (const octomap::OcTreeKey& key : keys) {
      if (!state_->see(key, seen, counts)) return;
    }
    if (has_hit) state_->see(octree.coordToKey(hit), seen, counts);
  });
  return counts;
}

struct KeysetViewTwin::State : MeasuredTree {
  using MeasuredTree::MeasuredTree;

  /// Whether the ray goes on beyond the voxel.
  bool see(const octomap::OcTreeKey& key, ViewCounts& counts) {
    if (!geometry.contains(our_key(key))) return false;
    if (!seen.insert(key).second) return occupied.find(key) == occupied.end();
    if (!count(key, counts)) return true;
    occupied.insert(key);
    return false;
  }

  octomap::KeySet seen;
  octomap::KeySet occupied;  // of those seen
  octomap::KeyRay ray;
};

KeysetViewTwin::KeysetViewTwin(const OccupancyGrid& grid) : state_(std::make_unique<State>(grid)) {}
KeysetViewTwin::~KeysetViewTwin() = default;

ViewCounts KeysetViewTwin::evaluate(const ViewRays& rays, const ViewPose& candidate) {
  ViewCounts counts;
  state_->seen.clear();
  state_->occupied.clear();
  for_each_ray(state_->geometry, rays, candidate, [&](const Vec3& from_m, const Vec3& to_m) {
    if (!state_->octree.computeRayKeys(octomap_point(from_m.cast<float>()),
                                       octomap_point(to_m.cast<float>()), state_->ray)) {
      return;
    }
    for (const octomap::OcTreeKey& key : state_->ray) {
      if (!state_->see(key, counts)) return;
    }
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
