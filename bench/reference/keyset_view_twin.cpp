#include "bench/reference/keyset_view_twin.hpp"

#include "bench/reference/octomap_copy.hpp"

namespace gnbv {

struct KeysetViewTwin::State {
  explicit State(const OccupancyGrid& grid)
      : octree(grid.geometry().resolution_m()),
        geometry(grid.geometry()),
        free_max_log(octomap::logodds(grid.config().free_max)) {
    copy_into(grid, octree);
  }

  /// Whether the ray goes on beyond the voxel.
  bool see(const octomap::OcTreeKey& key, ViewCounts& counts) {
    if (!geometry.contains(our_key(key))) return false;
    if (!seen.insert(key).second) return occupied.find(key) == occupied.end();
    const octomap::OcTreeNode* const node = octree.search(key);
    if (node != nullptr && octree.isNodeOccupied(node)) {
      ++counts.occupied;
      occupied.insert(key);
      return false;
    }
    ++(node != nullptr && node->getLogOdds() <= free_max_log ? counts.free : counts.unknown);
    return true;
  }

  octomap::OcTree octree;
  GridGeometry geometry;
  float free_max_log;
  octomap::KeySet seen;
  octomap::KeySet occupied;  // of those seen
  octomap::KeyRay ray;
};

KeysetViewTwin::KeysetViewTwin(const OccupancyGrid& grid) : state_(std::make_unique<State>(grid)) {}
KeysetViewTwin::~KeysetViewTwin() = default;
KeysetViewTwin::KeysetViewTwin(KeysetViewTwin&&) noexcept = default;
KeysetViewTwin& KeysetViewTwin::operator=(KeysetViewTwin&&) noexcept = default;

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

}  // namespace gnbv
